"""Lamps in the status bar: conditions of the measurement, and whether the design keeps them."""

from itertools import islice
from typing import ClassVar

from PySide6.QtCore import QEvent, QPoint, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource.validity import Finding, Findings
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, scaled
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.lateness import Lateness

#: What lamps are called; the limb has words of its own beside them.
NAMES = {
    "band": "band",
    "drive": "drive",
    "spacing": "spacing",
    "noise": "SNR",
    "scaling": "scaling",
}
# Whose lamps have words, where there is less and less room: of the last one only the worst.
_SAID = (("left", "unknown", "kept"), ("left", "unknown"), ("left",), ())
_WORST = ("left", "unknown")
STATES = {"kept": "kept", "left": "caution", "unknown": "unknown"}
_OLDER = "updating: of an older design"
_NAME = "Validity of the prediction"
_DOT_PX, _TEXT, _PALE = 8.0, 0.92, 0.45


class ValidityLamps(QWidget):
    """A dot for each condition, and its name where there is room; that of the worst one always.

    Amber: left; a ring: nothing is known; a dim dot: kept.
    """

    #: The name of a lamp was chosen, and where its explanation shall stand, on the screen.
    chosen = Signal(str, QPoint)
    margin_px: ClassVar[int] = UNIT_PX // 2

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("validity_lamps")
        self.setAccessibleName(_NAME)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self._theme: Theme = LIGHT
        self.findings: Findings = ()
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._follow_lateness)

    @property
    def words_font(self) -> QFont:
        """Of the names, as large as letters are now."""
        return scaled(self.font(), _TEXT)

    @property
    def lamps(self) -> tuple[Finding, ...]:
        """What has a lamp, in their order."""
        return tuple(one for one in self.findings if one.name in NAMES)

    def show_findings(self, findings: Findings) -> None:
        """Take over what was found."""
        self._lateness.set_stale(False)
        if findings != self.findings:
            self.findings = findings
            self._describe()
            lit = sum(one.state == "left" for one in self.lamps)
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
        said = [f"{NAMES[one.name]}: {STATES[one.state]}" for one in self.lamps]
        self.setAccessibleDescription("; ".join([_OLDER] * self._lateness.late + said))

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(self._width(self._said(0)), QFontMetrics(self.words_font).height() + 2)

    def minimumSizeHint(self) -> QSize:
        return QSize(self._width(self._said(-1)), QFontMetrics(self.words_font).height() + 2)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            found = self._lamp_at(event.pos().x())
            words = "" if found is None else _words_of(found, late=self._lateness.late)
            QToolTip.showText(event.globalPos(), words, self)
            return True
        return super().event(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        found = self._lamp_at(round(event.position().x()))
        if event.button() == Qt.MouseButton.LeftButton and found is not None:
            self._choose(found)
        else:
            super().mousePressEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        keys = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space)
        if event.key() in keys and self.lamps:
            lit = (one for one in self.lamps if one.state == "left")
            self._choose(next(lit, self.lamps[0]))
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(self.words_font)
        painter.setOpacity(_PALE if self._lateness.late else 1.0)
        for finding, place in self._places():
            self._paint_lamp(painter, finding, place)
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), self._theme)
        painter.end()

    def _paint_lamp(self, painter: QPainter, finding: Finding, place: QRectF) -> None:
        theme = self._theme
        dot = QRectF(place.left(), place.center().y() - _DOT_PX / 2, _DOT_PX, _DOT_PX)
        if finding.state == "left":
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.warning))
        elif finding.state == "unknown":
            painter.setPen(QPen(QColor(theme.dim), 1.2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
        else:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.border))
        painter.drawEllipse(dot.adjusted(0.5, 0.5, -0.5, -0.5))
        if place.width() > _DOT_PX + 1:
            painter.setPen(QColor(theme.warning if finding.state == "left" else theme.dim))
            words = place.adjusted(_DOT_PX + 3, 0, 0, 0)
            painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, NAMES[finding.name])

    def _places(self) -> list[tuple[Finding, QRectF]]:
        """Where each lamp stands, with its words if there is room for them."""
        rows = [self._said(k) for k in range(len(_SAID))]
        words = next((one for one in rows if self._width(one) <= self.width()), rows[-1])
        found, x = [], float(self.margin_px)
        for one in self.lamps:
            wide = self._lamp_width(one, words)
            found.append((one, QRectF(x, 0, wide, self.height())))
            x += wide + UNIT_PX
        return found

    def _lamp_at(self, x_px: int) -> Finding | None:
        near = (
            (abs(place.center().x() - x_px) - place.width() / 2, one.name, one)
            for one, place in self._places()
        )
        best = min(near, default=None)
        return None if best is None or best[0] > UNIT_PX else best[2]

    def _said(self, row: int) -> frozenset[str]:
        """Names of the lamps that have words in a row of the table, the worst one among them."""
        lamps = self.lamps
        said = {one.name for one in lamps if one.state in _SAID[row]}
        worst = (one.name for state in _WORST for one in lamps if one.state == state)
        return frozenset(said | set(islice(worst, 1)))

    def _lamp_width(self, one: Finding, words: frozenset[str]) -> float:
        if one.name not in words:
            return _DOT_PX
        return _DOT_PX + 4 + QFontMetrics(self.words_font).horizontalAdvance(NAMES[one.name])

    def _width(self, words: frozenset[str]) -> int:
        lamps = self.lamps
        if not lamps:
            return 0
        wide = sum(self._lamp_width(one, words) for one in lamps)
        return round(wide + UNIT_PX * (len(lamps) - 1) + 2 * self.margin_px)

    def _choose(self, finding: Finding) -> None:
        self.chosen.emit(finding.name, self.mapToGlobal(QPoint(0, 0)))


def _words_of(finding: Finding, *, late: bool = False) -> str:
    name = NAMES[finding.name]
    head = f"{name[:1].upper()}{name[1:]}: {STATES[finding.state]}"
    head = f"{head} · {_OLDER}" if late else head
    return f"{head}\n{finding.sentence}\nClick to see what can be done."
