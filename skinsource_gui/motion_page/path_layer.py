"""The path of places over the hand on which it is clicked."""

from itertools import pairwise

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.hand.hand_diagram import HandDiagram
from skinsource_gui.panels.hand.hand_layout import HandLayout
from skinsource_gui.panels.hand.site_marker import Place, paint_occupied
from skinsource_gui.theme import current_theme, tabular

_ARROW_PX = 9.0
_BADGE_PX = 15.0


class PathLayer(QWidget):
    """Lies over a hand, paints a path of places there, and leaves the pointer to the hand."""

    def __init__(self, hand: HandDiagram) -> None:
        super().__init__(hand)
        self._hand = hand
        self._path: tuple[int, ...] = ()
        self._colours: dict[int, QColor] = {}
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        # Zoomed or moved, the places are elsewhere.
        hand.stage.changed.connect(self.update)
        hand.installEventFilter(self)
        self.setGeometry(hand.rect())

    def show_path(self, path: tuple[int, ...], colours: dict[int, QColor]) -> None:
        """Show a path, and the colour of the track of each of its places."""
        self._path, self._colours = path, colours
        self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._hand and event.type() == QEvent.Type.Resize:
            self.setGeometry(self._hand.rect())
        return super().eventFilter(watched, event)

    @property
    def _places(self) -> HandLayout:
        return self._hand.stage.layout

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        on_hand = [place for place in self._path if self._places.has(place)]
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
            centre=self._places.centre(site),
            radius_px=self._places.radius_in_use_px(site),
            push=self._places.push(site),
        )
        colour = self._colours.get(site, QColor(current_theme().accent))
        paint_occupied(painter, place, current_theme(), [colour], silent=False)

    def _paint_leg(self, painter: QPainter, here: int, there: int) -> None:
        if here == there:
            return
        way = self._places.centre(there) - self._places.centre(here)
        length = (way.x() ** 2 + way.y() ** 2) ** 0.5
        unit = way / length
        across = QPointF(-unit.y(), unit.x())
        start = self._places.centre(here) + unit * (self._places.radius_in_use_px(here) + 1.0)
        tip = self._places.centre(there) - unit * (self._places.radius_in_use_px(there) + 1.0)
        base = tip - unit * _ARROW_PX
        half = across * (0.5 * _ARROW_PX)
        for colour, width in ((current_theme().base, 5.0), (current_theme().accent, 2.0)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(start, base)
        painter.setPen(QPen(QColor(current_theme().base), 1.0))
        painter.setBrush(QColor(current_theme().accent))
        painter.drawPolygon(QPolygonF([tip, base + half, base - half]))

    def _paint_order(self, painter: QPainter, site: int) -> None:
        turns = [str(k) for k, place in enumerate(self._path, 1) if place == site]
        words = ",".join(turns[:3]) + ("…" if len(turns) > 3 else "")
        font = tabular(self.font())
        font.setPixelSize(11)
        painter.setFont(font)
        width = max(painter.fontMetrics().horizontalAdvance(words) + 6.0, _BADGE_PX)
        off = 0.75 * self._places.radius_in_use_px(site)
        corner = self._places.centre(site) + QPointF(off, -off)
        area = QRectF(corner.x() - _BADGE_PX / 2, corner.y() - _BADGE_PX / 2, width, _BADGE_PX)
        painter.setPen(QPen(QColor(current_theme().accent), 1.0))
        painter.setBrush(QColor(current_theme().base))
        painter.drawRoundedRect(area, _BADGE_PX / 2, _BADGE_PX / 2)
        painter.setPen(QColor(current_theme().text))
        painter.drawText(area, Qt.AlignmentFlag.AlignCenter, words)
