"""Names of curves, each with what the crosshair reads there."""

from PySide6.QtCore import QEvent, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QFontMetrics, QHelpEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, tabular
from skinsource_gui.widgets.curves import CurveName

STRIP_HEIGHT_PX = 20
_SWATCH_PX = 10
_GAP_PX = 4
# The widest digits of a reading; the strip keeps its places while numbers change.
_ROOM = "\u22120.0000"


class LegendStrip(QWidget):
    """One line: colour, number, place and reading of each curve, and where they are read.

    Where the line is too narrow it leaves out units, then places, then curves; the tooltip has
    them all.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("legend")
        self.setAccessibleName("Curves and readings")
        self.setFixedHeight(STRIP_HEIGHT_PX)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setFont(tabular(self.font()))
        self._theme = LIGHT
        self._names: tuple[CurveName, ...] = ()
        self._readings: tuple[str, ...] = ()
        self._where = ""
        self._unit = ""
        self._where_room = ""

    def set_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def set_curves(self, names: tuple[CurveName, ...], unit: str, where_room: str) -> None:
        """Name the curves.  ``unit`` is that of readings, ``where_room`` the widest place."""
        if (names, unit, where_room) == (self._names, self._unit, self._where_room):
            return
        if len(names) != len(self._names):
            self._readings = ()
        self._names, self._unit, self._where_room = names, unit, where_room
        self.update()

    def set_readings(self, where: str, readings: tuple[str, ...]) -> None:
        """Show what is read, or nothing (``""``, ``()``)."""
        if (where, readings) == (self._where, self._readings):
            return
        self._where, self._readings = where, readings
        self.setAccessibleDescription(self.text())
        self.update()

    def text(self) -> str:
        """Everything the strip has to say, one line for each curve."""
        lines = [f"at {self._where}"] if self._where else []
        for rank, name in enumerate(self._names):
            lines.append(f"{name.number}  {name.full}{self._reading(rank, ': ')}")
        return "\n".join(lines)

    def minimumSizeHint(self) -> QSize:
        return QSize(120, STRIP_HEIGHT_PX)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self.text(), self)
            return True
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        if not self._names:
            return
        painter = QPainter(self)
        metrics = QFontMetrics(self.font())
        detail, fitting = self._fit(metrics)
        x = UNIT_PX // 2
        for rank in range(fitting):
            x = self._paint_entry(painter, metrics, x, rank, detail)
        hidden = len(self._names) - fitting
        if hidden:
            painter.setPen(QPen(self._theme.dim))
            self._write(painter, metrics, x, f"+{hidden}")
        if self._where:
            painter.setPen(QPen(self._theme.text))
            place = self.rect().adjusted(0, 0, -UNIT_PX // 2, 0)
            painter.drawText(
                place,
                Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter,
                self._where_text(self._where, detail),
            )

    def _reading(self, rank: int, before: str) -> str:
        if rank >= len(self._readings):
            return ""
        return f"{before}{self._readings[rank]} {self._unit}"

    def _where_text(self, where: str, detail: int) -> str:
        # The unit is said once where entries have no room for it.
        return where if detail < 1 else f"{where} · {self._unit}"

    def _fit(self, metrics: QFontMetrics) -> tuple[int, int]:
        # Detail 0 has everything, 1 no units, 2 neither units nor places.
        widths: list[int] = []
        room_px = 0
        for detail in range(3):
            where = self._where_text(self._where_room, detail)
            room_px = self.width() - 2 * UNIT_PX - metrics.horizontalAdvance(where)
            widths = [self._entry_px(metrics, rank, detail) for rank in range(len(self._names))]
            if sum(widths) <= room_px:
                return detail, len(widths)
        room_px -= metrics.horizontalAdvance("+00")
        fitting = 0
        while fitting < len(widths) and sum(widths[: fitting + 1]) <= room_px:
            fitting += 1
        return 2, fitting

    def _entry_px(self, metrics: QFontMetrics, rank: int, detail: int) -> int:
        name = self._names[rank]
        words = [str(name.number), _ROOM]
        if detail < 2:
            words.append(name.short)
        if detail < 1:
            words.append(self._unit)
        gaps = _GAP_PX * len(words) + UNIT_PX
        return _SWATCH_PX + gaps + sum(metrics.horizontalAdvance(word) for word in words)

    def _paint_entry(
        self, painter: QPainter, metrics: QFontMetrics, x: int, rank: int, detail: int
    ) -> int:
        name, end = self._names[rank], x + self._entry_px(metrics, rank, detail)
        colour = self._theme.output_colour(rank)
        painter.setPen(QPen(colour, 2))
        middle = self.height() / 2
        painter.drawLine(QPointF(x, middle), QPointF(x + _SWATCH_PX - 1, middle))
        x += _SWATCH_PX + _GAP_PX
        painter.setPen(QPen(self._theme.text))
        x = self._write(painter, metrics, x, str(name.number))
        if detail < 2:
            painter.setPen(QPen(self._theme.dim))
            x = self._write(painter, metrics, x, name.short)
        if rank < len(self._readings):
            painter.setPen(QPen(self._theme.text))
            reading = self._readings[rank]
            x += max(0, metrics.horizontalAdvance(_ROOM) - metrics.horizontalAdvance(reading))
            x = self._write(painter, metrics, x, reading)
            if detail < 1:
                painter.setPen(QPen(self._theme.dim))
                self._write(painter, metrics, x, self._unit)
        return end

    def _write(self, painter: QPainter, metrics: QFontMetrics, x: int, text: str) -> int:
        width = metrics.horizontalAdvance(text)
        place = QRect(x, 0, width + 1, self.height())
        painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, text)
        return x + width + _GAP_PX
