"""What scrolls, with a bar that comes and goes, but not without end."""

from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QScrollArea, QWidget

# So often it may come in a row: while something is laid out anew it comes once and goes once.
_MOST_TIMES, _IN_A_ROW_MS = 2, 2000
# One size of what is inside may lead to another one at once: so often, or until the stack runs out.
_MOST_DEPTH = 5
_AS_NEEDED, _ALWAYS = (
    Qt.ScrollBarPolicy.ScrollBarAsNeeded,
    Qt.ScrollBarPolicy.ScrollBarAlwaysOn,
)


class SteadyArea(QScrollArea):
    """Has its upright bar stay where that would come and go, until there is another room.

    What is lower in less width, as words are that are written smaller there, has room beside the
    bar and none without: Qt would put it there and take it away for as long as anybody looks.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._times, self._depth, self._in_sight = 0, 0, False
        self._room = QSize()
        self._row = QTimer(self, interval=_IN_A_ROW_MS, singleShot=True)
        self._row.timeout.connect(self._forget)
        self.setWidgetResizable(True)
        self.verticalScrollBar().installEventFilter(self)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._in_sight = True

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self._in_sight = False

    def resizeEvent(self, event: QResizeEvent) -> None:
        # The bar takes its room from the viewport, whose events these are, not from the area.
        if self.size() != self._room:
            self._room = self.size()
            self._begin_anew()
        super().resizeEvent(event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._begin_anew()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # With the area itself it comes into sight before that knows.
        if event.type() == QEvent.Type.Show and self._in_sight:
            self._times += 1
            self._row.start()
        self._depth += 1
        if self._times > _MOST_TIMES or self._depth > _MOST_DEPTH:
            self._put(_ALWAYS)
        handled = super().eventFilter(watched, event)
        self._depth -= 1
        return handled

    def _begin_anew(self) -> None:
        self._forget()
        self._put(_AS_NEEDED)

    def _put(self, policy: Qt.ScrollBarPolicy) -> None:
        # Even the same one has it laid out anew, and the bar come.
        if self.verticalScrollBarPolicy() != policy:
            self.setVerticalScrollBarPolicy(policy)

    def _forget(self) -> None:
        self._times = 0
