"""What the skin does by a stimulus, of one alone or of several together."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skinsource.base.arrays import Complexes, Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped
from skinsource.base.job import Stop, never, stop_if
from skinsource.base.published import axis_numbers
from skinsource.base.quoting import sentence
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.engine.level_rules import record_rms
from skinsource.engine.moments import (
    Projection,
    covariance_of,
    directions_of,
    energies,
    energies_of,
    needs_products,
)
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.shared import Shared
from skinsource.engine.trace_rules import shown_outputs
from skinsource.engine.transforms import inverse_here
from skinsource.limbs.limb import Limb
from skinsource.signals.loudest_window import loudest_energy, window_samples
from skinsource.studies.sweeps.metrics import (
    ACTUATOR_METRICS,
    OF_EXTENT,
    DriveMetrics,
    Extents,
    PreparedStimulus,
    Preparing,
    actuator_metrics,
    main_axes,
)
from skinsource.studies.sweeps.neighbours import Batch, Field, Fields, Vibrations
from skinsource.studies.sweeps.plan import Plan, above_threshold

# Outputs whose signals are looked at together when the loudest one is searched.
_OUTPUTS_PER_PIECE = 6
#: A window holds no more energy than its record, but for the rounding of both.
_ROUNDING = 1.0 + 1e-9

#: Spectra, (n, n_axes, n_bins), of some outputs, from 0, and axes.
_Rows = Callable[[np.ndarray, tuple[int, ...]], Complexes]


@dataclass(frozen=True, slots=True, eq=False)
class StimulusResult:
    """What is measured of the response to a stimulus, in m/s².

    Attributes
    ----------
    rms : (n_outputs,)
        Of each output, of the whole record.
    windows
        RMS of the loudest 100 ms, and the largest sample, by number of the output: first of the
        loudest one, then of those asked for.
    level
        Where the plan asks for one: the highest RMS of any 100 ms at whatever output, or how far
        the loudest output is above threshold, as a ratio.
    extent
        How far it reaches, by the names in `skinsource.studies.sweeps.metrics.OF_EXTENT`.
    """

    rms: Floats
    windows: dict[int, tuple[float, float]]
    level: float | None
    extent: dict[str, float]

    @property
    def loudest(self) -> int:
        """The output whose RMS of the whole record is highest, from 1."""
        return next(iter(self.windows))


def outputs_of_interest(rms: Floats, plan: Plan) -> tuple[int, ...]:
    """Outputs whose signals are looked at, each once; the loudest first."""
    return _outputs_with(int(np.argmax(rms)), plan)


def _outputs_with(loudest: int, plan: Plan) -> tuple[int, ...]:
    return tuple(dict.fromkeys((loudest + 1, *plan.outputs)))


def windows_of(traces: Floats, rate_hz: float) -> list[tuple[float, float]]:
    """RMS of the loudest 100 ms and largest sample of signals, (n, n_times)."""
    n_window = window_samples(rate_hz)
    loudest = np.sqrt(loudest_energy(traces, n_window) / n_window)
    peaks = np.abs(traces).max(axis=-1, initial=0.0)
    return list(zip(loudest.tolist(), peaks.tolist(), strict=True))


def evaluate_stimulus(
    plan: Plan, field: Field, stimulus: PreparedStimulus, extents: Extents, stop: Stop
) -> StimulusResult:
    """What is seen of one stimulus."""
    limb, n_times = stimulus.limb, stimulus.response_samples
    axes = axis_numbers(plan.axes, limb.axes)
    projection = Projection(axes, directions_of(field.moments, axes, plan.method, n_times))
    spectrum = field.spectrum
    rms = record_rms(field.moments, projection, spectrum, stimulus.record_samples)
    outputs = outputs_of_interest(rms, plan)
    rows = np.array(outputs) - 1
    spectra = spectrum.rows(rows, projection.axis_numbers)
    signals = _signals(projection.at(rows), spectra, spectrum.n_fft)
    windows = windows_of(signals[..., :n_times], limb.sample_rate_hz)
    level = None
    if plan.level_db is not None:
        level = _level(plan, stimulus, spectrum.rows, projection, rms, spectrum.n_fft, stop)
    (extent,) = extents.of([rms], [stimulus])
    return StimulusResult(rms, dict(zip(outputs, windows, strict=True)), level, extent)


def evaluate_batch(
    plan: Plan,
    vibrations: Vibrations,
    stimuli: Sequence[PreparedStimulus | None],
    extents: Extents,
    stop: Stop,
) -> list[StimulusResult]:
    """What is seen of each of several stimuli; of one that cannot be, nothing that counts."""
    limb = next(stimulus.limb for stimulus in stimuli if stimulus is not None)
    # Of one that cannot be any length will do.
    n_times = [1 if stimulus is None else stimulus.response_samples for stimulus in stimuli]
    n_stimuli, n_outputs = len(stimuli), limb.n_outputs
    lengths = np.repeat(np.array(n_times, np.float64), n_outputs)
    projection, energy = _projected(plan, vibrations, limb, lengths)
    records = [1 if stimulus is None else stimulus.record_samples for stimulus in stimuli]
    over = np.repeat(np.array(records, np.float64), n_outputs)
    rms = np.sqrt(energy / over).reshape(n_stimuli, n_outputs)
    looked = [_outputs_with(loudest, plan) for loudest in np.argmax(rms, axis=1).tolist()]
    rows = np.repeat(np.arange(n_stimuli), [len(numbers) for numbers in looked])
    outputs = np.array([number - 1 for numbers in looked for number in numbers])
    spectra = vibrations.rows(rows, outputs, projection.axis_numbers)
    signals = _signals(projection.at(rows * n_outputs + outputs), spectra, vibrations.n_fft)
    windows = iter(windows_of(signals[..., : max(n_times)], limb.sample_rate_hz))
    reach = extents.of(list(rms), stimuli)
    results = []
    for which, (stimulus, numbers) in enumerate(zip(stimuli, looked, strict=True)):
        level = None
        if plan.level_db is not None and stimulus is not None:
            here = projection.at(slice(which * n_outputs, (which + 1) * n_outputs))
            rows_of_one = _rows_of(vibrations, which)
            level = _level(plan, stimulus, rows_of_one, here, rms[which], vibrations.n_fft, stop)
        of_outputs = {number: next(windows) for number in numbers}
        results.append(StimulusResult(rms[which], of_outputs, level, reach[which]))
    return results


def _signals(projection: Projection, spectra: Complexes, n_fft: int) -> Floats:
    """Projected signals, (n, n_fft), by the spectra of their axes, (n, n_axes, n_bins)."""
    if projection.directions is None:
        return projection.signals(inverse_here(spectra, n_fft))
    # One transform each, not one for each axis.
    return inverse_here(projection.spectra(spectra), n_fft)


def _projected(
    plan: Plan, vibrations: Vibrations, limb: Limb, lengths: Floats
) -> tuple[Projection, Floats]:
    """How the axes of each output become one signal, and its energy, (n_stimuli n_outputs,)."""
    axes, n_outputs = axis_numbers(plan.axes, limb.axes), limb.n_outputs
    if len(axes) == 3 and plan.method == "pca":
        directions: Floats | None = main_axes(
            covariance_of(vibrations.moments, axes, lengths[:, None, None])
        )
    else:
        directions = directions_of(vibrations.moments, axes, plan.method, lengths[:, None, None])
    projection = Projection(axes, directions)
    energy, cancelled = energies(vibrations.moments, directions, axes)
    which = np.flatnonzero(cancelled)
    if which.size:
        spectra = vibrations.rows(which // n_outputs, which % n_outputs, projection.axis_numbers)
        energy[which] = energies_of(projection.at(which).spectra(spectra), vibrations.n_fft)
    return projection, energy


def _rows_of(vibrations: Vibrations, which: int) -> _Rows:
    def rows(outputs: np.ndarray, axes: tuple[int, ...]) -> Complexes:
        return vibrations.rows(np.full(len(outputs), which), outputs, axes)

    return rows


def _level(
    plan: Plan,
    stimulus: PreparedStimulus,
    rows: _Rows,
    projection: Projection,
    rms: Floats,
    n_fft: int,
    stop: Stop,
) -> float:
    """What is brought to the level of the plan: a ratio, or m/s²."""
    limb, n_times = stimulus.limb, stimulus.response_samples
    if plan.level == "above_threshold":
        spectra = rows(np.arange(limb.n_outputs), tuple(range(limb.n_axes)))
        acceleration = inverse_here(spectra, n_fft)[..., :n_times]
        return above_threshold(acceleration, limb.sample_rate_hz, stimulus.design.scaling)
    energy = np.square(rms) * stimulus.record_samples
    return _loudest_window(rows, projection, energy, n_fft, limb, stop)


def _loudest_window(
    rows: _Rows,
    projection: Projection,
    energy: Floats,
    n_fft: int,
    limb: Limb,
    stop: Stop,
) -> float:
    """Highest RMS of any 100 ms at whatever output, m/s².

    Outputs are looked at in the order of their energies, (n_outputs,), until no window of the next
    one can hold as much as was found.
    """
    n_window = window_samples(limb.sample_rate_hz)
    order = np.argsort(-energy, kind="stable")
    highest = 0.0
    for first in range(0, len(order), _OUTPUTS_PER_PIECE):
        stop_if(stop)
        outputs = order[first : first + _OUTPUTS_PER_PIECE]
        if energy[outputs[0]] * _ROUNDING < highest:
            break
        spectra = rows(outputs, projection.axis_numbers)
        signals = _signals(projection.at(outputs), spectra, n_fft)
        highest = max(highest, float(loudest_energy(signals, n_window).max()))
    return float(np.sqrt(highest / n_window))


# Metrics of one stimulus after another.

#: What one number each says of a stimulus, in the order of the columns: without those of outputs.
METRICS = (
    "factor",
    "duration_s",
    "drive_peak",
    "drive_rms",
    "share_outside_band",
    "loudest_output",
    "rms",
    "rms_100ms",
    "peak",
    "level_100ms_db",
    "level_above_threshold_db",
    *OF_EXTENT,
)
_OF_OUTPUTS = ("rms", "rms_100ms", "peak")
Metrics = dict[str, float]


def columns_of(plan: Plan) -> tuple[str, ...]:
    """Names of the metrics of a plan."""
    return (
        *METRICS,
        *(f"output_{output}_{name}" for output in plan.outputs for name in _OF_OUTPUTS),
        *(ACTUATOR_METRICS if plan.drives_actuators else ()),
    )


class Measurer:
    """Measures stimuli of a plan; what neighbours have in common is computed once.

    One thread's.

    Parameters
    ----------
    plan
        What is measured.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        shared = Shared()
        self._graph = new_graph(shared)
        self._preparing = Preparing(shared)
        self._fields = Fields(plan.varying)
        self._together = Batch(self._preparing)
        # Of the neighbours that were asked for latest; None: each by itself.
        self._latest = range(0)
        self._prepared: dict[int, PreparedStimulus] = {}
        self._seen: dict[int, StimulusResult] | None = None
        # No input stands apart: which of them vary is another matter here.
        self._view = View(axes=plan.axes, method=plan.method, outputs=(), selected_inputs=())
        self._drives = DriveMetrics()
        self._extents = Extents()

    def measure(self, number: int, stop: Stop = never) -> Metrics:
        """Metrics of stimulus ``number``, by name.

        In m/s², m/s² of the drive under probe scaling, seconds, mm and shares from 0 to 1:

        - ``factor``: what all amplitudes were multiplied with to reach the plan's level;
        - ``duration_s``; ``drive_peak``, ``drive_rms``: largest and RMS of all channels;
        - ``share_outside_band``: of the energy of the drive, outside the band in which the limb was
          measured; NaN where that is not known;
        - ``loudest_output``: where the RMS of the whole record is highest; there ``rms``,
          ``rms_100ms`` (the loudest 100 ms) and ``peak``;
        - ``level_100ms_db``: the highest RMS of any 100 ms at whatever output, dB re 1 m/s²; only
          where the plan has that level;
        - ``level_above_threshold_db``: of the more sensitive channel at the output where it is
          highest, see `skinsource.perception.sensation_levels_db`; as well;
        - what `skinsource.extent` says of the RMS of the whole record;
        - ``output_N_rms``, ``output_N_rms_100ms``, ``output_N_peak`` of each output asked for;
        - where predictions go through actuators, `skinsource.studies.sweeps.metrics`.

        What cannot be said, of silence for instance, is NaN.

        Raises
        ------
        InvalidInputError
            The stimulus cannot be: a value does not fit, a place does not exist.
        DatasetMissingError
            Its limb is a measured one, and the measured dataset is not installed.
        """
        prepared, seen = self._looked_at(number, stop)
        factor = 1.0 if seen.level is None else _factor(self.plan.level_db, seen.level)
        loudest, rms = seen.loudest, seen.rms
        metrics = {
            "factor": factor,
            "duration_s": prepared.stimulus_samples / prepared.limb.sample_rate_hz,
            **self._drives.of(prepared, factor),
            "loudest_output": loudest if rms[loudest - 1] > 0.0 else np.nan,
            **_of_output("", rms[loudest - 1], seen.windows[loudest], factor),
            **_levels_db(self.plan.level, seen.level, factor),
            **seen.extent,
        }
        for output in self.plan.outputs:
            metrics |= _of_output(
                f"output_{output}_", rms[output - 1], seen.windows[output], factor
            )
        if self.plan.drives_actuators:
            metrics |= actuator_metrics(prepared, factor, self.plan.limits)
        return {name: float(value) for name, value in metrics.items()}

    def _looked_at(self, number: int, stop: Stop) -> tuple[PreparedStimulus, StimulusResult]:
        """A stimulus, and what the skin does."""
        if number not in self._latest:
            neighbours = self.plan.neighbours(number)
            self._latest, self._prepared, self._seen = range(0), {}, None
            self._seen = self._seen_together(neighbours, stop)
            self._latest = neighbours
        prepared = self._prepared.pop(number, None) or self._prepare(number, stop)
        seen = (self._seen or {}).get(number)
        return prepared, seen or self._seen_alone(prepared, stop)

    def _prepare(self, number: int, stop: Stop) -> PreparedStimulus:
        prepared = self._preparing.of(self.plan.design_of(number), stop)
        shown_outputs(self.plan.outputs, prepared.limb)
        return prepared

    def _seen_together(self, neighbours: range, stop: Stop) -> dict[int, StimulusResult] | None:
        """What the skin does by each of the neighbours; None where they have little in common."""
        stimuli: list[PreparedStimulus | None] = []
        for number in neighbours:
            try:
                stimulus = self._prepared[number] = self._prepare(number, stop)
            except Stopped:
                raise
            except (SkinSourceError, MemoryError):
                # It is said when it is that one's turn.
                stimuli.append(None)
                continue
            if stimulus.n_fft() is None:
                return None
            stimuli.append(stimulus)
        vibrations = self._together.of(stimuli, stop, products=self._products(stimuli))
        if vibrations is None:
            return None
        seen = evaluate_batch(self.plan, vibrations, stimuli, self._extents, stop)
        return dict(zip(neighbours, seen, strict=True))

    def _products(self, stimuli: Iterable[PreparedStimulus | None]) -> bool:
        """Whether products of different axes are needed of any."""
        plan = self.plan
        return any(
            needs_products(axis_numbers(plan.axes, stimulus.limb.axes), plan.method)
            for stimulus in stimuli
            if stimulus is not None
        )

    def _seen_alone(self, stimulus: PreparedStimulus, stop: Stop) -> StimulusResult:
        responses = self._preparing.responses(stimulus, stimulus.n_fft())
        field = self._fields.of(
            responses, stimulus.placed, stop, products=self._products([stimulus])
        )
        if field is None:
            return self._seen_in_blocks(stimulus, stop)
        return evaluate_stimulus(self.plan, field, stimulus, self._extents, stop)

    def _seen_in_blocks(self, stimulus: PreparedStimulus, stop: Stop) -> StimulusResult:
        """The same of a long design, by the rules that stream it."""
        design, plan = stimulus.design, self.plan
        rms = self._evaluate(design, self._view, "output_rms", stop)
        level = None
        if plan.level == "above_threshold":
            raise InvalidInputError(
                f"the response lasts {stimulus.response_samples / stimulus.limb.sample_rate_hz:.4g} s, which "
                "is too long to be brought to a level above threshold. Shorten the stimulus, or "
                "choose the level loudest_100ms."
            )
        if plan.level_db is not None:
            view = replace(self._view, span="loudest")
            level = float(self._evaluate(design, view, "output_rms", stop).max())
        outputs = outputs_of_interest(rms, plan)
        view = replace(self._view, outputs=outputs)
        traces = self._evaluate(design, view, "selected_traces", stop)
        windows = windows_of(traces, stimulus.limb.sample_rate_hz)
        (extent,) = self._extents.of([rms], [stimulus])
        return StimulusResult(rms, dict(zip(outputs, windows, strict=True)), level, extent)

    def _evaluate(self, design: Design, view: View, name: str, stop: Stop) -> Floats:
        value: Floats = self._graph.evaluate((name,), sources(design, view), stop)[name]
        return value


def _levels_db(kind: str | None, level: float | None, factor: float) -> Metrics:
    level_db = float(decibels(level * factor)) if level else np.nan
    return {
        "level_100ms_db": level_db if kind == "loudest_100ms" else np.nan,
        "level_above_threshold_db": level_db if kind == "above_threshold" else np.nan,
    }


def _factor(level_db: float | None, level: float) -> float:
    """What brings ``level`` to ``level_db``; 1 for silence."""
    return 10.0 ** ((level_db or 0.0) / 20.0) / level if level > 0.0 else 1.0


def _of_output(before: str, rms: float, window: tuple[float, float], factor: float) -> Metrics:
    return {
        f"{before}rms": factor * rms,
        f"{before}rms_100ms": factor * window[0],
        f"{before}peak": factor * window[1],
    }


# Measures stimuli in this process; one that cannot be measured does not end the sweep.


def metrics_or_reason(measurer: Measurer, number: int, stop: Stop = never) -> Metrics | str:
    """Metrics of a stimulus, or the sentence that says why it has none."""
    try:
        return measurer.measure(number, stop)
    except Stopped:
        raise
    except SkinSourceError as error:
        return sentence(str(error))
    except MemoryError:
        return "it needs more memory than there is."


def measured_here(
    plan: Plan, numbers: Iterable[int], stop: Stop = never
) -> Iterator[tuple[int, Metrics | str]]:
    """Give what is found of some stimuli of ``plan``, one after the other, by this thread."""
    measurer = Measurer(plan)
    for number in numbers:
        stop_if(stop)
        yield number, metrics_or_reason(measurer, number, stop)
