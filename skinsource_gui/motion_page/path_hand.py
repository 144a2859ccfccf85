"""The hand on which a path of places is clicked."""

from itertools import pairwise

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.hand.drawings import drawing_of
from skinsource_gui.panels.hand.hand_diagram import HandDiagram
from skinsource_gui.panels.hand.site_marker import Place, paint_occupied
from skinsource_gui.theme import Theme, tabular

_ARROW_PX = 9.0
_BADGE_PX = 15.0


class PathHand(HandDiagram):
    """The hand without inputs; a click on a place, or Enter there, adds it to the path."""

    #: Number of a place.
    place_added = Signal(int)
    last_removed = Signal()

    def __init__(self, limb: str, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(drawing_of(limb), theme, parent)
        self._path: tuple[int, ...] = ()
        self._theme, self._colours = theme, {}
        self.setObjectName("path_hand")
        self.setAccessibleName("Path on the hand, palm side")
        self.add_requested.connect(self.place_added)
        self.add_besides_requested.connect(self.place_added)
        self.remove_requested.connect(self.last_removed)

    def show_path(self, path: tuple[int, ...], colours: dict[int, QColor]) -> None:
        """Show a path, and the colour of the track of each of its places."""
        self._path, self._colours = path, colours
        self.update()

    def show_theme(self, theme: Theme) -> None:
        self._theme = theme
        super().show_theme(theme)

    def sizeHint(self) -> QSize:
        return QSize(300, 380)

    def paintEvent(self, event) -> None:
        super().paintEvent(event)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        on_hand = [place for place in self._path if self.hand.has(place)]
        for place in dict.fromkeys(on_hand):
            self._paint_place(painter, place)
        for here, there in pairwise(on_hand):
            self._paint_leg(painter, here, there)
        for place in dict.fromkeys(on_hand):
            self._paint_order(painter, place)
        painter.end()

    def _paint_place(self, painter: QPainter, site: int) -> None:
        place = Place(
            site=site,
            centre=self.hand.centre(site),
            radius_px=self.hand.radius_px,
            push=self.hand.push(site),
        )
        colour = self._colours.get(site, QColor(self._theme.accent))
        paint_occupied(painter, place, self._theme, [colour], silent=False)

    def _paint_leg(self, painter: QPainter, here: int, there: int) -> None:
        if here == there:
            return
        way = self.hand.centre(there) - self.hand.centre(here)
        length = (way.x() ** 2 + way.y() ** 2) ** 0.5
        unit = way / length
        across = QPointF(-unit.y(), unit.x())
        start = self.hand.centre(here) + unit * (self.hand.radius_px + 1.0)
        tip = self.hand.centre(there) - unit * (self.hand.radius_px + 1.0)
        base = tip - unit * _ARROW_PX
        half = across * (0.5 * _ARROW_PX)
        for colour, width in ((self._theme.base, 5.0), (self._theme.accent, 2.0)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(start, base)
        painter.setPen(QPen(QColor(self._theme.base), 1.0))
        painter.setBrush(QColor(self._theme.accent))
        painter.drawPolygon(QPolygonF([tip, base + half, base - half]))

    def _paint_order(self, painter: QPainter, site: int) -> None:
        turns = [str(k) for k, place in enumerate(self._path, 1) if place == site]
        words = ",".join(turns[:3]) + ("…" if len(turns) > 3 else "")
        font = tabular(self.font())
        font.setPixelSize(11)
        painter.setFont(font)
        width = max(painter.fontMetrics().horizontalAdvance(words) + 6.0, _BADGE_PX)
        corner = self.hand.centre(site) + QPointF(0.75, -0.75) * self.hand.radius_px
        area = QRectF(corner.x() - _BADGE_PX / 2, corner.y() - _BADGE_PX / 2, width, _BADGE_PX)
        painter.setPen(QPen(QColor(self._theme.accent), 1.0))
        painter.setBrush(QColor(self._theme.base))
        painter.drawRoundedRect(area, _BADGE_PX / 2, _BADGE_PX / 2)
        painter.setPen(QColor(self._theme.text))
        painter.drawText(area, Qt.AlignmentFlag.AlignCenter, words)
