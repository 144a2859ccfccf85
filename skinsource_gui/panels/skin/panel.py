"""Panel of the dorsal heat map."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any, ClassVar

from PySide6.QtCore import QPoint, QSize, QSizeF
from PySide6.QtGui import QImage, QPainter, QResizeEvent
from PySide6.QtWidgets import QGridLayout, QWidget

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panel import Panel
from skinsource_gui.panels.skin.inputs.marks import marks_of
from skinsource_gui.panels.skin.map_choices import MapChoices
from skinsource_gui.panels.skin.map_controls import MapControls
from skinsource_gui.panels.skin.map_display import MapDisplay
from skinsource_gui.panels.skin.map_menu import open_map_menu
from skinsource_gui.panels.skin.map_picture import heading_of, paint_picture
from skinsource_gui.panels.skin.map_results import MapResults
from skinsource_gui.panels.skin.map_toolbar import MapToolbar
from skinsource_gui.panels.skin.settings import SKIN
from skinsource_gui.panels.skin.time.time_view import TimeView
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.widgets.pictures.caption import with_caption

#: Width and height of a picture for which none is asked, px.
PICTURE_PX = (1200, 1800)
# Of its own letters; with fewer it says less.
_FEW_LINES = 14


class SkinPanel(Panel):
    """RMS level over the back of the hand and arm, on which outputs are selected.

    Attributes
    ----------
    toolbar, time, map, colour_bar, note, readout
        What is seen, from top to bottom.
    """

    title: ClassVar[str] = "Skin"
    name: ClassVar[str] = SKIN

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        # What of design and view is seen here, as it was shown last.
        self._seen: tuple[object, ...] = ()
        # Tab goes through them as they are made.
        self.toolbar, self.time = MapToolbar(self), TimeView(self)
        self._display = MapDisplay(self, self._lateness)
        self.map, self.colour_bar = self._display.map, self._display.colour_bar
        self.note, self.readout = self._display.note, self._display.readout
        self.time.put_behind(self.colour_bar.auto_button)
        self._choices = MapChoices(self.name, self)
        self._controls = MapControls(self._choices, self.toolbar, self.time, self.colour_bar)
        self._results = MapResults(self._choices, self.time, self._display)
        self._lay_out()
        self._connect()
        self._controls.show_settings(self._view)
        self._display.show()
        self._results.show_choice(self._design, self._view)

    @property
    def needs(self) -> frozenset[str]:
        return self._results.needs

    def sizeHint(self) -> QSize:
        return QSize(420, 640)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        before = self._choices.settings.quantity
        self._choices.show_state(design, view)
        seen = (view, facts_of(design.limb), marks_of(design, view))
        if seen == self._seen and not self._results.moves:
            return  # another waveform is another map, but only once that is computed
        self._seen = seen
        self._controls.show_settings(view)
        if self._choices.settings.quantity == before:
            self._results.follow(view)
        else:
            # What is shown are not the numbers that are wanted now.
            self._results.forget()
        self._results.show_choice(design, view)

    def show_playhead(self, view: View) -> None:
        self._view = view
        self._choices.show_playhead(view)
        if self._results.moves and self.isVisible():
            self._results.follow(view)
            self._results.show_choice(self._design, view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._results.take(results, self._design, self._view)
        self._results.show_choice(self._design, self._view)

    def show_problem(self, reason: str) -> None:
        self._results.forget(reason)
        self._results.show_bare(self._design)
        self._display.change(note="", drawn_note="")
        self._results.show_choice(self._design, self._view)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        # In large letters the map needs the room more than the second line does.
        few = self.height() < _FEW_LINES * self.fontMetrics().lineSpacing()
        for part in (self.readout, self.note):
            part.show_lines(1 if few else 2)

    def show_pointed_input(self, input_id: int | None) -> None:
        self._display.change(pointed_at=input_id)
        self._display.show_map()

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Hatch outputs that are mostly noise."""
        self._display.change(noisy=outputs)
        self._display.show_map()

    def show_covered(self, covered: bool) -> None:
        """Hide what was computed; limb and inputs stay, so that there is something to point at."""
        self._display.cover(covered)

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the map for a page or a slide, with all that is needed to read it; size in px."""
        content = replace(self._display.content, outdated=False)
        heading = heading_of(self._design, self._view, content.quantity)
        heading = replace(heading, note=content.drawn_note)
        family, seen = self.font().family(), self.map.stage.seen
        paint_picture(painter, QSizeF(width, height), content, heading, theme, family, seen)

    def picture(self, width: int, height: int, theme: Theme = LIGHT) -> QImage:
        """What `draw_picture` draws, as pixels, with the caption that the window gives."""
        image = QImage(width, height, QImage.Format.Format_RGB32)
        with self.as_stored():
            painter = QPainter(image)
            draw = with_caption(self.draw_picture, self.caption())
            draw(painter, width, height, theme)
            painter.end()
        return image

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        grid.setSpacing(UNIT_PX // 2)
        grid.addWidget(self.toolbar, 0, 0, 1, 2)
        grid.addWidget(self.time.row, 1, 0, 1, 2)
        grid.addWidget(self.map, 2, 0)
        grid.addWidget(self.colour_bar, 2, 1)
        grid.addWidget(self.time.bar, 2, 1)
        grid.addWidget(self.time.scrub, 3, 0, 1, 2)
        grid.addWidget(self.note, 4, 0, 1, 2)
        grid.addWidget(self.readout, 5, 0, 1, 2)
        grid.setRowStretch(2, 1)
        grid.setColumnStretch(0, 1)
        self.setFocusProxy(self.map)

    def _connect(self) -> None:
        self._choices.edited.connect(self.edited)
        self._choices.view_changed.connect(self.view_changed)
        self.toolbar.fit_chosen.connect(self.map.stage.pan_zoom.show)
        self.map.input_pointed_at.connect(self.input_pointed_at)
        self.map.inputs_chosen.connect(self._choices.choose_inputs)
        self.map.removal_wanted.connect(self._choices.remove_inputs)
        self.map.outputs_chosen.connect(self._choices.choose_outputs)
        self.map.menu_requested.connect(self._open_menu)
        self.time.scrub.time_wanted.connect(self.playhead_wanted)
        self.time.scrub.play_wanted.connect(partial(self.action_wanted.emit, "play"))
        self.time.part_wanted.connect(self.visibility_changed)

    def _open_menu(self, at: QPoint) -> None:
        save = partial(self.action_wanted.emit, "export_picture")
        export = partial(self.action_wanted.emit, "export_levels")
        colours = self._choices.settings.colours, self._choices.choose_colours
        open_map_menu(self.map, at, partial(self.picture, *PICTURE_PX), save, export, colours)
