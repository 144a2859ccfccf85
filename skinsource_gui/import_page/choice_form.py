"""What a file leaves open about a recording, as fields."""

from dataclasses import replace

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QFormLayout, QWidget

from skinsource.base.published import SAMPLE_RATE_HZ
from skinsource.design.recordings import UNITS, Found, ImportChoice, Series, suggested, usual_scale
from skinsource.readers.limits import LEAST_RATE_HZ, MOST_PART_S, MOST_RATE_HZ
from skinsource.readers.reader import other_axes
from skinsource.specs.fields import ChoiceSpec, NumberSpec
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField

#: Of a file that says none, until it is typed.
ASSUMED_RATE_HZ = SAMPLE_RATE_HZ
# Of a longer recording, its beginning to start with.
_WHOLE_UP_TO_S, _BEGINNING_S = 60.0, 10.0
_LONGEST_START_S = 1e6
_STEADY = "steady"
_SIGNAL = ChoiceSpec(label="Signal", options=(), hint="Which channel, column or dataset")
_AXES = ChoiceSpec(
    label="Axes",
    options=(),
    hint="As one: the energy of all three at each frequency, and the phase of their sum (DFT321, "
    "Landin et al. 2010)",
)
_TIMING = ChoiceSpec(label="Times", options=(), hint="What says when each sample was taken")
_TIME_UNIT = ChoiceSpec(
    label="Stamps in", options=(("1", "s"), ("0.001", "ms"), ("1e-06", "µs")), hint="Their unit"
)
_UNIT = ChoiceSpec(
    label="Unit",
    options=tuple((name, unit.title) for name, unit in UNITS.items()),
    hint="Velocities and displacements become accelerations, from 25 Hz on",
)
_SCALE = ChoiceSpec(
    label="Size",
    options=(("peak", "Scale to a peak of 1"), ("keep", "Keep as it is")),
    hint="What is kept is in m/s² where the unit is one of motion",
)
_RATE = NumberSpec(
    label="Sample rate",
    unit="Hz",
    minimum=LEAST_RATE_HZ,
    maximum=MOST_RATE_HZ,
    step=0.02,
    logarithmic=True,
    hint="The file does not say it",
)
_START = NumberSpec(
    label="Start", unit="s", minimum=0.0, maximum=_LONGEST_START_S, step=0.1, hint="Of the part"
)
_DURATION = NumberSpec(
    label="Length", unit="s", minimum=0.001, maximum=MOST_PART_S, step=0.1, hint="Of the part"
)


class ChoiceForm(QWidget):
    """Asks only for what ``found`` leaves open; the rest is said by `given`."""

    #: The `ImportChoice` that is wanted now.
    changed = Signal(object)

    def __init__(self, found: Found, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("import_form")
        self._found = found
        self._series = found.signals()[0]
        self._choice = suggested(found)
        self._lasts_s: float | None = None
        self._part_chosen = False
        # How long the part shall be, also where less is left after its start.
        self._wanted_s = _BEGINNING_S
        # Keys of the other axes, by what is chosen.
        self._others: dict[str, tuple[str, ...]] = {"": ()}
        self._signal, self._timing = ChoiceField(_SIGNAL), ChoiceField(_TIMING)
        self._axes = ChoiceField(_AXES)
        self._time_unit, self._unit = ChoiceField(_TIME_UNIT), ChoiceField(_UNIT)
        self._scale = ChoiceField(_SCALE)
        self._rate, self._start = NumberField(_RATE), NumberField(_START)
        self._duration = NumberField(_DURATION)
        self._offset = QCheckBox("Take the offset off")
        self._missing = QCheckBox("Count missing numbers as 0")
        self._widgets: dict[str, QWidget] = {
            "signal": self._signal,
            "axes": self._axes,
            "timing": self._timing,
            "time_unit": self._time_unit,
            "rate": self._rate,
            "unit": self._unit,
            "scale": self._scale,
            "offset": self._offset,
            "start": self._start,
            "duration": self._duration,
            "missing": self._missing,
        }
        for name, widget in self._widgets.items():
            widget.setObjectName(f"import_{name}")
        self._lay_out()
        _fill(self._form, self._signal, [(one.key, one.name) for one in found.signals()])
        self._take_series(self._series)

    @property
    def choice(self) -> ImportChoice:
        """What is wanted now."""
        return self._choice

    @property
    def series(self) -> Series:
        """The signal that is chosen."""
        return self._series

    @property
    def assumes_rate(self) -> bool:
        """Whether a rate counts that neither the file nor the user has said."""
        stated = self._found.rate_of(self._series) is not None
        return self._choice.time is None and not stated and not self._rate_typed

    @property
    def lasts_s(self) -> float | None:
        """Length of the whole signal; None while only its time stamps know."""
        rate_hz = self._choice.rate_hz
        return self._lasts_s if rate_hz is None else self._series.n_samples / rate_hz

    def take_part(self, start_s: float, duration_s: float) -> None:
        """Want another part, as a user does."""
        self._start.set_value(start_s)
        self._choose_part(max(duration_s, _DURATION.minimum))

    def show_length(self, lasts_s: float) -> None:
        """Take over how long the whole signal is, and all of it unless a part was chosen."""
        self._lasts_s = lasts_s
        self._start.set_spec(replace(_START, maximum=lasts_s))
        whole_s = max(lasts_s, _DURATION.minimum) if lasts_s <= _WHOLE_UP_TO_S else _BEGINNING_S
        if not self._part_chosen:
            self._wanted_s = whole_s
        before = self._choice
        self._fit()
        if self._choice != before:
            self.changed.emit(self._choice)

    def show_missing(self, n_missing: int) -> None:
        """Offer to count missing numbers as 0, where there are some."""
        wanted = n_missing > 0 or self._missing.isChecked()
        self._form.setRowVisible(self._missing, wanted)

    def _lay_out(self) -> None:
        self._form = QFormLayout(self)
        self._form.setContentsMargins(0, 0, 0, 0)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        labels = {
            "signal": "Signal",
            "axes": "Axes",
            "timing": "Times",
            "time_unit": "Stamps in",
            "rate": "Sample rate",
            "unit": "Unit",
            "scale": "Size",
            "start": "Start",
            "duration": "Length",
        }
        for name, widget in self._widgets.items():
            self._form.addRow(labels.get(name, ""), widget)
        self._form.setRowVisible(self._missing, False)
        self._signal.chosen.connect(self._choose_signal)
        self._unit.chosen.connect(lambda unit, *_: self._scale.set_value(usual_scale(unit)))
        for field in (self._axes, self._timing, self._time_unit, self._unit, self._scale):
            field.chosen.connect(self._take_over)
        self._start.edited.connect(lambda *_: self._choose_part())
        self._duration.edited.connect(lambda length_s, *_: self._choose_part(length_s))
        self._rate.edited.connect(lambda *_: self._take_over(rate_typed=True))
        self._offset.toggled.connect(self._take_over)
        self._missing.toggled.connect(self._take_over)

    def _choose_signal(self, key: str) -> None:
        series = self._found.one(key)
        if series is not None:
            self._take_series(series)
            self._take_over()

    def _take_series(self, series: Series) -> None:
        """Show what the file says about a signal, and what is likely to be wanted."""
        self._series = series
        first = suggested(self._found, series)
        stated = self._found.rate_of(series)
        self._rate_typed = self._part_chosen = False
        self._lasts_s = None
        others = [
            one
            for one in self._found.series
            if one.n_samples == series.n_samples and one.key != series.key
        ]
        # Columns that are not called time may be it, where nothing else says the rate.
        stamps = [one for one in others if one.is_time or stated is None][:50]
        steady = "At a steady rate" if stated is None else f"At {stated:g} Hz"
        _fill(
            self._form,
            self._timing,
            [(_STEADY, steady), *((one.key, f"In {one.name}") for one in stamps)],
        )
        axes = other_axes(self._found, series)
        together = f"With {' and '.join(one.name for one in axes)}, as one (DFT321)"
        offered = [(" ".join(one.key for one in axes), together)] if axes else []
        _fill(self._form, self._axes, [("", f"{series.name} alone"), *offered])
        self._others = {"": (), **{key: tuple(one.key for one in axes) for key, _ in offered}}
        self._timing.set_value(first.time or _STEADY)
        self._rate.set_value(stated or ASSUMED_RATE_HZ)
        self._time_unit.set_value(f"{first.time_unit_s:g}")
        self._unit.set_value(first.unit)
        self._scale.set_value(first.scale)
        self._form.setRowVisible(self._unit, not series.unit)
        self._offset.setChecked(first.remove_offset)
        lasts_s = series.n_samples / (stated or ASSUMED_RATE_HZ)
        known = stated is not None and first.time is None
        if known:
            self._start.set_spec(replace(_START, maximum=lasts_s))
        whole = known and lasts_s <= _WHOLE_UP_TO_S
        self._wanted_s = max(lasts_s, _DURATION.minimum) if whole else _BEGINNING_S
        self._start.set_value(0.0)
        self._fit()
        self._show_rows()

    def _choose_part(self, length_s: float | None = None) -> None:
        self._part_chosen = True
        self._wanted_s = self._wanted_s if length_s is None else length_s
        self._take_over()

    def _fit(self) -> None:
        """Take over what the fields say; of the length no more than is left after the start."""
        # How long all of it is depends on the rate that is chosen.
        self._choice = self._wanted()
        most_s = MOST_PART_S
        if self.lasts_s is not None:
            left_s = self.lasts_s - self._start.value_si
            most_s = min(max(left_s, _DURATION.minimum), MOST_PART_S)
        self._duration.set_spec(replace(_DURATION, maximum=most_s))
        self._duration.set_value(min(self._wanted_s, most_s))
        self._choice = self._wanted()

    def _take_over(self, *_: object, rate_typed: bool = False) -> None:
        self._rate_typed = self._rate_typed or rate_typed
        self._fit()
        self._show_rows()
        self.changed.emit(self._choice)

    def _show_rows(self) -> None:
        steady = self._timing.value == _STEADY
        stated = self._found.rate_of(self._series) is not None
        stamps = self._found.one(self._timing.value)
        self._form.setRowVisible(self._rate, steady and not stated)
        self._form.setRowVisible(self._time_unit, stamps is not None and not stamps.is_time)

    def _wanted(self) -> ImportChoice:
        timing = self._timing.value
        stamps = self._found.one(timing)
        unit_s = stamps.time_unit_s if stamps and stamps.is_time else float(self._time_unit.value)
        stated = self._found.rate_of(self._series)
        return ImportChoice(
            series=self._series.key,
            rate_hz=None if stamps else (stated or self._rate.value_si),
            time=stamps.key if stamps else None,
            time_unit_s=unit_s,
            unit=self._unit.value,
            scale="keep" if self._scale.value == "keep" else "peak",
            remove_offset=self._offset.isChecked(),
            start_s=self._start.value_si,
            duration_s=self._duration.value_si,
            missing="zero" if self._missing.isChecked() else "refuse",
            others=self._others[self._axes.value],
        )


def _fill(form: QFormLayout, field: ChoiceField, options: list[tuple[str, str]]) -> None:
    field.clear()
    for option, words in options:
        field.addItem(words, option)
    form.setRowVisible(field, len(options) > 1)
