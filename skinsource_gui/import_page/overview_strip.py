"""All of a recording in a strip, and the part of it that is taken."""

import numpy as np
from PySide6.QtCore import QLineF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.arrays import Floats
from skinsource_gui.import_page.taken_part import TakenPart
from skinsource_gui.theme import current_theme

_HEIGHT_PX = 44
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
        self._extremes: Floats | None = None
        self._landmarks_s: Floats | None = None
        self._part = TakenPart(longest_s, self.width)
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
        self._part.show(lasts_s, start_s, duration_s)
        self.update()

    def x_of(self, time_s: float) -> float:
        """Where a time lies, px."""
        return self._part.x_of(time_s)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(current_theme().base))
        if self._extremes is not None:
            self._paint_extremes(painter, self._extremes)
        start, end = self.x_of(self._part.start_s), self.x_of(self._part.end_s)
        part = QRectF(start, 0.0, max(end - start, _LEAST_PX), self.height())
        shade = QColor(current_theme().accent)
        painter.setPen(QPen(shade, 2))
        shade.setAlpha(_SHADE_ALPHA)
        painter.fillRect(part, shade)
        painter.drawLine(QLineF(part.topLeft(), part.bottomLeft()))
        painter.drawLine(QLineF(part.topRight(), part.bottomRight()))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self._part.hold(event.position().x()):
            self._tell()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        x = event.position().x()
        if not self._part.held:
            over_end = bool(self._part.end_at(x))
            self.setCursor(Qt.CursorShape.SizeHorCursor if over_end else Qt.CursorShape.ArrowCursor)
        elif self._part.drag(x):
            self._tell()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._part.let_go()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self._part.let_go()
        self._part.take_all()
        self._tell()

    def _tell(self) -> None:
        self.update()
        start_s, end_s = self._part.start_s, self._part.end_s
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
            share = np.interp(share, among, self._landmarks_s) / self._part.lasts_s
        x = share * self.width()
        tops, bottoms = middle - reach * known[1] / largest, middle - reach * known[0] / largest
        painter.setPen(QPen(QColor(current_theme().dim), 1))
        painter.drawLines(
            [
                QLineF(at, top, at, max(bottom, top + 1.0))
                for at, top, bottom in zip(x, tops, bottoms, strict=True)
            ]
        )
