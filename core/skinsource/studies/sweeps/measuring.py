"""Measurement of stimuli: the metrics of one stimulus after another.

Stimuli of a batch are computed together where they have inputs in common; otherwise each is
computed by itself, and long ones in blocks.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skinsource.base.arrays import Complexes, Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped
from skinsource.base.job import Stop, never, stop_if
from skinsource.base.measurement_conditions import axis_numbers
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
    DriveMetrics,
    Extents,
    Metrics,
    PreparedStimulus,
    Preparing,
    actuator_metrics,
    main_axes,
)
from skinsource.studies.sweeps.neighbours import Batch, Field, Fields, Vibrations
from skinsource.studies.sweeps.plan import Plan, above_threshold

# Outputs whose signals are computed together in the search for the loudest one.
_OUTPUTS_PER_PIECE = 6
#: A window holds no more energy than its record, but for the rounding of both.
_ROUNDING = 1.0 + 1e-9

#: Spectra, (n, n_axes, n_bins), of some outputs, from 0, and axes.
_Rows = Callable[[np.ndarray, tuple[int, ...]], Complexes]


@dataclass(frozen=True, slots=True, eq=False)
class StimulusResult:
    """Results of the response to a stimulus, in m/s².

    Attributes
    ----------
    rms : (n_outputs,)
        RMS of each output over the whole record.
    windows
        RMS of the loudest 100 ms, and the largest sample, by number of the output: first of the
        loudest one, then of the selected ones.
    level
        Level for the plan: the highest RMS of any 100 ms at any output, or the ratio of the
        loudest output to threshold.  None: the plan has no level.
    extent
        How far it reaches, by the names in `skinsource.export.tables.EXTENT_COLUMNS`.
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
    """Return the outputs whose signals are measured, each once; the loudest first."""
    return tuple(dict.fromkeys((int(np.argmax(rms)) + 1, *plan.outputs)))


def windows_of(traces: Floats, rate_hz: float) -> list[tuple[float, float]]:
    """Return the RMS of the loudest 100 ms and the largest sample of signals, (n, n_times)."""
    n_window = window_samples(rate_hz)
    loudest = np.sqrt(loudest_energy(traces, n_window) / n_window)
    peaks = np.abs(traces).max(axis=-1, initial=0.0)
    return list(zip(loudest.tolist(), peaks.tolist(), strict=True))


def evaluate_stimulus(
    plan: Plan, field: Field, stimulus: PreparedStimulus, extents: Extents, stop: Stop
) -> StimulusResult:
    """Return the results of one stimulus."""
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
    """Return the results of several stimuli; those of an invalid one mean nothing."""
    limb = next(stimulus.limb for stimulus in stimuli if stimulus is not None)
    # An invalid stimulus has any length.
    n_times = [1 if stimulus is None else stimulus.response_samples for stimulus in stimuli]
    n_stimuli, n_outputs = len(stimuli), limb.n_outputs
    lengths = np.repeat(np.array(n_times, np.float64), n_outputs)
    projection, energy = _projected(plan, vibrations, limb, lengths)
    records = [1 if stimulus is None else stimulus.record_samples for stimulus in stimuli]
    over = np.repeat(np.array(records, np.float64), n_outputs)
    rms = np.sqrt(energy / over).reshape(n_stimuli, n_outputs)
    selected = [outputs_of_interest(of_stimulus, plan) for of_stimulus in rms]
    rows = np.repeat(np.arange(n_stimuli), [len(numbers) for numbers in selected])
    outputs = np.array([number - 1 for numbers in selected for number in numbers])
    spectra = vibrations.rows(rows, outputs, projection.axis_numbers)
    signals = _signals(projection.at(rows * n_outputs + outputs), spectra, vibrations.n_fft)
    windows = iter(windows_of(signals[..., : max(n_times)], limb.sample_rate_hz))
    reach = extents.of(list(rms), stimuli)
    results = []
    for which, (stimulus, numbers) in enumerate(zip(stimuli, selected, strict=True)):
        level = None
        if plan.level_db is not None and stimulus is not None:
            here = projection.at(slice(which * n_outputs, (which + 1) * n_outputs))
            rows_of_one = _rows_of(vibrations, which)
            level = _level(plan, stimulus, rows_of_one, here, rms[which], vibrations.n_fft, stop)
        of_outputs = {number: next(windows) for number in numbers}
        results.append(StimulusResult(rms[which], of_outputs, level, reach[which]))
    return results


def _signals(projection: Projection, spectra: Complexes, n_fft: int) -> Floats:
    """Return projected signals, (n, n_fft), from spectra of axes, (n, n_axes, n_bins)."""
    if projection.directions is None:
        return projection.signals(inverse_here(spectra, n_fft))
    # One transform each, not one for each axis.
    return inverse_here(projection.spectra(spectra), n_fft)


def _projected(
    plan: Plan, vibrations: Vibrations, limb: Limb, lengths: Floats
) -> tuple[Projection, Floats]:
    """Return the projection of the axes of each output, and its energy, (n_stimuli n_outputs,)."""
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
    """Return the number that is brought to the level of the plan: a ratio, or m/s²."""
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
    """Return the highest RMS of any 100 ms at any output, m/s².

    Outputs are searched in the order of their energies, (n_outputs,), until no window of the next
    one can have more energy than the highest so far.
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


class Measurer:
    """Measures stimuli of a plan, for one thread; caches what those of a batch have in common.

    Parameters
    ----------
    plan
        The stimuli, and what is measured.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        shared = Shared()
        self._graph = new_graph(shared)
        self._preparing = Preparing(shared)
        self._fields = Fields(plan.varying)
        self._batch = Batch(self._preparing)
        # Numbers and results of the latest batch; None: each stimulus is computed by itself.
        self._latest = range(0)
        self._prepared: dict[int, PreparedStimulus] = {}
        self._results: dict[int, StimulusResult] | None = None
        # No input is selected: `Fields` caches those that do not vary.
        self._view = View(axes=plan.axes, method=plan.method, outputs=(), selected_inputs=())
        self._drives = DriveMetrics()
        self._extents = Extents()

    def measure(self, number: int, stop: Stop = never) -> Metrics:
        """Return the metrics of stimulus ``number``, by name.

        They are in m/s², m/s² of the drive under probe scaling, seconds, mm and shares from 0 to 1:

        - ``factor``: the factor of all amplitudes that reaches the plan's level;
        - ``duration_s``; ``drive_peak``, ``drive_rms``: largest and RMS of all channels;
        - ``share_outside_band``: of the energy of the drive, outside the band in which the limb was
          measured; NaN where that is not known;
        - ``loudest_output``: where the RMS of the whole record is highest; there ``rms``,
          ``rms_100ms`` (the loudest 100 ms) and ``peak``;
        - ``level_100ms_db``: the highest RMS of any 100 ms at any output, dB re 1 m/s²; only where
          the plan has that level;
        - ``level_above_threshold_db``: level of the more sensitive channel at the output where it
          is highest, see `skinsource.perception.sensation_levels_db`; only where the plan has it;
        - the metrics of `skinsource.extent` for the RMS of the whole record;
        - ``output_N_rms``, ``output_N_rms_100ms``, ``output_N_peak`` of each selected output;
        - where predictions go through actuators, `skinsource.studies.sweeps.metrics`.

        Unknown numbers, such as those of silence, are NaN.

        Raises
        ------
        InvalidInputError
            The stimulus is not possible: a value does not fit, a place does not exist.
        DatasetMissingError
            Its limb is a measured one, and the measured dataset is not installed.
        """
        prepared, result = self._evaluated(number, stop)
        factor = 1.0 if result.level is None else _factor(self.plan.level_db, result.level)
        loudest, rms = result.loudest, result.rms
        metrics = {
            "factor": factor,
            "duration_s": prepared.stimulus_samples / prepared.limb.sample_rate_hz,
            **self._drives.of(prepared, factor),
            "loudest_output": loudest if rms[loudest - 1] > 0.0 else np.nan,
            **_of_output("", rms[loudest - 1], result.windows[loudest], factor),
            **_levels_db(self.plan.level, result.level, factor),
            **result.extent,
        }
        for output in self.plan.outputs:
            metrics |= _of_output(
                f"output_{output}_", rms[output - 1], result.windows[output], factor
            )
        if self.plan.drives_actuators:
            metrics |= actuator_metrics(prepared, factor, self.plan.limits)
        return {name: float(value) for name, value in metrics.items()}

    def _evaluated(self, number: int, stop: Stop) -> tuple[PreparedStimulus, StimulusResult]:
        """Return a stimulus and its results."""
        if number not in self._latest:
            batch = self.plan.neighbours(number)
            self._latest, self._prepared, self._results = range(0), {}, None
            self._results = self._batch_results(batch, stop)
            self._latest = batch
        prepared = self._prepared.pop(number, None) or self._prepare(number, stop)
        result = (self._results or {}).get(number)
        return prepared, result or self._single_result(prepared, stop)

    def _prepare(self, number: int, stop: Stop) -> PreparedStimulus:
        prepared = self._preparing.of(self.plan.design_of(number), stop)
        shown_outputs(self.plan.outputs, prepared.limb)
        return prepared

    def _batch_results(self, batch: range, stop: Stop) -> dict[int, StimulusResult] | None:
        """Return the results of a batch by number; None: its stimuli have little in common."""
        stimuli: list[PreparedStimulus | None] = []
        for number in batch:
            try:
                stimulus = self._prepared[number] = self._prepare(number, stop)
            except Stopped:
                raise
            except (SkinSourceError, MemoryError):
                # It is raised again in the turn of that stimulus.
                stimuli.append(None)
                continue
            if stimulus.n_fft() is None:
                return None
            stimuli.append(stimulus)
        vibrations = self._batch.of(stimuli, stop, products=self._products(stimuli))
        if vibrations is None:
            return None
        results = evaluate_batch(self.plan, vibrations, stimuli, self._extents, stop)
        return dict(zip(batch, results, strict=True))

    def _products(self, stimuli: Iterable[PreparedStimulus | None]) -> bool:
        """Return whether any stimulus needs products of different axes."""
        plan = self.plan
        return any(
            needs_products(axis_numbers(plan.axes, stimulus.limb.axes), plan.method)
            for stimulus in stimuli
            if stimulus is not None
        )

    def _single_result(self, stimulus: PreparedStimulus, stop: Stop) -> StimulusResult:
        responses = self._preparing.responses(stimulus, stimulus.n_fft())
        field = self._fields.of(
            responses, stimulus.placed, stop, products=self._products([stimulus])
        )
        if field is None:
            return self._streamed_result(stimulus, stop)
        return evaluate_stimulus(self.plan, field, stimulus, self._extents, stop)

    def _streamed_result(self, stimulus: PreparedStimulus, stop: Stop) -> StimulusResult:
        """Return the results of a long design, by the rules that stream it."""
        design, plan = stimulus.design, self.plan
        rms = self._evaluate(design, self._view, "output_rms", stop)
        level = None
        if plan.level == "above_threshold":
            duration_s = stimulus.response_samples / stimulus.limb.sample_rate_hz
            raise InvalidInputError(
                f"the response lasts {duration_s:.4g} s, which is too long to be brought to a "
                "level above threshold. Shorten the stimulus, or choose the level loudest_100ms."
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
    """Return the factor that brings ``level`` to ``level_db``; 1 for silence."""
    return 10.0 ** ((level_db or 0.0) / 20.0) / level if level > 0.0 else 1.0


def _of_output(before: str, rms: float, window: tuple[float, float], factor: float) -> Metrics:
    return {
        f"{before}rms": factor * rms,
        f"{before}rms_100ms": factor * window[0],
        f"{before}peak": factor * window[1],
    }


def metrics_or_reason(measurer: Measurer, number: int, stop: Stop = never) -> Metrics | str:
    """Return the metrics of a stimulus, or the reason why it has none."""
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
    """Yield the metrics, or errors, of some stimuli of ``plan``, in this thread."""
    measurer = Measurer(plan)
    for number in numbers:
        stop_if(stop)
        yield number, metrics_or_reason(measurer, number, stop)
