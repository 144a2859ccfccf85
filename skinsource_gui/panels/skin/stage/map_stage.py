"""What part of the map is seen, and where everything lies."""

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Signal
from PySide6.QtGui import QFont, QFontMetricsF
from PySide6.QtWidgets import QWidget

from skinsource.limbs.limb import LimbMap
from skinsource_gui.panels.skin.map_painter import letters_for, small_font
from skinsource_gui.panels.skin.stage.map_layout import (
    HAND,
    MapLayout,
    SeenPart,
    fitted_beside_cards,
    hand_bounds,
    map_layout,
    outline_bounds,
    seen_part,
)
from skinsource_gui.widgets.pan_zoom import FREE, WHOLE, PanZoom


class MapStage(QObject):
    """Fits the map of a limb into a widget, and lays it out wherever it is panned and zoomed to.

    Parameters
    ----------
    widget
        Where it is drawn, in small letters of its font, or smaller ones.

    Attributes
    ----------
    pan_zoom
        What part of it is seen.
    layout
        Screen places of everything; None before there is a limb.
    """

    #: Everything lies elsewhere.
    changed = Signal()

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self._widget = widget
        self._limb_map: LimbMap | None = None
        self.layout: MapLayout | None = None
        self.pan_zoom = PanZoom(widget)
        self.pan_zoom.changed.connect(self._lay_out)

    @property
    def letters(self) -> QFont:
        """Those of messages on it; labels have small ones."""
        return letters_for(self._widget.font(), self._room)

    @property
    def seen(self) -> SeenPart:
        """What part of the map is in sight."""
        return seen_part(self.pan_zoom, self._room)

    def place_of(self, number: int) -> QPointF:
        """Where an output is drawn; nowhere before there is a limb."""
        return QPointF() if self.layout is None else QPointF(*self.layout.points[number - 1])

    def show_limb(self, limb_map: LimbMap | None) -> None:
        """Take another limb, which is fitted anew."""
        self._limb_map = limb_map
        if self.pan_zoom.fit == FREE:
            self.pan_zoom.fit = WHOLE
        self.fit()

    def fit(self) -> None:
        """Fit the limb into the widget, which has another size."""
        limb_map, room = self._limb_map, self._room
        if limb_map is None:
            self.pan_zoom.arrange({}, np.zeros((0, 2)), room)
            return
        fits = {
            WHOLE: fitted_beside_cards(limb_map, outline_bounds(limb_map), room, self._metrics),
            HAND: fitted_beside_cards(limb_map, hand_bounds(limb_map), room, self._metrics),
        }
        self.pan_zoom.arrange(fits, limb_map.outline, room)

    def _lay_out(self) -> None:
        frame, self.layout = self.pan_zoom.frame, None
        if frame is not None and self._limb_map is not None:
            self.layout = map_layout(self._limb_map, frame, self._room, self._metrics)
        self.changed.emit()

    @property
    def _room(self) -> QRectF:
        return QRectF(self._widget.rect())

    @property
    def _metrics(self) -> QFontMetricsF:
        return QFontMetricsF(small_font(self.letters))
