"""What the skin does by a stimulus, of one alone or of several together."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.job import Stop, stop_if
from skinsource.limb import Limb, axis_numbers
from skinsource.loudest_window import loudest_energy, window_samples
from skinsource.rendering.level_rules import record_rms
from skinsource.rendering.moments import covariance_of, directions_of, energies, energies_of
from skinsource.rendering.projecting import Projection
from skinsource.rendering.transforms import inverse_here
from skinsource.sweeps.extents import Extents
from skinsource.sweeps.field import Field
from skinsource.sweeps.levels import above_threshold
from skinsource.sweeps.main_axes import main_axes
from skinsource.sweeps.neighbours import Vibrations
from skinsource.sweeps.plan import Plan
from skinsource.sweeps.prepared import Prepared

# Outputs whose signals are looked at together when the loudest one is searched.
_AT_ONCE = 6
#: A window holds no more energy than its record, but for the rounding of both.
_ROUNDING = 1.0 + 1e-9

#: Spectra, (n, n_axes, n_bins), of some outputs, from 0, and axes.
_Rows = Callable[[np.ndarray, tuple[int, ...]], Complexes]


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
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
        How far it reaches, by the names in `skinsource.sweeps.extents.OF_EXTENT`.
    """

    rms: Floats
    windows: dict[int, tuple[float, float]]
    level: float | None
    extent: dict[str, float]

    @property
    def loudest(self) -> int:
        """The output whose RMS of the whole record is highest, from 1."""
        return next(iter(self.windows))


def looked_at(rms: Floats, plan: Plan) -> tuple[int, ...]:
    """Outputs whose signals are looked at, each once; the loudest first."""
    return _looked_at(int(np.argmax(rms)), plan)


def _looked_at(loudest: int, plan: Plan) -> tuple[int, ...]:
    return tuple(dict.fromkeys((loudest + 1, *plan.outputs)))


def windows_of(traces: Floats, rate_hz: float) -> list[tuple[float, float]]:
    """RMS of the loudest 100 ms and largest sample of signals, (n, n_times)."""
    n_window = window_samples(rate_hz)
    loudest = np.sqrt(loudest_energy(traces, n_window) / n_window)
    peaks = np.abs(traces).max(axis=-1, initial=0.0)
    return list(zip(loudest.tolist(), peaks.tolist(), strict=True))


def seen_alone(plan: Plan, field: Field, one: Prepared, extents: Extents, stop: Stop) -> Seen:
    """What is seen of one stimulus."""
    limb, n_times = one.limb, one.response_samples
    axes = axis_numbers(plan.axes, limb.axes)
    projection = Projection(axes, directions_of(field.moments, axes, plan.method, n_times))
    spectrum = field.spectrum
    rms = record_rms(field.moments, projection, spectrum, one.record_samples)
    outputs = looked_at(rms, plan)
    rows = np.array(outputs) - 1
    spectra = spectrum.rows(rows, projection.axis_numbers)
    signals = _signals(projection.at(rows), spectra, spectrum.n_fft)
    windows = windows_of(signals[..., :n_times], limb.sample_rate_hz)
    level = None
    if plan.level_db is not None:
        level = _level(plan, one, spectrum.rows, projection, rms, spectrum.n_fft, stop)
    (extent,) = extents.of([rms], [one])
    return Seen(rms, dict(zip(outputs, windows, strict=True)), level, extent)


def seen_together(
    plan: Plan,
    vibrations: Vibrations,
    stimuli: Sequence[Prepared | None],
    extents: Extents,
    stop: Stop,
) -> list[Seen]:
    """What is seen of each of several stimuli; of one that cannot be, nothing that counts."""
    limb = next(one.limb for one in stimuli if one is not None)
    # Of one that cannot be any length will do.
    n_times = [1 if one is None else one.response_samples for one in stimuli]
    n_stimuli, n_outputs = len(stimuli), limb.n_outputs
    lengths = np.repeat(np.array(n_times, np.float64), n_outputs)
    projection, energy = _projected(plan, vibrations, limb, lengths)
    records = [1 if one is None else one.record_samples for one in stimuli]
    over = np.repeat(np.array(records, np.float64), n_outputs)
    rms = np.sqrt(energy / over).reshape(n_stimuli, n_outputs)
    looked = [_looked_at(loudest, plan) for loudest in np.argmax(rms, axis=1).tolist()]
    rows = np.repeat(np.arange(n_stimuli), [len(one) for one in looked])
    outputs = np.array([number - 1 for one in looked for number in one])
    spectra = vibrations.rows(rows, outputs, projection.axis_numbers)
    signals = _signals(projection.at(rows * n_outputs + outputs), spectra, vibrations.n_fft)
    windows = iter(windows_of(signals[..., : max(n_times)], limb.sample_rate_hz))
    reach = extents.of(list(rms), stimuli)
    found = []
    for which, (one, numbers) in enumerate(zip(stimuli, looked, strict=True)):
        level = None
        if plan.level_db is not None and one is not None:
            here = projection.at(slice(which * n_outputs, (which + 1) * n_outputs))
            rows_of_one = _rows_of(vibrations, which)
            level = _level(plan, one, rows_of_one, here, rms[which], vibrations.n_fft, stop)
        of_outputs = {number: next(windows) for number in numbers}
        found.append(Seen(rms[which], of_outputs, level, reach[which]))
    return found


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
    one: Prepared,
    rows: _Rows,
    projection: Projection,
    rms: Floats,
    n_fft: int,
    stop: Stop,
) -> float:
    """What is brought to the level of the plan: a ratio, or m/s²."""
    limb, n_times = one.limb, one.response_samples
    if plan.level == "above_threshold":
        spectra = rows(np.arange(limb.n_outputs), tuple(range(limb.n_axes)))
        acceleration = inverse_here(spectra, n_fft)[..., :n_times]
        return above_threshold(acceleration, limb.sample_rate_hz, one.design.scaling)
    energy = np.square(rms) * one.record_samples
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
    for first in range(0, len(order), _AT_ONCE):
        stop_if(stop)
        outputs = order[first : first + _AT_ONCE]
        if energy[outputs[0]] * _ROUNDING < highest:
            break
        spectra = rows(outputs, projection.axis_numbers)
        signals = _signals(projection.at(outputs), spectra, n_fft)
        highest = max(highest, float(loudest_energy(signals, n_window).max()))
    return float(np.sqrt(highest / n_window))
