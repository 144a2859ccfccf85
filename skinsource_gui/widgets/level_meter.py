"""How loud an output is, as a bar."""

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource_gui.theme import current_theme

#: The left end of the bar, dB of full scale; the right end is full scale.
LEAST_DB = -60.0
# From here on the limit is near.
_NEAR_DB = -3.0
_TICK_PX = 2.0


class LevelMeter(QWidget):
    """RMS as a bar, the peak as a tick; both in dB of full scale."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rms_db = self.peak_db = -200.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.show_level(-200.0, -200.0)

    def sizeHint(self) -> QSize:
        return QSize(80, 8)

    def show_level(self, rms_db: float, peak_db: float) -> None:
        """Show another level; paints only where it can be seen that it is one."""
        width = max(self.width(), 1)
        before = [_share(one) * width for one in (self.rms_db, self.peak_db)]
        after = [_share(one) * width for one in (rms_db, peak_db)]
        self.rms_db, self.peak_db = rms_db, peak_db
        if any(abs(a - b) >= 0.5 for a, b in zip(after, before, strict=True)):
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        room = QRectF(self.rect())
        painter.fillRect(room, QColor(current_theme().grid))
        colour = current_theme().warning if self.peak_db > _NEAR_DB else current_theme().accent
        bar = QRectF(room)
        bar.setWidth(_share(self.rms_db) * room.width())
        painter.fillRect(bar, QColor(colour))
        peak = _share(self.peak_db)
        if peak > 0.0:
            x = max(peak * room.width() - _TICK_PX, 0.0)
            painter.fillRect(QRectF(x, 0.0, _TICK_PX, room.height()), QColor(colour))


def _share(level_db: float) -> float:
    """How far along the bar a level lies."""
    return min(max(1.0 - level_db / LEAST_DB, 0.0), 1.0)
