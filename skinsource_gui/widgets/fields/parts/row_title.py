"""The name of a part in a list: opens it, is dragged, takes the keys."""

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QSizePolicy, QToolButton, QWidget

from skinsource_gui.widgets.keys import claims_shortcut, key_text, meaning_of
from skinsource_gui.widgets.tooltips import tooltip

# The arrow and the edges.
_BESIDE_PX = 30


class RowTitle(QToolButton):
    """Shows or hides the fields of a part; drags it to another place.

    Parameters
    ----------
    words
        What the part is called; what is too long ends with dots.
    place
        Where the keys are listed that it takes.
    where
        Where it is moved, for the tooltip: "in the chain".

    Attributes
    ----------
    open
        Whether the fields are shown.
    """

    #: Whether the fields shall be shown.
    opened = Signal(bool)
    #: What a key means, as the table of keys names it.
    pressed_key = Signal(str)
    #: Where the pointer is, on the screen, during a drag; where it let go.
    dragged = Signal(int)
    dropped = Signal(int)
    #: The drag was given up.
    given_up = Signal()

    def __init__(self, words: str, place: str, where: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words, self._place = "", place
        self._start_y: int | None = None
        self._dragging = False
        self.open = False
        self.setObjectName(f"{place}_title")
        self.setStyleSheet("QToolButton { text-align: left; }")
        self.setAutoRaise(True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        keys = f"{key_text(place, 'shift_up')}, {key_text(place, 'shift_down')}"
        self._hint = f"Click: show or hide its settings. Drag, or {keys}: another place {where}"
        self.set_words(words)
        self.clicked.connect(lambda: self.set_open(not self.open))
        self._point()

    def set_words(self, words: str) -> None:
        """Call the part otherwise."""
        if words != self._words:
            self._words = words
            self.setAccessibleName(words)
            self.setToolTip(tooltip(words, self._hint))
            self._fit()

    def set_open(self, open_: bool) -> None:
        """Point down, to fields that are shown, or not."""
        if open_ != self.open:
            self.open = open_
            self._point()
            self.opened.emit(open_)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        name = meaning_of(self._place, event)
        if self._dragging and event.key() == Qt.Key.Key_Escape:
            self._let_go()
            self.given_up.emit()
        elif name:
            self.pressed_key.emit(name)
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._wants) or super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
        gives_up = self._dragging and event.key() == Qt.Key.Key_Escape
        return gives_up or bool(meaning_of(self._place, event))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        super().mousePressEvent(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._start_y = round(event.globalPosition().y())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        if self._start_y is None:
            return
        y = round(event.globalPosition().y())
        if not self._dragging and abs(y - self._start_y) >= QApplication.startDragDistance():
            self._dragging = True
            # It is dragged, not clicked.
            self.setDown(False)
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        if self._dragging:
            self.dragged.emit(y)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._dragging and event.button() == Qt.MouseButton.LeftButton:
            self._let_go()
            self.dropped.emit(round(event.globalPosition().y()))
            event.accept()
            return
        self._start_y = None
        super().mouseReleaseEvent(event)

    def _fit(self) -> None:
        room = max(self.width() - _BESIDE_PX, 0)
        text = self.fontMetrics().elidedText(self._words, Qt.TextElideMode.ElideRight, room)
        self.setText(text)

    def _let_go(self) -> None:
        self._start_y, self._dragging = None, False
        self.setDown(False)
        self.unsetCursor()

    def _point(self) -> None:
        self.setArrowType(Qt.ArrowType.DownArrow if self.open else Qt.ArrowType.RightArrow)
