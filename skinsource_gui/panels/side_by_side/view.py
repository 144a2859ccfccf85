"""Maps side by side as a widget: what is pointed at in one of them is marked in all."""

from math import ceil

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFocusEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from skinsource.arrays import Floats
from skinsource_gui.panels.side_by_side.content import Content
from skinsource_gui.panels.side_by_side.headings import places_for
from skinsource_gui.panels.side_by_side.layout import Places, least_height
from skinsource_gui.panels.side_by_side.painter import paint_content
from skinsource_gui.theme import LIGHT, Theme, tabular
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.key_tables.kept_from_shortcuts import kept_from_shortcuts
from skinsource_gui.widgets.key_tables.key_table import meant
from skinsource_gui.widgets.map.small_map import small_frame
from skinsource_gui.widgets.outputs.picker import OutputPicker

# Those keys of the skin map that are about outputs.
_KEYS = frozenset({"go", "select", "toggle", "select_all", "select_none"})


class MapsView(QWidget):
    """Shows `Content`, and tells which outputs the user wants selected.

    Attributes
    ----------
    content
        What is shown.
    picker
        Which outputs mouse and keys mean.
    """

    #: The outputs to select, a tuple of numbers.
    outputs_chosen = Signal(object)
    #: Number of the output that is pointed at, or None.
    pointed_at = Signal(object)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._theme: Theme = LIGHT
        self._outdated = False
        # Of which map the mouse was last.
        self._at = 0
        self.content = Content()
        self.picker = OutputPicker(self)
        self.picker.chosen.connect(self.outputs_chosen)
        self.picker.moved.connect(self._tell)
        self.setObjectName("maps_side_by_side")
        self.setAccessibleName("Maps side by side")
        self.setAccessibleDescription(
            "Arrow keys move to the next output, Space selects it, Shift and Space adds it; it is "
            "marked in all maps."
        )
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    @property
    def output(self) -> int | None:
        """The output that is pointed at, by the mouse or by keys."""
        return self.picker.pointed_at(focused=self.hasFocus())

    @property
    def places(self) -> Places:
        """Where everything is."""
        return places_for(QRectF(self.rect()), self.content, tabular(self.font()))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, ceil(least_height(self.fontMetrics().height())))

    def show_content(self, content: Content) -> None:
        """Draw ``content``."""
        self.content, self.picker.selected = content, content.outputs
        self.setAccessibleName(content.message or content.about or "Maps side by side")
        self._tell()

    def show_outdated(self, outdated: bool) -> None:
        """Say whether what is shown belongs to an older design."""
        self._outdated = outdated
        self.update()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def points_of(self, index: int) -> Floats:
        """Where the outputs are drawn in one of the maps, (n_outputs, 2); NaN: they are not."""
        cells = self.content.cells
        small = cells[index].small if index < len(cells) else None
        if small is None or self.content.message:
            return np.full((1, 2), np.nan)
        limb_map = small.limb_map
        return small_frame(limb_map, self.places.cells[index].map).to_screen(
            limb_map.output_positions
        )

    def event(self, event: QEvent) -> bool:
        return kept_from_shortcuts(event, self._wants) or super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
        return meant("skin", event) in _KEYS and self.picker.claims(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, theme, content = QPainter(self), self._theme, self.content
        painter.setFont(tabular(self.font()))
        painter.fillRect(self.rect(), QColor(theme.base))
        if content.message or not content.cells:
            painter.setPen(QColor(theme.dim))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(QRectF(self.rect()).adjusted(8, 8, -8, -8), flags, content.message)
        else:
            self._paint_maps(painter)
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), theme)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._at = self._map_at(event.position())
        self.picker.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not event.buttons():
            self._at = self._map_at(event.position())
        self.picker.mouse.move(event.position(), self.points_of(self._at))
        self._tell()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.picker.release(event, self.points_of(self._at))
            self.update()

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.picker.mouse.leave()
        self._tell()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        points = self.points_of(self._at)
        unplaced = tuple(int(k) + 1 for k in np.flatnonzero(np.isnan(points[:, 0])))
        middle = QRectF(self.rect()).center()
        if len(unplaced) == len(points) or meant("skin", event) not in _KEYS:
            super().keyPressEvent(event)
        else:
            self.picker.press_key(event, points, unplaced, middle)
            self.update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._tell()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._tell()

    def _paint_maps(self, painter: QPainter) -> None:
        theme, places = self._theme, self.places
        if self._outdated:
            painter.setPen(QColor(theme.dim))
            painter.drawText(places.head, Qt.AlignmentFlag.AlignVCenter, "Computing…")
        if any(cell.synthetic for cell in self.content.cells):
            painter.setPen(QColor(theme.warning))
            right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(places.head, right, "SYNTHETIC")
        painter.setOpacity(0.5 if self._outdated else 1.0)
        paint_content(painter, self.content, places, theme, self.output)
        painter.setOpacity(1.0)
        if self.picker.mouse.band is not None:
            fill = QColor(theme.accent)
            painter.setPen(fill)
            fill.setAlphaF(0.15)
            painter.setBrush(fill)
            painter.drawRect(self.picker.mouse.band)

    def _map_at(self, point: QPointF) -> int:
        """The map under a point; where there is none the one before."""
        cells = enumerate(self.places.cells)
        return next((k for k, place in cells if place.whole.contains(point)), self._at)

    def _tell(self) -> None:
        self.pointed_at.emit(self.output)
        self.update()
