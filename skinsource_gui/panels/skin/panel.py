"""The skin panel: the measure line, the map of levels or of motion, and its scale."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPoint, QSize, QSizeF, Qt

from skinsource.design import edits
from skinsource.design.comparing import NO_RANGE, range_sentences, related_limbs
from skinsource.design.design import Design, Snapshot, View
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.panel_settings import brush_of, settings_of, with_settings
from skinsource.engine.time_rules import block_of
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.thresholds import LIMITS, LIMITS_IN_SHORT
from skinsource_gui.fields.inputs import remove_selected
from skinsource_gui.panels.skin.content import (
    MapContent,
    content_of,
    end_s,
    is_whole,
    marks_of,
    needs_of,
    of_people,
    painted_in,
    signals_name,
)
from skinsource_gui.panels.skin.layout import HAND
from skinsource_gui.panels.skin.map import (
    SkinMap,
    brush_hint,
    numbers_text,
    selection_hint,
    strongest_readout,
)
from skinsource_gui.panels.skin.measure import MeasureLine
from skinsource_gui.panels.skin.picture import heading_of, paint_picture
from skinsource_gui.panels.skin.scale import ColourBar
from skinsource_gui.panels.skin.settings import (
    LEVELS,
    PEOPLE,
    SKIN,
    STILL,
    LevelRange,
    SkinSettings,
    chosen_range,
    in_motion,
    with_range,
)
from skinsource_gui.panels.skin.time import ScrubBar
from skinsource_gui.plots.pictures import drawn_image, with_caption
from skinsource_gui.plots.ranges import SteadyRange
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import key_text
from skinsource_gui.qt.labels import FittingLabel, FixedLabel
from skinsource_gui.qt.layouts import in_column, in_row, named, tooltip
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme, set_tone, tabular
from skinsource_gui.qt.wheel import WHOLE
from skinsource_gui.state.compared import Compared
from skinsource_gui.state.panel import Panel

#: Refusal where Delete is pressed after outputs were selected.
NO_OUTPUTS = Refusal(
    sentence="Outputs cannot be removed; click an input, a dashed ring on the map, to remove it."
)
#: Usual width and height of a picture, px.
PICTURE_PX = (1200, 1800)


_SOURCE_IN_SHORT = "Made from files that are not the published ones", "Not the published files"


def _line(name: str, title: str, parent: QtWidgets.QWidget) -> FittingLabel:
    """Return a line of text with digits of one width."""
    line = FittingLabel(parent)
    named(line, name, title)
    line.setFont(tabular(line.font()))
    return line


class SkinPanel(Panel):
    """A map of the back of hand and arm: RMS levels or motion; outputs are selected on it.

    Attributes
    ----------
    settings
        Those of the panel.
    content
        What is shown, also while it is covered.
    measure, map, colour_bar, scrub, note, readout, strongest
        What is seen, from top to bottom.
    """

    title: ClassVar[str] = "Skin"
    name: ClassVar[str] = SKIN
    #: Its colours span the levels of all snapshots.
    compares: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.settings = SkinSettings()
        # The parts of design and view that were shown last.
        self._shown: tuple[object, ...] = ()
        # The colours stay while the loudest output changes a little.
        self._steady_range = SteadyRange()
        self._animated = False
        self._results: Mapping[str, Any] = {}
        self._compared: tuple[Compared, ...] = ()
        self._noisy: tuple[int, ...] = ()
        self._problem, self._covered, self._brush = "", False, ""
        # The range between people, why there is none, and whether it is that of an older design.
        self._people: Mapping[str, Any] = {}
        self._no_people, self._older_people, self._older = "", False, False
        # The part of the response for which signals were requested last.
        self._block = 0
        self.content = MapContent()
        # The Tab key goes through them in this order.
        self.measure, self.map = MeasureLine(self), named(SkinMap(self), "skin_map")
        self.colour_bar, self.scrub = named(ColourBar(self), "skin_colour_bar"), ScrubBar(self)
        self.note = _line("skin_note", "Note on the map", self)
        self.readout = _line("skin_readout", "Under the pointer", self)
        self.strongest = FixedLabel("−888.8 dB", self)
        set_tone(self.note, "warning")
        foot = in_row((self.readout, 1), self.strongest, margins=0)
        parts = self.measure, (self.map, 1), self.colour_bar, self.scrub, self.note, foot
        edges = UNIT_PX, UNIT_PX // 4, UNIT_PX, UNIT_PX // 4
        in_column(*parts, of=self, margins=edges, gap_px=UNIT_PX // 4)
        self.setFocusProxy(self.map)
        self._connect()
        self._show()

    @property
    def needs(self) -> frozenset[str]:
        return needs_of(self.settings) | ({self._moving} if self._animated else set())

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        shown = self._view.snapshots and self.settings.quantity != PEOPLE
        return frozenset({signals_name(self.settings.quantity)} if shown else ())

    @property
    def needs_on_limbs(self) -> Mapping[Any, frozenset[str]]:
        limb = self._design.limb
        if self.settings.quantity != PEOPLE or limb not in PUBLISHED:
            return {}
        return dict.fromkeys(related_limbs(limb), frozenset({signals_name(LEVELS)}))

    def snapshots_drawn(self, snapshots: Sequence[Snapshot]) -> Sequence[Snapshot]:
        return ()  # only their loudest levels count

    @property
    def _in_motion(self) -> SkinSettings:
        return in_motion(self.settings, facts_of(self._design.limb).axes)

    @property
    def _moving(self) -> str:
        return signals_name(self._in_motion.quantity)

    @property
    def seen(self) -> SkinSettings:
        """The settings with what is seen: while time runs, the wave in place of its level."""
        moves = self._animated and self._moving in self._results
        return self._in_motion if moves else self.settings

    @property
    def moves(self) -> bool:
        """Whether the map changes with the playhead."""
        return self.seen.quantity not in STILL

    def sizeHint(self) -> QSize:
        return QSize(420, 640)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        # A word above the map may have the focus.
        self.map.keyPressEvent(event)

    def show_state(self, design: Design, view: View) -> None:
        if (
            view.selected_inputs != self._view.selected_inputs
            or view.selected_clips != self._view.selected_clips
        ):
            self.map.leave_outputs()
        self._design, self._view = design, view
        before, self.settings = self.settings, settings_of(view, self.name, SkinSettings)
        if self.settings.quantity != before.quantity or chosen_range(self.settings):
            self.reset_range()
        if not self.needs_of_snapshots:
            self._compared = ()
        if not self.needs_on_limbs:
            self._people, self._older_people = {}, False
            self._no_people = NO_RANGE if self.settings.quantity == PEOPLE else ""
        self._brush = brush_of(view)
        self.map.show_brush(bool(self._brush))
        shown = view, facts_of(design.limb), marks_of(design, view), painted_in(design, view)
        if shown != self._shown or self.moves:
            self._shown = shown
            self._show()
        else:  # another waveform changes the map only when that is computed
            self.measure.show_state(design, view, self.seen, self.content)

    def show_playhead(self, view: View) -> None:
        self._view = view
        if self.moves and self.isVisible():
            self._show()

    def show_running(self, running: bool) -> None:
        self._animated = running
        self.visibility_changed.emit()  # it needs something else now
        self._show()

    def reset_range(self) -> None:
        self._steady_range.reset()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._results = {name: results[name] for name in self.needs}
        self._problem, self._block = "", block_of(self._view.playhead_s)
        self._show()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        needed = self.needs_of_snapshots
        self._compared = tuple(
            snapshot for snapshot in compared if needed <= (snapshot.values or {}).keys()
        )
        self._show()

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        levels = [each.values[signals_name(LEVELS)] for each in compared if each.values]
        self._no_people = next((each.problem for each in compared if each.problem), "")
        self._older_people = any(each.is_stale for each in compared)
        if len(levels) < len(compared):
            self._people = {}
        elif not self._older_people:
            self._people = of_people(levels)
        self.show_stale(self._older)
        self._show()

    def show_stale(self, stale: bool) -> None:
        self._older = stale
        super().show_stale(stale or self._older_people)

    def show_problem(self, reason: str) -> None:
        self._problem = reason
        self._show()

    def show_staleness(self, stale: bool) -> None:
        self.map.show_outdated(stale)

    def show_pointed_input(self, input_id: int | None) -> None:
        self.map.show_pointed_input(input_id)

    def show_pointed_place(self, at: tuple[float, float] | None) -> None:
        self.map.show_pointed_place(at)

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Hatch outputs that are mostly noise."""
        self._noisy = outputs
        self._show()

    def show_covered(self, covered: bool) -> None:
        """Hide what was computed; limb and inputs stay, so that they can be pointed at."""
        self._covered = covered
        self._show()

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the map for a page or a slide, with all that is needed to read it; size in px."""
        content = self.content
        heading = heading_of(self._design, content.quantity, content.drawn_note)
        family, visible = self.font().family(), self.map.stage.visible
        paint_picture(painter, QSizeF(width, height), content, heading, theme, family, visible)

    def picture(self, width: int, height: int) -> QtGui.QImage:
        """Return `draw_picture` as pixels, with the caption that the window gives."""
        with self.as_stored():
            return drawn_image(with_caption(self.draw_picture, self.caption()), width, height)

    def _show(self) -> None:
        """Show what is known as design, view and settings ask for."""
        seen = self.seen
        self.content = content = content_of(
            {**self._results, **self._people},
            seen,
            self._view,
            self._design,
            noisy=self._noisy,
            compared=self._compared,
            problem=self._problem or self._no_people,
            steady=self._steady_range,
        )
        shown = content.covered if self._covered else content
        self.measure.show_state(self._design, self._view, seen, content)
        self.colour_bar.show_content(shown)
        self.map.show_content(shown)
        in_short = content.note.replace(LIMITS, LIMITS_IN_SHORT).replace(*_SOURCE_IN_SHORT)
        half_db = content.quantity.half_db
        in_short = in_short.replace(range_sentences(half_db), f"±{half_db:.1f} dB between people")
        self.note.show_phrases((content.note, in_short))
        self.note.setToolTip(tooltip(content.note) if content.note else "")
        self.note.setVisible(bool(content.note))
        self._show_readout(self.map.readout())
        # Otherwise the map would jump whenever time begins to run.
        self.scrub.setVisible(self.settings.quantity not in STILL)
        if self.moves:
            self._follow_playhead()

    def _follow_playhead(self) -> None:
        """Show the time, and ask for the part of the response that follows."""
        signals = self._results.get(signals_name(self.seen.quantity))
        self.scrub.show_time(self._view, end_s(signals, self._view))
        block = block_of(self._view.playhead_s)
        if block != self._block and not is_whole(signals):
            self._block = block
            self.visibility_changed.emit()
        if signals is not None and self.content.values is None:
            self._staleness.set_stale(True)

    def _show_readout(self, text: str) -> None:
        hint, whole, level = selection_hint(self.content.outputs), text, ""
        if not text and self._brush:
            text = whole = brush_hint(self._brush)
        elif not text:
            strongest, value, level = strongest_readout(self.content)
            text, whole = strongest or hint, f"{value}\n{hint}".strip()
        brief = text.partition("  (")[0]
        place, dot, value = brief.partition(" · ")
        self.readout.show_phrases((text, brief, f"{place.partition(',')[0]}{dot}{value}"))
        self.strongest.setText(level)
        self.readout.setToolTip(whole)
        self.readout.setAccessibleDescription(f"{text} {level}".strip())

    def _connect(self) -> None:
        measure, stage = self.measure, self.map.stage
        measure.edited.connect(self.edited)
        measure.settings_chosen.connect(self._look)
        # Otherwise Space, which plays, would open the menu again.
        measure.settings_chosen.connect(lambda _: self.setFocus(Qt.FocusReason.OtherFocusReason))
        measure.arm.clicked.connect(lambda shown: stage.show_arm(shown=shown))
        stage.changed.connect(lambda: measure.arm.setChecked(stage.pan_zoom.fit == WHOLE))
        self.colour_bar.range_chosen.connect(self._choose_range)
        self.map.readout_changed.connect(self._show_readout)
        self.map.input_pointed_at.connect(self.input_pointed_at)
        self.map.place_pointed_at.connect(self.place_pointed_at)
        self.map.inputs_chosen.connect(partial(self._edit, edits.select_inputs))
        self.map.removal_requested.connect(self._remove)
        self.map.painted.connect(self._paint)
        self.map.outputs_chosen.connect(partial(self._edit, edits.select_outputs))
        self.map.menu_requested.connect(self._open_menu)
        self.scrub.pace.edited.connect(lambda pace, _: self._choose_pace(float(pace)))
        self.scrub.time_requested.connect(self.playhead_requested)
        self.scrub.play.clicked.connect(lambda: self.action_requested.emit("play"))

    def _look(self, settings: SkinSettings) -> None:
        if settings.quantity == self.seen.quantity:
            settings = replace(settings, quantity=self.settings.quantity)
        self.view_changed.emit(with_settings(self._view, self.name, settings))

    def _choose_range(self, chosen: LevelRange | None) -> None:
        """Use this range, or fit one to what is shown now."""
        self.reset_range()
        self._look(with_range(self.seen, chosen))
        self._show()

    def _edit(self, edit: Callable[..., Edit | Refusal], value: Any) -> None:
        self.edited.emit(edit(self._design, self._view, value), None)

    def _paint(self, outputs: tuple[int, ...], gesture: int) -> None:
        painted = edits.paint_target(self._design, self._view, outputs, self._brush)
        self.edited.emit(painted, gesture)

    def _remove(self, outputs_selected: bool) -> None:
        """Remove the selected clips or inputs; where none is, or outputs are meant, say so."""
        removed = remove_selected(self._design, self._view)
        self.edited.emit(NO_OUTPUTS if outputs_selected else removed, None)

    def _choose_pace(self, slow_motion: float) -> None:
        """Play this many times slower than real time."""
        self._edit(edits.play_slower, slow_motion)
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _open_menu(self, at: QPoint) -> None:
        """Open the menu of the map at a point of the screen: fits, colours, picture and data."""
        menu, show = passing_menu(self.map, "skin_menu"), self.map.stage.pan_zoom.show
        menu.addAction(f"Fit hand\t{key_text('skin', 'arm')}", partial(show, HAND))
        menu.addAction(f"Fit hand and arm\t{key_text('skin', 'whole')}", partial(show, WHOLE))
        menu.addSeparator()
        self.measure.offer_colours(menu.addMenu("Colours"))
        menu.addSeparator()
        # A file waits for new results; the clipboard gets what is drawn now.
        copy = menu.addAction("Copy picture", self._copy_picture)
        numbers = menu.addAction("Copy numbers", self._copy_numbers)
        copy.setEnabled(not self.is_stale)
        has_numbers = self.content.coloured_values is not None and not self._covered
        numbers.setEnabled(has_numbers and not self.is_stale)
        menu.addAction("Save picture as…", partial(self.action_requested.emit, "export_picture"))
        menu.addAction("Export data…", partial(self.action_requested.emit, "export_levels"))
        menu.popup(at)

    def _copy_numbers(self) -> None:
        with self.as_stored():
            QtGui.QGuiApplication.clipboard().setText(numbers_text(self.content))

    def _copy_picture(self) -> None:
        QtGui.QGuiApplication.clipboard().setImage(self.picture(*PICTURE_PX))
