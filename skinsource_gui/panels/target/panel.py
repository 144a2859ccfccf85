"""The panel of a target: its brush and fields, what three ways do, and what it does on others."""

from dataclasses import replace
from functools import partial
from math import ceil, isnan, log10
from typing import ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QRectF, QSize, Qt

from skinsource.base.conventions import (
    ALL_AXES,
    BAND_HZ,
    LARGEST_VELOCITY_M_PER_S,
    SAMPLE_RATE_HZ,
    Band,
)
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import leading_clip
from skinsource.design.panel_settings import (
    BRUSH,
    NO_BRUSH,
    TARGET,
    TargetSettings,
    brush_of,
    with_settings,
)
from skinsource.design.target import BETA, Target, target_in
from skinsource.design.waveforms.samples import Layers
from skinsource.inverse.aiming import DEEPEST_DB, Way
from skinsource.limbs.locations import output_name
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource.specs.numbers import ModelSpec
from skinsource_gui.fields.editor import Burst, new_gesture
from skinsource_gui.fields.editors import new_editor
from skinsource_gui.fields.grid import FieldGrid
from skinsource_gui.fields.parts import PartFields
from skinsource_gui.fields.units import minus
from skinsource_gui.plots.curves import fitting
from skinsource_gui.plots.small_map import LEAST_MAP_PX, map_grid, paint_rings, paint_small_map
from skinsource_gui.qt.buttons import page_button, page_label, scrolled, tool_button
from skinsource_gui.qt.fitting import FoldingRow
from skinsource_gui.qt.labels import RowTable
from skinsource_gui.qt.layouts import Policy, in_column, in_row, named, tooltip
from skinsource_gui.qt.resources import columns_of
from skinsource_gui.qt.theme import UNIT_PX, current_theme, set_tone
from skinsource_gui.state.aiming import Found, FoundPanel, Person
from skinsource_gui.state.panel import PREPARING

_LIMIT_MM_S = 1e3 * LARGEST_VELOCITY_M_PER_S
COLUMNS = columns_of("target", limit_mm_s=_LIMIT_MM_S)
_STEPS_PER_DECADE = 10
_EMPTY = "Take a brush, and paint a strong output on the skin map"
#: Level of the lowest colour of the small maps, dB re the strong outputs.
_LOWEST_DB = -30.0


_SPEC = ModelSpec(label="Target", kinds=lambda: (Target,))


def over_text(level_db: float) -> str:
    """Return how far the strong outputs are over what has a level re them.

    >>> over_text(-31.0)
    '> 20 dB'
    """
    if isnan(level_db):
        return "not known"
    if level_db < DEEPEST_DB:
        return f"> {-DEEPEST_DB:g} dB"
    return minus(f"{-level_db:+z.1f} dB")


def row_of(way: Way, limb: str) -> tuple[tuple[str, str], ...]:
    """Return text and tooltip of each cell of a row of the table."""
    name = output_name(way.loudest, limb)
    speed = way.velocity_m_per_s
    return (
        (way.title, ""),
        (f"{over_text(way.loudest_db)}, {name.short_name}", name.name),
        (over_text(way.quiet_db), ""),
        (over_text(way.between_db), ""),
        (over_text(way.contact_db), ""),
        (f"{way.effort_db:z.1f} dB", ""),
        ("not known" if isnan(speed) else f"{1e3 * speed:.2g} of {_LIMIT_MM_S:g}", ""),
    )


class WaysTable(RowTable):
    """A row for each way to reach a target."""

    def __init__(self) -> None:
        super().__init__("target_ways", "Ways to the target", COLUMNS, wide=())
        self.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.NoSelection)
        self.setSizePolicy(Policy.Expanding, Policy.Fixed)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

    def show_ways(self, ways: tuple[Way, ...], limb: str) -> None:
        """Show what ways do on a limb."""
        self.fill([row_of(way, limb) for way in ways])
        for row, way in enumerate(ways):
            speed = self.item(row, len(COLUMNS) - 1)
            if speed and way.velocity_m_per_s > LARGEST_VELOCITY_M_PER_S:
                speed.setForeground(QtGui.QColor(current_theme().error))

    def sizeHint(self) -> QSize:
        rows = 3 * self.verticalHeader().defaultSectionSize()
        rows += self.horizontalHeader().sizeHint().height() + 2 * self.frameWidth()
        below = self.horizontalScrollBar().sizeHint().height()
        return QSize(super().sizeHint().width(), rows + below)


class PeopleMaps(QtWidgets.QWidget):
    """A small map for each other limb, in one scale: what the drives of a target do there.

    Attributes
    ----------
    people
        What is shown.
    range_db
        Levels of the lowest and the highest colour, dB re the strong outputs of each limb.
    """

    def __init__(self) -> None:
        super().__init__()
        named(self, "target_people", "Same drives, other limbs")
        self.show_people((), ())
        self.setMinimumSize(round(2.0 * LEAST_MAP_PX), round(LEAST_MAP_PX))

    def show_people(self, people: tuple[Person, ...], strong: tuple[int, ...]) -> None:
        """Show what drives do on limbs, and rings at the strong outputs."""
        self.people, self._strong = people, strong
        self.range_db = _LOWEST_DB, max([0, *(ceil(each.loudest_db) for each in people)])
        low, high = self.range_db
        texts = [minus(f"Colours: {low:g} to {high:g} dB re the strong outputs of each")]
        texts += [
            f"{each.title}: {over_text(each.loudest_db)} over the loudest other" for each in people
        ]
        self.setAccessibleDescription("; ".join(texts))
        self.setToolTip("\n".join(texts))
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(280, 180)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = QtGui.QPainter(self), current_theme()
        metrics = QtGui.QFontMetricsF(painter.font())
        line = metrics.height()
        cells = map_grid(QRectF(self.rect()), len(self.people), 2.0 * line)
        for cell, each in zip(cells, self.people, strict=True):
            area = cell.adjusted(4.0, 2.0 * line, -4.0, -2.0)
            paint_small_map(painter, area, each.shown, None, theme, self.range_db)
            paint_rings(painter, each.shown, area, self._strong, theme)
            painter.setPen(QtGui.QColor(theme.text))
            head = QRectF(cell.left(), cell.top(), cell.width(), 2.0 * line)
            text = head_text(each, metrics, cell.width() - line)
            painter.drawText(head, Qt.AlignmentFlag.AlignCenter, text)


def head_text(person: Person, metrics: QtGui.QFontMetricsF, room_px: float) -> str:
    """Return title of a small map, or its number, and how far strong outputs are over others."""
    title = fitting((person.title,), metrics, room_px) or person.title.split()[-1]
    return f"{title}\n{over_text(person.loudest_db)}"


class TargetPanel(FoundPanel):
    """What is to be strong and quiet, what plays there, and how near the drives come to it.

    Attributes
    ----------
    brushes
        Buttons of the brushes, by their names.
    sharpness
        From strong, at the left, to sharp.
    ways, people
        The table, and the small maps.
    """

    title: ClassVar[str] = "Target"
    name: ClassVar[str] = TARGET
    reads_down: ClassVar[bool] = True

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._target = Target()
        self.brushes = {
            name: tool_button(self, f"brush_{name}", title, BRUSH.hint, checkable=True)
            for name, title in BRUSH.options
            if name != NO_BRUSH
        }
        for name, button in self.brushes.items():
            button.clicked.connect(partial(self._take, name))
        self.sharpness = named(
            QtWidgets.QSlider(Qt.Orientation.Horizontal), "sharpness", BETA.label, BETA.hint
        )
        decades = log10(BETA.maximum / BETA.minimum)
        self.sharpness.setRange(0, round(_STEPS_PER_DECADE * decades))
        self.sharpness.valueChanged.connect(self._sharpen)
        self.sharpness.sliderPressed.connect(self._begin_drag)
        self._burst, self._gesture = Burst(self), 0
        self.use_clip = page_button("use_clip", "Use clip", "Play what the selected clip plays")
        self.use_clip.clicked.connect(self._use_clip)
        self.detach = page_button("detach_target", "Detach", "Leave ordinary tracks behind")
        self.detach.clicked.connect(
            lambda: self.edited.emit(edits.detach_target(self._design, self._view), None)
        )
        self.where = page_button("where_to_put", "Where to put…", "Find places for few actuators")
        self.where.clicked.connect(lambda: self.action_requested.emit("place_actuators"))
        # Rate and band of the limb, which limit the fields.
        self._played: tuple[float, Band | None] = SAMPLE_RATE_HZ, BAND_HZ
        self.fields = PartFields(_SPEC, new_editor, self)
        self.fields.edited.connect(self._change)
        self.grid, self.ways, self.people = FieldGrid(), WaysTable(), PeopleMaps()
        self.people_head = page_label("target_people_head", tone="dim")
        self.said = page_label("target_said")
        self.about = page_label("target_about", tone="dim")
        self.about.setToolTip(tooltip(Target.law, Target.source))
        self._lay_out()
        self.show_state(self._design, self._view)
        self.show_found(None)

    def sizeHint(self) -> QSize:
        return QSize(900, 260)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        facts, found = facts_of(design.limb), target_in(design)
        target = Target() if found is None else found[1]
        self._target = target
        for name, button in self.brushes.items():
            button.setChecked(name == brush_of(view))
        if (facts.sample_rate_hz, facts.band_hz) != self._played:
            self._played = facts.sample_rate_hz, facts.band_hz
            self.fields.set_spec(_SPEC.at_rate(*self._played))
        before = self.fields.cells
        self.fields.show_model(target)
        if self.fields.cells != before:
            self.grid.show_cells(self.fields.cells)
        self.sharpness.blockSignals(True)
        self.sharpness.setValue(round(_STEPS_PER_DECADE * log10(BETA.maximum / target.beta)))
        self.sharpness.blockSignals(False)
        self.detach.setEnabled(found is not None)
        self.use_clip.setEnabled(self._clip() is not None)
        if target.strong and self.said.text() == _EMPTY:
            self.said.setText(PREPARING)

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        # Where no brush is in sight a click on the skin selects; a studio that closes keeps it.
        studio = self.window().parentWidget() or self.window()
        if brush_of(self._view) and studio.isVisible():
            self._brush(NO_BRUSH)

    def show_found(self, found: Found | None) -> None:
        shown = found or Found(design=self._design, said=(_EMPTY,))
        self.ways.show_ways(shown.ways, shown.design.limb)
        self.said.setText(minus(" ".join(shown.said)))
        set_tone(self.said, "warning" if found else "dim")
        level = ""
        axes = axes_on(shown.design.limb, self._target.axes)
        along = "" if axes == ALL_AXES else f" along {axes}"
        if shown.ways:
            amplitude = shown.ways[-1].amplitude
            level = f"Each way gives {amplitude:.3g} m/s²{along} at the strong outputs. "
        self.about.setText(level + Target.limits)
        self.people.show_people(shown.people, self._target.strong)
        self.people_head.setText(f"Same drives, other limbs: over the loudest other{along}")
        for part in (self.ways, self._beside):
            part.setVisible(bool(shown.ways))

    def _clip(self) -> Clip | None:
        clip, found = leading_clip(self._design, self._view), target_in(self._design)
        own = () if found is None else self._design.motions[found[0]].clips
        return None if clip is None or clip.id in own else clip

    def _take(self, name: str) -> None:
        self._brush(name if self.brushes[name].isChecked() else NO_BRUSH)

    def _brush(self, name: str) -> None:
        self.view_changed.emit(with_settings(self._view, TARGET, TargetSettings(brush=name)))

    def _change(self, target: Target, gesture: int | None) -> None:
        self.edited.emit(edits.change_target(self._design, self._view, target), gesture)

    def _sharpen(self, steps: int) -> None:
        beta = BETA.maximum / 10.0 ** (steps / _STEPS_PER_DECADE)
        dragged = self.sharpness.isSliderDown()
        gesture = self._gesture if dragged else self._burst.gesture()
        self._change(replace(self._target, beta=beta), gesture)

    def _begin_drag(self) -> None:
        self._gesture = new_gesture()

    def _use_clip(self) -> None:
        if (clip := self._clip()) is not None:
            plain = replace(clip, onset_s=0.0, gain=1.0, muted=False, id=0)
            waveform = Layers((plain,)) if clip.effects else clip.waveform
            self._change(replace(self._target, waveform=waveform), None)

    def _lay_out(self) -> None:
        ends = [QtWidgets.QLabel(text) for text in ("Strong", "Sharp")]
        for label in ends:
            set_tone(label, "dim")
        strong, sharp = ends
        slider = in_row(strong, (self.sharpness, 1), sharp, gap_px=UNIT_PX // 2)
        brushes = in_row(*self.brushes.values(), None)
        buttons = self.use_clip, self.where, self.detach
        actions = FoldingRow(buttons, UNIT_PX // 2, left=True)
        inside = QtWidgets.QWidget()
        in_column(actions, self.grid, None, of=inside, margins=(0, 0, UNIT_PX, 0))
        left = in_column(brushes, slider, (scrolled(inside, "target_fields"), 1))
        words = QtWidgets.QWidget()
        in_column(self.said, self.about, None, of=words, margins=(0, 0, UNIT_PX, 0))
        # A row keeps the room of a hidden layout, and not that of a hidden widget.
        self._beside = QtWidgets.QWidget()
        in_column(self.people_head, (self.people, 1), of=self._beside, margins=0)
        below = in_row((scrolled(words, "target_words"), 1), (self._beside, 1))
        right = in_column(self.ways, (below, 1))
        edges = (UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        in_row((left, 3), (right, 6), of=self, margins=edges, gap_px=UNIT_PX)
