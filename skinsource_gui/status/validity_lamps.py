"""Lamps in the status bar: conditions of the measurement, and whether the design keeps them."""

from PySide6.QtCore import QEvent, QPoint, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QFont,
    QFontMetrics,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource.perception.validity import Finding, Findings
from skinsource_gui.status.lamp_row import NAMES, LampRow, paint_lamp
from skinsource_gui.theme import current_theme, scaled
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.lateness import Lateness

STATES = {"kept": "kept", "left": "caution", "unknown": "unknown"}
_OLDER = "updating: of an older design"
_NAME = "Validity of the prediction"
_TEXT, _PALE = 0.92, 0.45


class ValidityLamps(QWidget):
    """Shows a `LampRow`, tells which lamp is meant, and says what is of an older design."""

    #: The name of a lamp was chosen, and where its explanation shall stand, on the screen.
    chosen = Signal(str, QPoint)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("validity_lamps")
        self.setAccessibleName(_NAME)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.findings: Findings = ()
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._follow_lateness)

    @property
    def words_font(self) -> QFont:
        """Of the names, as large as letters are now."""
        return scaled(self.font(), _TEXT)

    @property
    def row(self) -> LampRow:
        """What was found, in letters of the present size."""
        return LampRow(findings=self.findings, metrics=QFontMetrics(self.words_font))

    @property
    def places(self) -> list[tuple[Finding, QRectF]]:
        """Where each lamp stands."""
        return self.row.places(QRectF(self.rect()))

    def show_findings(self, findings: Findings) -> None:
        """Take over what was found."""
        self._lateness.set_stale(False)
        if findings != self.findings:
            self.findings = findings
            self._describe()
            lit = sum(one.state == "left" for one in self.row.lamps)
            self.setAccessibleName(f"{_NAME}: {lit or 'no'} caution{'' if lit == 1 else 's'}")
            self.updateGeometry()
        self.update()

    def set_stale(self, stale: bool) -> None:
        """Say whether what was found belongs to an older design; told after a while."""
        self._lateness.set_stale(stale)

    def _follow_lateness(self) -> None:
        self._describe()
        self.update()

    def _describe(self) -> None:
        said = [f"{NAMES[one.name]}: {STATES[one.state]}" for one in self.row.lamps]
        self.setAccessibleDescription("; ".join([_OLDER] * self._lateness.late + said))

    def sizeHint(self) -> QSize:
        return self._size(self.row.whole_px)

    def minimumSizeHint(self) -> QSize:
        return self._size(self.row.least_px)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            found = self.row.at(event.pos().x(), QRectF(self.rect()))
            words = "" if found is None else _words_of(found, late=self._lateness.late)
            QToolTip.showText(event.globalPos(), words, self)
            return True
        return super().event(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        found = self.row.at(event.position().x(), QRectF(self.rect()))
        if event.button() == Qt.MouseButton.LeftButton and found is not None:
            self._choose(found)
        else:
            super().mousePressEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        keys = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space)
        if event.key() in keys and (lamps := self.row.lamps):
            lit = (one for one in lamps if one.state == "left")
            self._choose(next(lit, lamps[0]))
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(self.words_font)
        painter.setOpacity(_PALE if self._lateness.late else 1.0)
        for finding, place in self.places:
            paint_lamp(painter, finding, place, current_theme())
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())
        painter.end()

    def _size(self, width_px: int) -> QSize:
        return QSize(width_px, QFontMetrics(self.words_font).height() + 2)

    def _choose(self, finding: Finding) -> None:
        self.chosen.emit(finding.name, self.mapToGlobal(QPoint(0, 0)))


def _words_of(finding: Finding, *, late: bool = False) -> str:
    name = NAMES[finding.name]
    head = f"{name[:1].upper()}{name[1:]}: {STATES[finding.state]}"
    head = f"{head} · {_OLDER}" if late else head
    return f"{head}\n{finding.sentence}\nClick to see what can be done."
