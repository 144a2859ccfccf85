"""The part of the export dialog for stimulus sets: variables, a matched output, and a preview."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

from PySide6 import QtWidgets

from skinsource.base.quoting import sentence
from skinsource.design.amplitudes import amplitude_unit
from skinsource.design.design import Design
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.models import specs_of
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource.specs.spec import ChoiceSpec
from skinsource.studies.sweeps.plan import HIGHEST_DB, LOWEST_DB, names_in
from skinsource.studies.sweeps.stimulus_set import MOST_CONDITIONS, Condition, export_set
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.list_editors import NumbersEditor
from skinsource_gui.fields.units import display_unit, minus, output_text, value_text
from skinsource_gui.pages.files.exports import STIMULUS_SET
from skinsource_gui.pages.page import RowTable
from skinsource_gui.pages.stimulus.form import Order
from skinsource_gui.pages.stimulus.page import StimulusPart
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import UNIT_PX

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
    most=1,
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
    return of_all | of_one if len(design.inputs) > 1 else of_all


class SetPart(StimulusPart):
    """Shows the conditions of a stimulus set, and the channels of the one that is pointed at."""

    name = STIMULUS_SET
    #: The set that is shown, and would be written; None while it is prepared.
    planned: Any = None

    def suggestion(self) -> tuple[str, str, tuple[str, ...], str]:
        return f"{self._stem}-set", "Folder (*)", (), ""

    def files(self, path: Path) -> tuple[()]:
        return ()

    def writer(self, path: Path) -> Callable[..., Any]:
        return partial(_write, self.planned, path)

    def _fields(self) -> QtWidgets.QWidget:
        self._numbers, limb = numbers_in(self._design), self._design.limb
        options = (("", "None"), *((name, number[0]) for name, number in self._numbers.items()))
        self.variables = [
            ChoiceField(ChoiceSpec(label=f"Variable {k}", options=options, hint=_VARIED))
            for k in (1, 2, 3)
        ]
        self.values: dict[ChoiceField, NumbersEditor] = {}
        outputs = dict.fromkeys((*self._view.outputs, *range(1, facts_of(limb).n_outputs + 1)))
        options = (("", "None"), *((str(n), output_text(n, limb)) for n in outputs))
        matched = ChoiceSpec(label="Match levels at", options=options, hint=_MATCHED)
        self.output, self.level = ChoiceField(matched), NumbersEditor(_LEVEL, self)
        self.level.line.setPlaceholderText("that of the design")
        self._rows = QtWidgets.QFormLayout()
        for variable in self.variables:
            variable.edited.connect(partial(self.choose, variable))
            self._rows.addRow(variable.accessibleName(), variable)
        for title, field in ((matched.label, self.output), (_LEVEL.label, self.level)):
            field.edited.connect(self.form.emit_order)
            self._rows.addRow(title, field)
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
            editor.set_value((value,))
            # A sweep is chosen in a dialog.
            editor.edited.connect(editor.set_value)
            editor.edited.connect(self.form.emit_order)
            row: Any = self._rows.getWidgetPosition(variable)
            self._rows.insertRow(row[0] + 1, "Values", editor)
            editor.setFocusProxy(None)  # type: ignore[arg-type]
            stops = [variable, editor.line, *editor.findChildren(QtWidgets.QToolButton)]
            for before, after in pairwise(stops):
                self.setTabOrder(before, after)
        self.form.emit_order()

    def _preview(self) -> QtWidgets.QLayout:
        self.table = RowTable("set_table", "Conditions", _COLUMNS, wide={0})
        self.table.currentCellChanged.connect(self._point)
        self._copy.hide()
        return in_column((self.table, 3), (self._pictures, 2), margins=0)

    def _order(self, order: Order) -> None:
        self.planned = None
        self._rows.setRowVisible(self.level, bool(self.output.value))
        names = [variable.value for variable in self.values]
        if len(set(names)) == len(names):
            super()._order(order)
        else:
            self._show_refused("A variable is chosen twice. Choose another one")

    def _work(self, order: Order) -> Callable[[], Any]:
        return partial(
            export_set,
            self._design,
            {each.value: self.values[each].value for each in self.variables if each.value},
            None,
            order.format.name,
            order.rate_hz,
            options=order.options,
            match_output=int(self.output.value or 0) or None,
            level_db=next(iter(self.level.value), None) if self.output.value else None,
            **self._made_for(order),
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
        return [(f"{condition.name}: {condition.refused}", condition.refused)]
    unit = condition.unit if condition.unit in ("m/s²", "V") else ""
    texts = (
        condition.name,
        value_text(condition.duration_s, "s", digits=4),
        f"{condition.peak:.3g} {unit}".rstrip(),
        minus(f"{condition.gain_db:+.1f} dB"),
        minus(f"{condition.level_db:z.1f} dB"),
    )
    return [(text, text) for text in texts]


def _write(planned: Any, path: Path, *, largest_error: float, **job: Any) -> Path:
    planned.write(path, **job)
    return path
