"""All of a recording in a strip, and the part of it that is taken."""

import numpy as np
from PySide6.QtCore import QLineF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.arrays import Floats
from skinsource_gui.theme import LIGHT, Theme

_HEIGHT_PX = 44
_HANDLE_PX = 6
_SHADE_ALPHA = 46
_LEAST_PX = 3.0


class OverviewStrip(QWidget):
    """A drag moves the part, or one of its ends; where all is taken, it chooses a part.

    A double click takes all.

    Parameters
    ----------
    longest_s
        Of the part.
    """

    #: Start and length of the part that is wanted, s.
    part_wanted = Signal(float, float)

    def __init__(self, longest_s: float, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._longest_s = longest_s
        self._theme = LIGHT
        self._extremes: Floats | None = None
        self._lasts_s = 1.0
        self._part_s = (0.0, 1.0)
        self._landmarks_s: Floats | None = None
        self._held: tuple[str, float] | None = None
        self.setObjectName("import_overview")
        self.setAccessibleName("Whole recording; type the part in Start and Length")
        self.setToolTip(
            "The whole recording: drag over what is to be taken; drag that or one of its ends to "
            "change it; double click to take all"
        )
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        return QSize(400, _HEIGHT_PX)

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    @property
    def extremes(self) -> Floats | None:
        """What is drawn, (2, columns)."""
        return self._extremes

    def show_extremes(self, extremes: Floats | None) -> None:
        """Draw least and largest of each stretch, (2, columns); nothing while unknown."""
        self._extremes = extremes
        self.update()

    def show_landmarks(self, landmarks_s: Floats | None) -> None:
        """Take over when samples were that are evenly chosen among all; None: at a steady rate."""
        self._landmarks_s = landmarks_s
        self.update()

    def show_part(self, lasts_s: float, start_s: float, duration_s: float) -> None:
        """Mark the part of a recording of that length."""
        self._lasts_s = lasts_s
        self._part_s = (start_s, min(start_s + duration_s, lasts_s))
        self.update()

    def x_of(self, time_s: float) -> float:
        """Where a time lies, px."""
        return self.width() * time_s / self._lasts_s

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.base))
        if self._extremes is not None:
            self._paint_extremes(painter, self._extremes)
        start, end = (self.x_of(time_s) for time_s in self._part_s)
        part = QRectF(start, 0.0, max(end - start, _LEAST_PX), self.height())
        shade = QColor(self._theme.accent)
        painter.setPen(QPen(shade, 2))
        shade.setAlpha(_SHADE_ALPHA)
        painter.fillRect(part, shade)
        painter.drawLine(QLineF(part.topLeft(), part.bottomLeft()))
        painter.drawLine(QLineF(part.topRight(), part.bottomRight()))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton:
            return
        x = event.position().x()
        end = self._end_at(x)
        start_s, end_s = self._part_s
        if end:
            self._held = (end, 0.0)
        elif self._all_is_taken:
            self._held = ("new", self._time_of(x))
        elif self.x_of(start_s) <= x <= self.x_of(end_s):
            self._held = ("part", self._time_of(x) - start_s)
        else:
            self._held = ("part", (end_s - start_s) / 2.0)
            self._drag(x)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        x = event.position().x()
        if self._held is not None:
            self._drag(x)
        else:
            over = Qt.CursorShape.SizeHorCursor if self._end_at(x) else Qt.CursorShape.ArrowCursor
            self.setCursor(over)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._held = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self._held = None
        self._want(0.0, min(self._lasts_s, self._longest_s))

    @property
    def _all_is_taken(self) -> bool:
        start_s, end_s = self._part_s
        return self.x_of(start_s) < 1.0 and self.x_of(end_s) > self.width() - 1.0

    def _end_at(self, x: float) -> str:
        ends = zip(("start", "end"), self._part_s, strict=True)
        near = [name for name, at_s in ends if abs(self.x_of(at_s) - x) <= _HANDLE_PX]
        return near[-1] if near else ""

    def _time_of(self, x: float) -> float:
        return min(max(x / max(self.width(), 1), 0.0), 1.0) * self._lasts_s

    def _drag(self, x: float) -> None:
        held, offset_s = self._held or ("part", 0.0)
        start_s, end_s = self._part_s
        least_s = self._lasts_s / max(self.width(), 1)
        at_s = self._time_of(x)
        if held == "new":
            if abs(self.x_of(at_s) - self.x_of(offset_s)) < _LEAST_PX:
                return
            at_s = min(max(at_s, offset_s - self._longest_s), offset_s + self._longest_s)
            start_s, end_s = sorted((offset_s, at_s))
        elif held == "start":
            start_s = min(max(at_s, end_s - self._longest_s), end_s - least_s)
        elif held == "end":
            end_s = max(min(at_s, start_s + self._longest_s), start_s + least_s)
        else:
            length_s = end_s - start_s
            start_s = min(max(at_s - offset_s, 0.0), self._lasts_s - length_s)
            end_s = start_s + length_s
        self._want(max(start_s, 0.0), end_s)

    def _want(self, start_s: float, end_s: float) -> None:
        self._part_s = (start_s, end_s)
        self.update()
        self.part_wanted.emit(start_s, end_s - start_s)

    def _paint_extremes(self, painter: QPainter, extremes: Floats) -> None:
        # An offset would leave no room for what is heard.
        known = np.nan_to_num(extremes - np.nanmean(np.nan_to_num(extremes)))
        largest = max(float(np.abs(known).max()), np.finfo(np.float64).tiny)
        middle, reach = self.height() / 2.0, self.height() / 2.0 - 2.0
        columns = extremes.shape[1]
        share = (np.arange(columns) + 0.5) / columns
        if self._landmarks_s is not None:
            among = np.linspace(0.0, 1.0, self._landmarks_s.size)
            share = np.interp(share, among, self._landmarks_s) / self._lasts_s
        x = share * self.width()
        tops, bottoms = middle - reach * known[1] / largest, middle - reach * known[0] / largest
        painter.setPen(QPen(QColor(self._theme.dim), 1))
        painter.drawLines(
            [
                QLineF(at, top, at, max(bottom, top + 1.0))
                for at, top, bottom in zip(x, tops, bottoms, strict=True)
            ]
        )
