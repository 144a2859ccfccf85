"""What the hand shows at present, and what part of it is seen."""

from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Signal
from PySide6.QtGui import QFontMetricsF, QPainter
from PySide6.QtWidgets import QWidget

from skinsource.limbs.locations import input_words
from skinsource_gui.panels.hand.caption import HINT
from skinsource_gui.panels.hand.hand_drawing import HandDrawing
from skinsource_gui.panels.hand.hand_layout import HandLayout, fitted_hand, hand_layout
from skinsource_gui.panels.hand.hand_picture import HandPicture
from skinsource_gui.panels.hand.hand_state import HandState
from skinsource_gui.widgets.pan_zoom import WHOLE, PanZoom
from skinsource_gui.widgets.paper import is_on_paper

_CONTACTS = {
    "perpendicular": "perpendicular: pushes into the skin",
    "in-axis": "in-axis: pushes along the digit",
}


class HandStage(QObject):
    """The hand with its inputs, in pictures and in words, and where its sites are.

    Parameters
    ----------
    drawing
        The hand.
    widget
        Where it is painted.

    Attributes
    ----------
    state
        What is shown.
    layout
        Where the sites are, in pixels of the widget.
    pan_zoom
        What part of the hand is seen.
    """

    #: It looks different.
    changed = Signal()

    def __init__(self, drawing: HandDrawing, widget: QWidget) -> None:
        super().__init__(widget)
        self._drawing, self._outline = drawing, _points_of(drawing)
        self._picture = HandPicture(drawing)
        self.state = HandState()
        self.layout: HandLayout = hand_layout(drawing, fitted_hand(drawing, self._picture.area))
        self.pan_zoom = PanZoom(widget)
        self.pan_zoom.changed.connect(self._lay_out)

    @property
    def drawing(self) -> HandDrawing:
        """The hand."""
        return self._drawing

    def show_drawing(self, drawing: HandDrawing, widget: QWidget) -> None:
        """Take another hand, which has other sites."""
        if drawing is not self._drawing:
            self._drawing, self._outline = drawing, _points_of(drawing)
            self._picture.show_drawing(drawing)
            self.state = replace(self.state, hovered=None, cursor=None, target=None)
            self.layout = hand_layout(drawing, fitted_hand(drawing, self._picture.area))
            self.fit(widget)
            self.pan_zoom.show(WHOLE)
            self.changed.emit()

    def change(self, **changes: Any) -> None:
        """Replace fields of the state, and tell if that makes a difference."""
        changed = replace(self.state, **changes)
        if changed != self.state:
            self.state = changed
            self.changed.emit()

    def fit(self, widget: QWidget) -> None:
        """Fit the hand into the widget, which has another size or font."""
        self._picture.resize(widget.size(), QFontMetricsF(widget.font()))
        area = self._picture.area
        fits = {WHOLE: fitted_hand(self._drawing, area)}
        self.pan_zoom.arrange(fits, self._outline, area)

    def paint(self, painter: QPainter, ratio: float) -> None:
        """Paint all; ``ratio`` is device pixels per widget pixel."""
        state = self.state
        if is_on_paper():
            # Neither mouse nor keys are anywhere.
            state = replace(state, hovered=None, cursor=None, target=None)
        self._picture.paint(painter, self.layout, state, ratio)

    def site_at(self, position: QPointF) -> int | None:
        """Site under the mouse; what is magnified beyond the picture cannot be hit."""
        inside = self._picture.area.adjusted(0, -2, 0, float(self.layout.radii_px.max()))
        return self.layout.site_at(position) if inside.contains(position) else None

    def marker_area(self, site: int) -> QRectF:
        """Square around the marker of a site."""
        return self.layout.marker_area(site)

    def words(self, site: int) -> str:
        """What is at a site, in lines."""
        place = input_words(site, self._drawing.limb)
        lines = [f"{site} · {place.name}", *filter(None, [_CONTACTS.get(place.kind, "")])]
        for index in self.state.at(site):
            chosen = ", selected" if index == self.state.selected else ""
            lines.append(f"Input {index + 1}: {self.state.marks[index].words}{chosen}")
        return "\n".join(lines)

    def description(self, site: int) -> str:
        """What is at a site, in a sentence for assistive technology."""
        words = "Place " + self.words(site).replace("\n", ". ")
        return words if self.state.marks else f"{HINT}. {words}"

    def _lay_out(self) -> None:
        if self.pan_zoom.frame is not None:
            self.layout = hand_layout(self._drawing, self.pan_zoom.frame)
            self.changed.emit()


def _points_of(drawing: HandDrawing) -> np.ndarray:
    points = drawing.outline.toFillPolygon().toList()
    return np.array([(point.x(), point.y()) for point in points])
