"""Lamps in a row, and which of them have words where there is more or less room."""

from dataclasses import dataclass
from itertools import islice

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPen

from skinsource.perception.validity import Finding, Findings
from skinsource_gui.theme import UNIT_PX, Theme

#: What lamps are called; the limb has words of its own beside them.
NAMES = {
    "inputs": "inputs",
    "band": "band",
    "drive": "drive",
    "spacing": "spacing",
    "noise": "SNR",
    "scaling": "scaling",
}
# Whose lamps have words, where there is less and less room: of the last one only the worst.
_SAID = (("left", "unknown", "kept"), ("left", "unknown"), ("left",), ())
_WORST = ("left", "unknown")
_DOT_PX, _MARGIN_PX = 8.0, UNIT_PX // 2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LampRow:
    """A dot for each condition, and its name where there is room; that of the worst one always.

    Attributes
    ----------
    findings
        What was found; those that have a name here have a lamp.
    metrics
        Of the names.
    """

    findings: Findings
    metrics: QFontMetrics

    @property
    def lamps(self) -> tuple[Finding, ...]:
        """What has a lamp, in their order."""
        return tuple(one for one in self.findings if one.name in NAMES)

    @property
    def whole_px(self) -> int:
        """Width in which all have words."""
        return self._width(self._said(0))

    @property
    def least_px(self) -> int:
        """Width in which the worst one alone has words."""
        return self._width(self._said(-1))

    def places(self, room: QRectF) -> list[tuple[Finding, QRectF]]:
        """Where each lamp stands, with its words if there is room for them."""
        rows = [self._said(k) for k in range(len(_SAID))]
        words = next((one for one in rows if self._width(one) <= room.width()), rows[-1])
        found, x = [], room.left() + _MARGIN_PX
        for one in self.lamps:
            wide = self._lamp_width(one, words)
            found.append((one, QRectF(x, room.top(), wide, room.height())))
            x += wide + UNIT_PX
        return found

    def at(self, x_px: float, room: QRectF) -> Finding | None:
        """The lamp that is meant there."""
        near = (
            (abs(place.center().x() - x_px) - place.width() / 2, one.name, one)
            for one, place in self.places(room)
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
        return _DOT_PX + 4 + self.metrics.horizontalAdvance(NAMES[one.name])

    def _width(self, words: frozenset[str]) -> int:
        lamps = self.lamps
        if not lamps:
            return 0
        wide = sum(self._lamp_width(one, words) for one in lamps)
        return round(wide + UNIT_PX * (len(lamps) - 1) + 2 * _MARGIN_PX)


def paint_lamp(painter: QPainter, finding: Finding, place: QRectF, theme: Theme) -> None:
    """Draw a lamp, and its name where its place is wide enough.

    Amber: left; a ring: nothing is known; a dim dot: kept.
    """
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
