"""The pages on which a stimulus, or a set of them, is examined before it is written.

A worker prepares the stimulus that the form orders; the page shows its channels with their peaks
and the samples that would clip, and what the export loses.  That of a set asks for variables and
for an output at which levels are matched, and lists the conditions.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QRectF, QSize, Qt, Signal

from skinsource.actuators.equalising import RegularisedInverse
from skinsource.base.conventions import Floats
from skinsource.base.errors import SkinSourceError, Stopped, counted, sentence
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design, View, audible_inputs
from skinsource.design.display_units import display_unit, value_text
from skinsource.design.edits.edit import Edit
from skinsource.design.edits.setup import repair_for_actuators
from skinsource.export.formats.format import ChannelOverview
from skinsource.export.methods import methods_of
from skinsource.export.stimulus_export.export import write_prepared, written_files
from skinsource.export.stimulus_export.options import StimulusOptions
from skinsource.export.stimulus_export.preparing import PreparedStimulus, prepare_stimulus
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource.studies.sweeps.plan import HIGHEST_DB, LOWEST_DB, names_in
from skinsource.studies.sweeps.stimulus_set import MOST_CONDITIONS, Condition, export_set
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.editors import NumbersEditor
from skinsource_gui.fields.units import level_text, minus, output_text
from skinsource_gui.pages.files.export_parts import ExportPart, scrolled_fields
from skinsource_gui.pages.files.exports import STIMULUS, STIMULUS_SET
from skinsource_gui.pages.stimulus.form import Order, StimulusForm, recall, remembered
from skinsource_gui.plots.ranges import in_rows, without_notches
from skinsource_gui.qt.buttons import page_button, page_label, progress_bar, scrolled, show_or_hide
from skinsource_gui.qt.labels import RowTable
from skinsource_gui.qt.layouts import Policy, in_column, in_row, named, tooltip
from skinsource_gui.qt.overlays import PALE, Staleness
from skinsource_gui.qt.theme import UNIT_PX, current_theme, dots_in_px, set_tone, tabular
from skinsource_gui.state.worker import fault_text

_ROW_PX, _GAP_PX = 58, 6
_TEXT_PX = 208
_LEAST_PX = 160


class ChannelsView(QtWidgets.QWidget):
    """Paints one row for each channel."""

    def __init__(self) -> None:
        super().__init__()
        named(self, "stimulus_channels", "Channels as written")
        #: The channels that are painted.
        self.channels: tuple[ChannelOverview, ...] = ()
        self._colours: Mapping[int, int] = {}
        self.setSizePolicy(Policy.Expanding, Policy.Fixed)

    def sizeHint(self) -> QSize:
        return QSize(_TEXT_PX + 2 * _LEAST_PX, len(self.channels) * (_ROW_PX + _GAP_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(_TEXT_PX + _LEAST_PX, self.sizeHint().height())

    def show_channels(
        self, channels: tuple[ChannelOverview, ...], colours: Mapping[int, int]
    ) -> None:
        """Paint ``channels``; ``colours`` has the number of the colour of each input."""
        self.channels, self._colours = channels, colours
        lines = [line for channel in channels for line in channel_lines(channel)]
        self.setAccessibleDescription("; ".join(lines))
        self.updateGeometry()
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        for row, channel in enumerate(self.channels):
            top = row * (_ROW_PX + _GAP_PX)
            if event.rect().intersects(QRectF(0, top, self.width(), _ROW_PX).toRect()):
                self._paint_text(painter, channel, top)
                area = QRectF(_TEXT_PX, top, self.width() - _TEXT_PX, _ROW_PX)
                self._paint_picture(painter, channel, area)

    def _paint_text(self, painter: QtGui.QPainter, channel: ChannelOverview, top: float) -> None:
        room = QRectF(0, top, _TEXT_PX - UNIT_PX, _ROW_PX / 3)
        left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        painter.setFont(tabular(self.font()))
        metrics, theme = painter.fontMetrics(), current_theme()
        colours = theme.text, theme.dim, theme.error
        for number, (text, colour) in enumerate(zip(channel_lines(channel), colours, strict=False)):
            painter.setPen(QtGui.QColor(colour))
            elided = metrics.elidedText(text, Qt.TextElideMode.ElideRight, int(room.width()))
            painter.drawText(room.translated(0, number * _ROW_PX / 3), left, elided)

    def _paint_picture(
        self, painter: QtGui.QPainter, overview: ChannelOverview, area: QRectF
    ) -> None:
        painter.fillRect(area, QtGui.QColor(current_theme().base))
        middle, reach = area.center().y(), area.height() / 2.0 - 3.0
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().grid), 1))
        for level in (-1.0, 0.0, 1.0):
            y = middle - reach * level
            painter.drawLine(QLineF(area.left(), y, area.right(), y))
        inputs = overview.channel.inputs
        colour = QtGui.QColor(current_theme().dim)
        if inputs:
            colour = current_theme().input_colour(self._colours.get(inputs[0], 0))
        strokes = joined(np.clip(overview.extremes, -1.0, 1.0)).T.reshape(1, -1)
        low, high = without_notches(strokes).reshape(-1, 2).T
        x = area.left() + (np.arange(low.size) + 0.5) * area.width() / low.size
        width = max(area.width() / low.size, 1.0)
        painter.setPen(QtGui.QPen(colour, width, c=Qt.PenCapStyle.FlatCap))
        tops, bottoms = (
            in_rows(middle - reach * ends, dots_in_px(painter)) for ends in (high, low)
        )
        painter.drawLines(
            [
                QLineF(at, y - 0.5, at, max(bottom, y) + 0.5)
                for at, y, bottom in zip(x.tolist(), tops.tolist(), bottoms.tolist(), strict=True)
            ]
        )
        beyond = np.flatnonzero((abs(overview.extremes) > 1.0).any(axis=0))
        if overview.clipped and beyond.size:
            painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().error), max(width, 2.0)))
            painter.drawLines(
                [QLineF(at, area.top(), at, area.top() + 5.0) for at in x[beyond].tolist()]
            )


def joined(extremes: Floats) -> Floats:
    """Return least and largest values, (2, n_columns), extended to meet the stretch before.

    Otherwise stretches of few samples would be painted as separate dots.
    """
    low, high = extremes
    extended = extremes.copy()
    extended[0, 1:] = np.minimum(low[1:], high[:-1])
    extended[1, 1:] = np.maximum(high[1:], low[:-1])
    return extended


def channel_lines(overview: ChannelOverview) -> list[str]:
    """Return lines on a channel: its title, its strength, and how many samples would clip."""
    channel = overview.channel
    title = channel.title if channel.place is None else f"Place {channel.place}, {channel.title}"
    peak = "silent" if overview.peak == 0.0 else f"peak {20.0 * np.log10(overview.peak):z.1f} dB"
    rms = "" if overview.rms == 0.0 else f", RMS {20.0 * np.log10(overview.rms):z.1f} dB"
    lines = [f"{channel.number}  {title}", f"{peak}{rms}".replace("-", "\u2212")]
    if overview.clipped:
        lines.append(f"{counted(overview.clipped, 'sample')} would clip")
    return lines


#: Of the worker's tasks: only the newest order is prepared.
_ORDER, _MEND = "order", "mend"


class StimulusPart(ExportPart):
    """Shows the channels as they will be written, and asks for format and options.

    Parameters
    ----------
    design, view
        The design that is exported, and what is selected in it.
    last_settings
        Settings of the last export.
    stem
        Begin of the suggested name.
    """

    name = STIMULUS
    #: An `Edit` of what the design is made for, or after which it can be exported, and number of
    #: the gesture or None.
    edited = Signal(object, object)

    def __init__(
        self, design: Design, view: View, last_settings: str = "", stem: str = "stimulus"
    ) -> None:
        super().__init__(self.name)
        self._design, self._view, self._stem = design, view, stem
        self._colours = {track.id: track.colour for track in design.inputs}
        self._ordered: Order | None = None
        #: What is shown, and would be written; None while it is prepared.
        self.prepared: PreparedStimulus | None = None
        # The error that is shown, to which a remedy belongs.
        self._error: Exception | None = None
        self.form = StimulusForm(design, view)
        self.channels = ChannelsView()
        self._notes = page_label("stimulus_loses", tone="dim")
        self._bar = progress_bar("stimulus_progress", "Progress", keeps_room=True)
        self._bar.setTextVisible(True)
        self._bar.setFormat("Computing… %p %")
        self._bar.setFixedWidth(_TEXT_PX)
        self._bar.hide()
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._bar.setVisible)
        self._confirm = named(QtWidgets.QCheckBox("Write anyway"), "stimulus_confirm")
        self._confirm.hide()
        self._mend = page_button("stimulus_mend", "", "Makes it playable")
        self._mend.clicked.connect(lambda: self._mending())
        self._mend.hide()
        self._copy = page_button("stimulus_copy_methods", "", "Text for the methods of a paper")
        self._copy.clicked.connect(self._copy_methods)
        self.setFocusProxy(self.form.field("format"))
        left = scrolled_fields(self._fields(), "stimulus_fields")
        self._pictures = scrolled(self.channels, "stimulus_scroll")
        self._pictures.setAccessibleName("Channels; arrow keys scroll")
        columns = in_row(left, (self._preview(), 1), gap_px=2 * UNIT_PX)
        foot = in_row(self._bar, self._mend, None, self._copy)
        below = self._summary, self._notes, self._problem, self._confirm, foot
        in_column((columns, 1), *below, of=self, margins=0, gap_px=UNIT_PX)
        self.form.changed.connect(self._order)
        self.form.edited.connect(self.edited)
        self.form.refused.connect(self._show_refused)
        self._confirm.toggled.connect(self._show_readiness)
        recall(self.form, last_settings)
        self.form.emit_order()

    @property
    def settings(self) -> str:
        """Settings to remember for the next export."""
        return remembered(self.form)

    @property
    def wired(self) -> dict[str, Any]:
        """Channels, as `skinsource.export_wiring` takes them."""
        order = self._ordered
        return {} if order is None else {"options": replace(order.options, choices={})}

    def show_design(self, design: Design) -> None:
        """Export another design, with the same choices."""
        self._design = design
        self.form.show_design(design)

    @property
    def busy(self) -> bool:
        """Whether the order that is prepared is not shown yet."""
        return self._ordered is not None and self.prepared is None

    def suggestion(self) -> tuple[str, str]:
        kind = self.form.format
        title = "New folder" if kind.folder else kind.title
        return f"{self._stem}{kind.suffix}", f"{title} (*{kind.suffix})"

    def files(self, path: Path) -> Iterable[tuple[Path, ...]]:
        return () if self.prepared is None else written_files(self.prepared, path)

    def writer(self, path: Path) -> Callable[..., Any]:
        return partial(_write, self.prepared, path, self._confirm.isChecked())

    def _fields(self) -> QtWidgets.QWidget:
        """Return what is at the left."""
        return self.form

    def _preview(self) -> Any:
        """Return what is at the right."""
        return self._pictures

    def _copy_methods(self) -> None:
        """Put the methods text on the clipboard, once it is computed."""
        if self.prepared is not None:
            work = partial(methods_of, self._view, self.prepared)
            self._worker.run(work, self._put_on_clipboard)

    def _put_on_clipboard(self, text: str | None, error: Exception | None) -> None:
        if error is not None or text is None:
            self._show_refused(fault_text(error) if error else "")
            return
        QtGui.QGuiApplication.clipboard().setText(text)
        self._copy.setText("Methods text copied")

    def _order(self, order: Order) -> None:
        self._ordered, self.prepared = order, None
        # Clipping was confirmed for another order.
        self._confirm.setChecked(False)
        self._show_computing(True)
        self._show_readiness()
        work = self._work(order, self._design)
        self._worker.run_newest(_ORDER, work, partial(self._receive, order))

    def _work(self, order: Order, design: Design) -> Callable[[], Any]:
        """Return what computes what will be written, in the thread of the worker."""
        ordered = design, order.format, order.rate_hz, order.options
        return partial(prepare_stimulus, *ordered, **self._job(order))

    def _job(self, order: Order) -> dict[str, Any]:
        return {
            "progress": lambda done, total, _: self._worker.tell(
                self._show_progress, order, done, total
            ),
            "stop": partial(self._worker.is_outdated, _ORDER),
        }

    def _receive(self, order: Order, computed: Any, error: Exception | None) -> None:
        if order is not self._ordered or isinstance(error, Stopped):
            return
        if computed is None:
            self._show_refused(fault_text(error) if error else "")
            self._error = error
            find, offer = partial(self._find_mend, order), partial(self._offer_mend, error)
            self._worker.run_newest(_MEND, partial(find, str(error)), offer)
            return
        self._show_computing(False)
        self._show_computed(computed)

    def _find_mend(self, order: Order, error: str) -> Edit | None:
        """Return an edit that mends what keeps this from being exported, in the worker's thread.

        None: ``error`` stays.
        """
        found = self._mended(order)
        if found is None:
            return None
        try:
            self._work(order, found.design)()
        except SkinSourceError as left:
            if str(left) == error:
                return None
        return found

    def _mended(self, order: Order) -> Edit | None:
        """Return an edit without the equaliser of a chip, or for actuators that cannot follow.

        It is named after its last part, where several inputs need one.
        """
        chosen, found = self._design.actuation, None
        if chosen is not None and chosen.equaliser is not None and not order.format.plays_waveform:
            without = replace(self._design, actuation=replace(chosen, equaliser=None))
            return Edit(label="Remove the equaliser", design=without, view=self._view)
        through = None if chosen is None else replace(chosen, equaliser=RegularisedInverse())
        design = replace(self._design, actuation=through)
        for track in audible_inputs(design.inputs):
            found = repair_for_actuators(design, self._view, track.id) or found
            design = found.design if found else design
        return found and replace(found, design=replace(design, actuation=chosen))

    def _offer_mend(self, error: Exception | None, edit: Edit | None, _: object) -> None:
        if edit and error is self._error:
            self._offer(edit.label, partial(self.edited.emit, edit, None))

    def _offer(self, remedy: str, mend: Callable[[], object]) -> None:
        """Offer a remedy as a button; "": none."""
        self._mending = mend
        show_or_hide(self._mend, remedy)

    def _show_computed(self, prepared: Any) -> None:
        self._show_channels(prepared)
        self.form.show_silence(prepared.lead_in_s, prepared.tail_s)
        objections = " ".join(filter(None, (prepared.advice_on_loss, *prepared.objections)))
        self._show(sentence(prepared.summary), objections, ask=bool(objections))

    def _show_channels(self, prepared: PreparedStimulus) -> None:
        self.prepared = prepared
        self.channels.show_channels(prepared.channels, self._colours)
        silent = "" if self._ordered is None else left_out(self._design, self._ordered.options)
        calibration = sentence(f"{prepared.calibration[:1].upper()}{prepared.calibration[1:]}")
        notes = silent, prepared.edges, prepared.loses, calibration
        self._notes.setText(" ".join(filter(None, notes)))
        set_tone(self._notes, "warning" if prepared.misfit or prepared.misscaled else "dim")
        if volts := prepared.remedy_v:
            self._offer(f"Full scale of {volts:g} V", partial(self.form.choose_full_scale, volts))

    def _show_progress(self, order: Order, done: int, total: int) -> None:
        if order is self._ordered:
            self._bar.setMaximum(max(total, 1))
            self._bar.setValue(done)

    def _show_computing(self, computing: bool) -> None:
        """Show pale what is out of date; soon also how much is computed of what comes instead."""
        self._bar.setValue(0)
        self._error = None
        self._offer("", lambda: None)
        self._staleness.set_stale(computing)
        for part in (self.channels, self._summary, self._notes, self._problem):
            effect = QtWidgets.QGraphicsOpacityEffect(part, opacity=PALE)
            effect.setEnabled(computing)
            part.setGraphicsEffect(effect)

    def _show_refused(self, reason: str) -> None:
        self._ordered = self.prepared = None
        self._show_computing(False)
        self.channels.show_channels((), {})
        self._notes.setText("")
        self._show("", sentence(reason), ask=False)

    def _show(self, summary: str, problem: str, *, ask: bool) -> None:
        self._say(summary, problem)
        self._confirm.setVisible(ask)
        self._show_readiness()

    def _show_readiness(self) -> None:
        confirmed = self._confirm.isHidden() or self._confirm.isChecked()
        self.ready = self.prepared is not None and confirmed
        self._copy.setEnabled(self.prepared is not None)
        self._copy.setText("Copy methods text")
        self.changed.emit()


def _write(prepared: Any, path: Path, confirmed: bool, *, largest_error: float, **job: Any) -> Path:
    """Write what was shown; return the first of its files."""
    # Drives are sampled, not predicted.
    return write_prepared(prepared, path, confirmed=confirmed, **job).files[0]


def left_out(design: Design, options: StimulusOptions) -> str:
    """Return a sentence on tracks and clips, chosen ones or all, that are silent; "": none is."""
    every = options.inputs is options.clips is None
    ids, clips, silent = options.inputs or (), options.clips or (), []
    for track in design.inputs:
        chosen = [clip for clip in track.clips if every or track.id in ids or clip.id in clips]
        n_muted = sum(clip.muted for clip in chosen)
        if track not in audible_inputs(design.inputs):
            if every or track.id in ids or chosen:
                why = "muted" if track.muted else "not solo"
                silent.append(f"track at {track.location} ({why})")
        elif n_muted:
            silent.append(f"{counted(n_muted, 'muted clip')} at {track.location}")
    return f"Left out: {', '.join(silent)}." if silent else ""


#: Of the worker's tasks: only the condition that was pointed at last is prepared.
_POINTED = "condition"
_COLUMNS = {
    "File": "What is written, by its values",
    "Duration": "With lead-in and tail",
    "Peak": "Largest drive",
    "Gain": "Of all amplitudes, so that the level is matched",
    "Level": "RMS of the loudest 100 ms at the matched output",
}
_VARIED = "What differs between the files; all combinations of values are written"
_MATCHED = "Output where all files have the same level"
_LEVEL = ListSpec(
    label="Level (dB)",
    hint="dB re 1 m/s²; empty: level of the design",
    of=NumberSpec(label="Level", minimum=LOWEST_DB, maximum=HIGHEST_DB),
    most=MOST_CONDITIONS,
)
#: Title, specification and value of numbers, by their names.
Numbers = dict[str, tuple[str, NumberSpec, float]]


def numbers_in(design: Design) -> Numbers:
    """Return the numbers that a set can vary, of all tracks and then of each."""
    of_all: Numbers = {}
    of_one: Numbers = {}
    facts, names = facts_of(design.limb), names_in(design)
    for number, track in enumerate(design.inputs, start=1):
        for part in (*(clip.waveform for clip in track.clips), *track.clips, track):
            for name, spec in specs_of(part).items():
                if name not in names or not isinstance(spec, NumberSpec):
                    continue
                if name == "amplitude":
                    spec = replace(spec, unit=amplitude_unit(design))
                spec = spec.at_rate(facts.sample_rate_hz, facts.band_hz)
                title = f"{spec.label} ({display_unit(spec.unit).symbol})".removesuffix(" ()")
                value = getattr(part, name)
                of_all.setdefault(name, (title, spec, value))
                of_one.setdefault(f"{number}.{name}", (f"{title}, track {number}", spec, value))
    if len(design.inputs) == 1:
        return of_all
    return {name: (f"{each[0]}, all tracks", *each[1:]) for name, each in of_all.items()} | of_one


class SetPart(StimulusPart):
    """Shows the conditions of a stimulus set, and the channels of the one that is pointed at."""

    name = STIMULUS_SET
    #: The set that is shown, and would be written; None while it is prepared.
    planned: Any = None

    def recall(self, kept: dict[str, Any]) -> None:
        """Show the fields of the last set as far as the design has them, and keep them there."""
        rows, output, levels_db = kept.get(self.name, ((), "", ()))
        for variable, (name, values) in zip(self.variables, rows, strict=False):
            if name in ("", *self._numbers):
                self.choose(variable, name)
            if values and name in self._numbers:
                self.values[variable].set_value(values)
        if self.output.findData(output) >= 0:
            self.output.set_value(output)
        self.level.set_value(levels_db)
        self.form.emit_order()
        self.changed.connect(partial(self._keep, kept))

    def _keep(self, kept: dict[str, Any]) -> None:
        typed = {name: editor.value for each, editor in self.values.items() if (name := each.value)}
        # The present value of a design is not that of the next one.
        typed |= {name: () for name in typed if typed[name] == self._numbers[name][2:]}
        rows = [(each.value, typed.get(each.value, ())) for each in self.variables]
        kept[self.name] = rows, self.output.value, self.level.value

    def show_design(self, design: Design) -> None:
        super().show_design(design)
        self._name_variables()

    def _name_variables(self) -> None:
        # The unit of amplitudes is that of what the design is made for.
        self._numbers = numbers_in(self._design)
        titles = {"": "None", **{name: number[0] for name, number in self._numbers.items()}}
        for variable in self.variables:
            variable.set_options(titles.items())

    def suggestion(self) -> tuple[str, str]:
        return f"{self._stem}-set", "New folder, none replaced (*)"

    def files(self, path: Path) -> tuple[()]:
        return ()

    def writer(self, path: Path) -> Callable[..., Any]:
        return partial(_write_set, self.planned, path)

    def _fields(self) -> QtWidgets.QWidget:
        limb = self._design.limb
        self.variables = [
            ChoiceField(ChoiceSpec(label=f"Variable {k}", options=(), hint=_VARIED))
            for k in (1, 2, 3)
        ]
        self._name_variables()
        self.values: dict[ChoiceField, NumbersEditor] = {}
        outputs = dict.fromkeys((*self._view.outputs, *range(1, facts_of(limb).n_outputs + 1)))
        options = (("", "None"), *((str(n), output_text(n, limb)) for n in outputs))
        matched = ChoiceSpec(label="Match levels at", options=options, hint=_MATCHED)
        self.output, self.level = ChoiceField(matched), NumbersEditor(_LEVEL, self)
        self.level.line.setPlaceholderText("that of the design")
        self._follow(self.level)
        self._rows = QtWidgets.QFormLayout()
        for variable in self.variables:
            variable.edited.connect(partial(self.choose, variable))
            self._rows.addRow(variable.accessibleName(), variable)
        self.output.edited.connect(self.form.emit_order)
        self._rows.addRow(matched.label, self.output)
        self._rows.addRow(_LEVEL.label, self.level)
        self.setFocusProxy(self.variables[0])
        fields = QtWidgets.QWidget()
        in_column(self._rows, self.form, None, of=fields, margins=0, gap_px=UNIT_PX)
        self.choose(self.variables[0], next(iter(self._numbers), ""))
        return fields

    def choose(self, variable: ChoiceField, name: str, *_: object) -> None:
        """Vary a number, at first its present value alone; "": none."""
        variable.set_value(name)
        if variable in self.values:
            self._rows.removeRow(self.values.pop(variable))
        if name:
            title, spec, value = self._numbers[name]
            of = ListSpec(label=title, hint=title, of=spec, fewest=1, most=MOST_CONDITIONS)
            editor = self.values[variable] = NumbersEditor(of, self)
            editor.line.setAccessibleName(f"{title}, values")
            if editor.label:
                # The variable above says it.
                editor.label.clear()
            editor.set_value((value,))
            self._follow(editor)
            row: Any = self._rows.getWidgetPosition(variable)
            self._rows.insertRow(row[0] + 1, "Values", editor)
            editor.setFocusProxy(None)  # type: ignore[arg-type]
            stops = [variable, editor.line, *editor.findChildren(QtWidgets.QToolButton)]
            for before, after in pairwise(stops):
                self.setTabOrder(before, after)
        self.form.emit_order()

    def _follow(self, editor: NumbersEditor) -> None:
        # A sweep is chosen in a dialog.
        editor.edited.connect(editor.set_value)
        editor.edited.connect(self.form.emit_order)
        editor.problem_changed.connect(self.form.emit_order)

    def _preview(self) -> QtWidgets.QLayout:
        self._about = page_label("set_condition")
        self.table = RowTable("set_table", "Conditions", _COLUMNS, wide={0})
        self.table.currentCellChanged.connect(self._point)
        self._copy.hide()
        return in_column((self.table, 3), self._about, (self._pictures, 2), margins=0)

    def _order(self, order: Order) -> None:
        self.planned = None
        self._rows.setRowVisible(self.level, bool(self.output.value))
        names = [variable.value for variable in self.values]
        twice = "A variable is chosen twice. Choose another one"
        problems = [twice] * (len(set(names)) < len(names))
        problems += [editor.line.problem for editor in self.values.values()]
        problems += [self.level.line.problem] * bool(self.output.value)
        if any(problems):
            self._show_refused(next(filter(None, problems)))
        else:
            super()._order(order)

    def _work(self, order: Order, design: Design) -> Callable[[], Any]:
        return partial(
            export_set,
            design,
            {each.value: self.values[each].value for each in self.variables if each.value},
            None,
            order.format.name,
            order.rate_hz,
            options=order.options,
            match_output=int(self.output.value or 0) or None,
            level_db=(self.level.value or None) if self.output.value else None,
            **self._job(order),
        )

    def _show_computed(self, planned: Any) -> None:
        self.planned = planned
        for column in (3, 4):
            self.table.setColumnHidden(column, planned.output is None)
        self.table.clearSpans()
        row = max(self.table.currentRow(), 0)
        self.table.fill(list(map(_cells, planned.conditions)), row)
        for row, condition in enumerate(planned.conditions):
            if condition.refused:
                self.table.setSpan(row, 0, 1, len(_COLUMNS))
        self._point()

    def _show_refused(self, reason: str) -> None:
        self.table.setRowCount(0)
        super()._show_refused(reason)

    def _point(self, *_: object) -> None:
        """Show the condition of the chosen row."""
        if self.planned is None or self.table.currentRow() < 0:
            return
        condition = self.planned.conditions[self.table.currentRow()]
        self._show(sentence(self.planned.summary), condition.refused, ask=False)
        level = f", {level_text(condition.level_db, 'loudest')}" if self.planned.output else ""
        self._about.setText(condition.name + level * (not condition.refused))
        self.channels.show_channels((), {})
        stop = partial(self._worker.is_outdated, _POINTED)
        work = partial(self.planned.prepared, condition, stop)
        self._worker.run_newest(_POINTED, work, self._show_condition)

    def _show_condition(self, prepared: Any, _: object) -> None:
        if self.planned is not None and prepared is not None:
            self._show_channels(prepared)

    def _show_readiness(self) -> None:
        self.ready = self.planned is not None and bool(self.planned.written)
        self.changed.emit()


def _cells(condition: Condition) -> list[tuple[str, str]]:
    if condition.refused:
        text = f"{condition.name}: {condition.refused}"
        return [(text, tooltip(text))]
    unit = condition.unit if condition.unit in ("m/s²", "V") else ""
    texts = (
        condition.name,
        value_text(condition.duration_s, "s", digits=4),
        f"{condition.peak:.3g} {unit}".rstrip(),
        minus(f"{condition.gain_db:+.1f} dB"),
        minus(f"{condition.level_db:z.1f} dB"),
    )
    return [(text, tooltip(text, condition.weakened)) for text in texts]


def _write_set(planned: Any, path: Path, *, largest_error: float, **job: Any) -> None:
    planned.write(path, **job)
