"""Panel of the dorsal heat map."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any, ClassVar

from PySide6.QtCore import QPoint, QSize, QSizeF
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QGridLayout, QWidget

from skinsource.design import Design
from skinsource.own_limbs import facts_of
from skinsource.surface import SurfaceOperator
from skinsource.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.skin import still_values
from skinsource_gui.panels.skin.colour_bar import ColourBar
from skinsource_gui.panels.skin.inputs.marks import marks_of
from skinsource_gui.panels.skin.map_choices import MapChoices
from skinsource_gui.panels.skin.map_content import MapContent, note_of, px_per_mm_of
from skinsource_gui.panels.skin.map_menu import open_map_menu
from skinsource_gui.panels.skin.map_picture import heading_of, paint_picture
from skinsource_gui.panels.skin.map_quantity import STILL, MapQuantity, Z
from skinsource_gui.panels.skin.map_toolbar import MapToolbar
from skinsource_gui.panels.skin.note_line import NoteLine
from skinsource_gui.panels.skin.readout_lines import ReadoutLines
from skinsource_gui.panels.skin.skin_map import SkinMap
from skinsource_gui.panels.skin.time.time_view import TimeView
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.widgets.lateness import Lateness
from skinsource_gui.widgets.map.field_image import field_image

#: Width and height of a picture for which none is asked, px.
PICTURE_PX = (1200, 1800)


class SkinPanel(Panel):
    """RMS level over the back of the hand and arm, on which outputs are selected."""

    title: ClassVar[str] = "Skin"
    name: ClassVar[str] = "skin"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._choices = MapChoices(self.name, self)
        self._theme, self._content = LIGHT, MapContent()
        self._covered = False
        self._surface: SurfaceOperator | None = None
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self._mark_outdated)
        self.toolbar = MapToolbar(self)
        self.time = TimeView(self)
        self.map = SkinMap(self)
        self.map.setObjectName("skin_map")
        self.colour_bar = ColourBar(self)
        self.colour_bar.setObjectName("skin_colour_bar")
        self.note = NoteLine(self)
        self.note.setObjectName("skin_note")
        self.readout = ReadoutLines(self)
        self.readout.setObjectName("skin_readout")
        self.readout.setAccessibleName("Under the pointer")
        self.time.put_behind(self.colour_bar.auto_button)
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
        self.setMinimumSize(258, 300)
        self.setFocusProxy(self.map)
        self._connect()
        self._show_settings()
        self.show_theme(LIGHT)
        self._show_readout(self.map.readout())

    @property
    def needs(self) -> frozenset[str]:
        moving = self.time.needs(self._choices.settings)
        shown = self._choices.settings.quantity
        always = frozenset({"limb_map", "limb_data"}) | (moving or still_values.needs_of(shown))
        if self._choices.settings.map_style == "sensors":
            return always
        on_surface = always | {"surface"}
        return on_surface if moving else on_surface | {still_values.over_skin(shown)}

    def sizeHint(self) -> QSize:
        return QSize(420, 640)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        before = self._choices.settings.quantity
        self._choices.show_state(design, view)
        self._show_settings()
        if self._choices.settings.quantity != before:
            # What is shown are not the numbers that are wanted now.
            self.time.frames.forget()
            self._change(values=None, field_values=None, message="", outdated=False)
        elif self._moves:
            self._change_frame()
        elif self._content.values is not None:
            self.colour_bar.follow(self._content.values)
        if self._choices.settings.map_style == "sensors":
            # Kept, it would belong to an older design when it is shown again.
            self._change(field_values=None)
        self._show_choice()

    def show_playhead(self, view: View) -> None:
        self._view = view
        self._choices.show_playhead(view)
        if self._moves and self.isVisible():
            self._change_frame()
            self._show_choice()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._lateness.set_stale(False)
        surface = results.get("surface") if "surface" in self.needs else None
        if surface is not None and surface is not self._surface:
            self._surface = surface
            self._change(field=field_image(surface, results["limb_data"]))
        self._change(
            limb_map=results["limb_map"],
            limb="" if self._design is None else self._design.limb,
            px_per_mm=px_per_mm_of(results["limb_data"]),
            note=still_values.limits_and(
                note_of(surface, results["limb_data"]), self._choices.settings.quantity
            ),
            outdated=False,
        )
        self.time.take(results, self._choices.settings, self._view)
        if self._moves:
            self.colour_bar.follow(self.time.levels_of_largest())
            self._change(message="" if self.time.frames.largest > 0.0 else still_values.SILENT)
            self._show_settings()
            self._change_frame()
        else:
            still, on_skin = self._choices.settings.quantity, surface is not None
            self._change(**still_values.changes_of(still, results, interpolated=on_skin))
            if self._content.values is not None:
                self.colour_bar.follow(self._content.values)
        self._show_choice()

    def show_pointed_input(self, input_id: int | None) -> None:
        self._change(pointed_at=input_id)
        self._show_map()

    def cover(self, covered: bool) -> None:
        """Hide what was computed, for an audience that shall guess first; or reveal it."""
        self._covered = covered
        self._show_choice()

    def show_stale(self, stale: bool) -> None:
        self._lateness.set_stale(stale)

    def show_problem(self, reason: str) -> None:
        self._lateness.set_stale(False)
        self.time.frames.forget()
        self._change(values=None, field_values=None, message=reason, note="", outdated=False)
        self._show_choice()

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Hatch outputs that are mostly noise."""
        self._change(noisy=outputs)
        self._show_map()

    def show_theme(self, theme: Theme) -> None:
        self._theme = theme
        beside = self.colour_bar, self.note, self.readout
        for part in (self.toolbar, self.time, self.map, *beside):
            part.show_theme(theme)
        self._show_choice()

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the map for a page or a slide, with all that is needed to read it; size in px."""
        content = replace(self._content, outdated=False)
        heading = replace(
            heading_of(self._design, self._view, self._content.quantity), note=self._content.note
        )
        family, seen = self.font().family(), self.map.seen
        paint_picture(painter, QSizeF(width, height), content, heading, theme, family, seen)

    def picture(self, width: int, height: int, theme: Theme = LIGHT) -> QImage:
        """What `draw_picture` draws, as pixels."""
        image = QImage(width, height, QImage.Format.Format_RGB32)
        painter = QPainter(image)
        self.draw_picture(painter, width, height, theme)
        painter.end()
        return image

    def _connect(self) -> None:
        self._choices.edited.connect(self.edited)
        self._choices.view_changed.connect(self.view_changed)
        self.toolbar.style_chosen.connect(self._choices.choose_style)
        self.toolbar.sensors_switched.connect(self._choices.switch_sensors)
        self.toolbar.fit_chosen.connect(self.map.pan_zoom.show)
        self.map.input_pointed_at.connect(self.input_pointed_at)
        self.map.input_chosen.connect(self._choices.choose_input)
        self.map.outputs_chosen.connect(self._choices.choose_outputs)
        self.map.menu_requested.connect(self._open_menu)
        self.map.readout_changed.connect(self._show_readout)
        self.colour_bar.range_chosen.connect(self._choices.choose_range)
        self.time.bar.limits_chosen.connect(self._choices.choose_limits)
        self.time.row.quantity_chosen.connect(self._choices.choose_quantity)
        self.time.row.window_chosen.connect(self._choices.choose_window)
        self.time.row.pace_chosen.connect(self._choices.choose_pace)
        self.time.scrub.time_wanted.connect(self.playhead_wanted)
        self.time.scrub.play_wanted.connect(partial(self.action_wanted.emit, "play"))
        self.time.part_wanted.connect(self.visibility_changed)

    def _change(self, **changes: Any) -> None:
        self._content = replace(self._content, **changes)

    @property
    def _moves(self) -> bool:
        """Whether what is shown is another thing at another time."""
        return self._choices.settings.quantity not in STILL

    def _show_settings(self) -> None:
        settings = self._choices.settings
        self.toolbar.show_settings(settings)
        self.time.show_state(settings, self._view)
        signed = settings.quantity == Z
        self.time.bar.setVisible(signed)
        self.colour_bar.setVisible(not signed)
        self.colour_bar.choose(self._choices.chosen_range)

    def _change_frame(self) -> None:
        """Take the skin at the playhead; where it is not known yet, what was shown is late."""
        settings = self._choices.settings
        surface = self._surface if settings.map_style == "interpolated" else None
        changes = self.time.changes(settings, self._view, surface)
        if changes is not None:
            self._change(**changes)
        elif self.time.frames.known:
            self._lateness.set_stale(True)

    def _show_choice(self) -> None:
        limbs = (self._content.limb, "" if self._design is None else self._design.limb)
        self._change(
            outputs=self._view.outputs,
            inputs=() if self._design is None else marks_of(self._design, self._view),
            sensors_shown=self._choices.settings.sensors_shown,
            synthetic=any(facts_of(limb).synthetic for limb in limbs),
        )
        if not self._moves:
            settings = self._choices.settings
            self._change(
                quantity=MapQuantity(name=settings.quantity, span=self._view.span),
                value_range=self.colour_bar.range_db,
                fixed=self._choices.chosen_range is not None,
                colours=settings.colours,
            )
        levels = None if self._covered else self._content.coloured_values
        self.colour_bar.strip.show_quantity(self._content.quantity, self._content.colours)
        self.colour_bar.show_marks(
            ()
            if levels is None
            else tuple(
                (float(levels[number - 1]), self._theme.output_colour(rank))
                for rank, number in enumerate(self._view.outputs)
                if number <= levels.size
            )
        )
        self._show_map()
        self.note.show_text(self._content.note)
        self._show_readout(self.map.readout())

    def _mark_outdated(self, late: bool) -> None:
        self._change(outdated=late)
        self._show_map()

    def _show_map(self) -> None:
        self.map.show_content(self._content.covered if self._covered else self._content)

    def _show_readout(self, words: str) -> None:
        count = len(self._view.outputs)
        if words:
            self.readout.show_text(words)
        elif count == 0:
            self.readout.show_text("No output selected\nClick one, or drag around several")
        else:
            noun = "output" if count == 1 else "outputs"
            self.readout.show_text(f"{count} {noun} selected\nShift+click adds or removes one")

    def _open_menu(self, at: QPoint) -> None:
        save = partial(self.action_wanted.emit, "export_picture")
        export = partial(self.action_wanted.emit, "export_levels")
        colours = self._choices.settings.colours, self._choices.choose_colours
        open_map_menu(self.map, at, partial(self.picture, *PICTURE_PX), save, export, colours)
