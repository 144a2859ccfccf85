"""Metrics of the stimuli of a sweep: their drives, actuators, main axes and extent.

Inputs that do not vary are drawn and measured once.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.catalog import names, profile
from skinsource.actuators.equalising import equalised, followed_band
from skinsource.actuators.prediction import Limits, Prediction, Thermal, breaches, predicted
from skinsource.actuators.rigs import strictest
from skinsource.base.arrays import Floats
from skinsource.base.job import Stop, stop_if
from skinsource.base.measurement_conditions import Band
from skinsource.design.design import Design, Input, audible_indices
from skinsource.design.signal_path import Drive, check_drive
from skinsource.engine.gains import EngineMemory, Placed, Responses
from skinsource.engine.quantities import voices
from skinsource.engine.shared import Shared
from skinsource.engine.transforms import length_at_once
from skinsource.export.tables import EXTENT_COLUMNS
from skinsource.limbs.extent import distances_mm, spread
from skinsource.limbs.limb import Limb
from skinsource.signals.spectra import share_outside_band
from skinsource.studies.sweeps.plan import Plan

#: Names of the metrics of a stimulus, in the order of the columns, without those of outputs.
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
    *EXTENT_COLUMNS,
)
#: Metrics of actuators, each of the channel where it is largest, in the order of the columns.
ACTUATOR_METRICS = (
    "peak_voltage_v",
    "rms_voltage_v",
    "peak_current_a",
    "rms_current_a",
    "peak_displacement_m",
    "peak_velocity_m_per_s",
    "linear_share",
    "limits_passed",
)
METRICS_OF_OUTPUTS = ("rms", "rms_100ms", "peak")
Metrics = dict[str, float]


def columns_of(plan: Plan) -> tuple[str, ...]:
    """Return the names of the metrics of a plan."""
    return (
        *METRICS,
        *(f"output_{output}_{name}" for output in plan.outputs for name in METRICS_OF_OUTPUTS),
        *(ACTUATOR_METRICS if plan.drives_actuators else ()),
    )


@dataclass(frozen=True, slots=True, eq=False)
class PreparedStimulus:
    """A stimulus with its limb and its drives.

    Attributes
    ----------
    placed
        Audible inputs with their drives, in their order.
    n_taps
        Samples of a response of the limb itself, without the ringing of actuators.
    stimulus_samples
        Samples from time 0 to the end of the last drive; 1 where nothing is audible.
    """

    design: Design
    limb: Limb
    placed: tuple[Placed, ...]
    n_taps: int
    stimulus_samples: int

    @property
    def response_samples(self) -> int:
        """Samples of the response: the stimulus and one response more."""
        return self.stimulus_samples + self.limb.n_taps - 1

    @property
    def record_samples(self) -> int:
        """Samples that levels are over: the stimulus and one response of the limb itself."""
        return self.stimulus_samples + self.n_taps - 1

    @property
    def moving(self) -> tuple[Placed, ...]:
        """Inputs that move the skin at all."""
        return tuple(placed for placed in self.placed if placed.moves)

    def n_fft(self, response_samples: int | None = None) -> int | None:
        """Length of transforms of its response, or of a longer one; None: it is too long."""
        places = {placed.voice.location for placed in self.placed}
        return length_at_once(
            response_samples or self.response_samples,
            len(places),
            self.limb.n_outputs * self.limb.n_axes,
        )


@dataclass(frozen=True, slots=True, eq=False)
class _DrawnTrack:
    """The drive of an input at a rate, and the actuators that can play it."""

    input: Input
    rate_hz: float
    band_hz: Band | None
    actuation: Actuation | None
    placed: Placed

    def holds_for(
        self, track: Input, rate_hz: float, band_hz: Band | None, actuation: Actuation | None
    ) -> bool:
        """Return whether it is the drive of ``track`` under these conditions."""
        conditions = self.rate_hz, self.band_hz, self.actuation
        return self.input is track and conditions == (rate_hz, band_hz, actuation)


class Preparing:
    """Prepares stimuli; caches what they have in common.

    Parameters
    ----------
    shared
        Limbs, and the caches of rendering.
    """

    def __init__(self, shared: Shared) -> None:
        self._shared = shared
        # This reference keeps the responses of the limb in memory.
        self._latest: Limb | None = None
        # Tracks of the latest design, by id: the next stimulus shares those that do not vary.
        self._drawn: dict[int, _DrawnTrack] = {}

    @property
    def _remembered(self) -> EngineMemory:
        return self._shared.remembered()

    def of(self, design: Design, stop: Stop) -> PreparedStimulus:
        """Draw the drives of the inputs of ``design``.

        Raises
        ------
        InvalidInputError
            A sample is no usable number, or a waveform does not fit the limb's rate.
        DatasetMissingError
            The limb is a measured one, and the dataset is not installed.
        """
        limb = self._shared.limb_of(design.limb, design.limb_digest)
        rate_hz, band_hz, n_taps = limb.sample_rate_hz, limb.band_hz, limb.n_taps
        limb = self._latest = self._shared.driven_limb(limb, design.actuated, design.scaling)
        drawn = {}
        for index in audible_indices(design.inputs):
            track = design.inputs[index]
            before = self._drawn.get(track.id)
            if before is None or not before.holds_for(track, rate_hz, band_hz, design.actuated):
                stop_if(stop)
                placed = self._placed(track, rate_hz, band_hz, design.actuated)
                before = _DrawnTrack(track, rate_hz, band_hz, design.actuated, placed)
            drawn[track.id] = before
        self._drawn = drawn
        inputs = tuple(each.placed for each in drawn.values())
        end = max([1, *(each.end for each in inputs)])
        return PreparedStimulus(design, limb, inputs, n_taps, end)

    def _placed(
        self, track: Input, rate_hz: float, band_hz: Band | None, actuation: Actuation | None
    ) -> Placed:
        """Return an audible input with its drive."""
        (voice,) = voices(self._remembered, (track,), rate_hz)
        drive = self._remembered.drives.drawn(voice.unit, rate_hz)
        check_drive(actuation, drive, rate_hz, band_hz, voice.location)
        return Placed(voice, drive, voice.start)

    def responses(self, stimulus: PreparedStimulus, n_fft: int | None) -> Responses:
        """Return the responses of its limb at the length ``n_fft``."""
        return Responses(self._remembered, stimulus.limb, stimulus.design.scaling, n_fft)


# Convergence is quadratic: four sweeps reach rounding, whatever the matrix; most need two.
_SWEEPS = 5
#: A smaller tangent does not change an axis.
_LEAST_TANGENT = 2.0**-54
_PAIRS = ((0, 1, 2), (0, 2, 1), (1, 2, 0))


def main_axes(covariance: Floats) -> Floats:
    """Return unit vectors along the largest eigenvalue of symmetric matrices, (n, 3), of (n, 3, 3).

    They have either sign, and lie along the first axis where a matrix is zero.  A library for
    linear algebra takes one small matrix after the other, and longer for each call than for the
    matrix.  Here Jacobi's rotations are applied to all matrices at once (Golub and Van Loan,
    "Matrix Computations", 4th ed., 8.5), which is as exact.
    """
    # Scaled by powers of two, nothing over- or underflows, and nothing rounds.
    exponent = np.frexp(np.abs(covariance).max(axis=(1, 2)))[1]
    scaled = np.ldexp(covariance, -exponent[:, None, None])
    rows = [[scaled[:, a, b].copy() for b in range(3)] for a in range(3)]
    vectors = [np.repeat(unit[:, None], len(scaled), axis=1) for unit in np.eye(3)]
    for _ in range(_SWEEPS):
        for p, q, r in _PAIRS:
            _rotate(rows, vectors, p, q, r)
        if _are_diagonal(rows):
            break
    values = np.stack([rows[0][0], rows[1][1], rows[2][2]])
    axes: Floats = np.choose(values.argmax(axis=0), vectors).T
    return axes


def _are_diagonal(rows: list[list[Floats]]) -> bool:
    """Return whether the elements beside the diagonals are too small to turn an axis."""
    return all(
        bool(np.all(np.abs(rows[p][q]) <= _LEAST_TANGENT * np.abs(rows[q][q] - rows[p][p])))
        for p, q, _ in _PAIRS
    )


def _rotate(rows: list[list[Floats]], vectors: list[Floats], p: int, q: int, r: int) -> None:
    """Turn axes ``p`` and ``q`` so that the element between them is 0.

    Parameters
    ----------
    rows
        Elements of the matrices, (n,) each; turned in place, as the axes are, (3, n) each.
    """
    between, difference = rows[p][q], rows[q][q] - rows[p][p]
    # tan of the angle, the smaller of the two, in a form that divides by nothing small.
    twice = 2.0 * between
    # Numbers are at most 1: where a square underflows, the other one is much larger.
    longest = np.abs(difference) + np.sqrt(difference * difference + twice * twice)
    tangent = twice * np.copysign(1.0, difference) / (longest + (longest == 0.0))
    cosine = 1.0 / np.sqrt(1.0 + tangent * tangent)
    sine = tangent * cosine
    rows[p][p] = rows[p][p] - tangent * between
    rows[q][q] = rows[q][q] + tangent * between
    rows[p][q] = rows[q][p] = np.zeros_like(between)
    first, second = rows[p][r], rows[q][r]
    rows[p][r] = rows[r][p] = cosine * first - sine * second
    rows[q][r] = rows[r][q] = sine * first + cosine * second
    first, second = vectors[p], vectors[q]
    vectors[p], vectors[q] = cosine * first - sine * second, sine * first + cosine * second


# An equaliser rings before and after the drive, and the actuator has to play that too.
_RINGS_S = 0.1


def actuator_metrics(stimulus: PreparedStimulus, factor: float, limits: Limits) -> dict[str, float]:
    """Return metrics of the voltages at the actuators that a design is predicted through.

    ``limits_passed`` counts the limits that any channel passes, of ``limits`` and those that the
    library knows of the actuator; NaN where there are none.  All are NaN where the design is not
    predicted through actuators.

    Parameters
    ----------
    factor
        Factor of all amplitudes.

    Raises
    ------
    InvalidInputError
        A place has no actuator, or drives at one place leave a velocity, so that nothing can follow
        them.
    """
    actuation = stimulus.design.actuated
    if actuation is None:
        return dict.fromkeys(ACTUATOR_METRICS, np.nan)
    metrics = dict.fromkeys(ACTUATOR_METRICS, 0.0)
    passed: set[str] = set()
    known = False
    for place, drive in _drives_of(stimulus, factor).items():
        at = actuation.at(place)
        own, thermal = _limits_of(at)
        allowed = strictest(limits, own)
        known = known or allowed != Limits()
        demand = _actuator_demand(drive, stimulus.limb, at, actuation, thermal)
        passed |= {breach.name for breach in breaches(demand, allowed)}
        for name in ACTUATOR_METRICS[:-1]:
            metrics[name] = float(np.maximum(metrics[name], getattr(demand, name)))
    metrics["limits_passed"] = float(len(passed)) if known else np.nan
    return metrics


def _actuator_demand(
    drive: Floats, limb: Limb, at: ActuatorAt, actuation: Actuation, thermal: Thermal | None
) -> Prediction:
    voltage, rate_hz = drive, limb.sample_rate_hz
    if actuation.equaliser is not None:
        voltage = equalised(
            drive,
            rate_hz,
            at.model,
            actuation.equaliser,
            band_hz=followed_band(limb.band_hz, rate_hz),
            lead_s=_RINGS_S,
            tail_s=_RINGS_S,
        )
    (demand,) = predicted(voltage, round(rate_hz), at.model, thermal=thermal)
    return demand


def _limits_of(at: ActuatorAt) -> tuple[Limits, Thermal | None]:
    """Return the limits and the thermal model of an actuator in the catalog."""
    if at.actuator not in names():
        return Limits(), None
    known = profile(at.actuator)
    return known.limits, known.thermal


def _drives_of(stimulus: PreparedStimulus, factor: float) -> dict[int, Floats]:
    """Return the drive of each place where anything moves, (n_times,), m/s² or V."""
    n_times = stimulus.stimulus_samples
    channels: dict[int, Floats] = {}
    for each in stimulus.moving:
        drive = channels.setdefault(each.voice.location, np.zeros(n_times))
        weight = each.voice.amplitude * each.drive.factor * factor
        drive[each.start : each.end] += weight * each.drive.samples
    return channels


@dataclass(frozen=True, slots=True, eq=False)
class _MeasuredDrive:
    """The largest sample of a drive, its energy, and the share of energy outside the band."""

    drive: Drive
    peak: float
    energy: float
    outside: float


class DriveMetrics:
    """Measures drives; those of inputs that do not vary once."""

    def __init__(self) -> None:
        self._cached: dict[int, _MeasuredDrive] = {}

    def of(self, stimulus: PreparedStimulus, factor: float) -> dict[str, float]:
        """Return peak and RMS of all channels, and the share of energy outside the band.

        Parameters
        ----------
        factor
            Factor of all amplitudes.
        """
        rate_hz, n_times = stimulus.limb.sample_rate_hz, stimulus.stimulus_samples
        channels: dict[int, list[tuple[float, Placed, _MeasuredDrive]]] = {}
        energy = outside = 0.0
        for each in stimulus.placed:
            weight = each.voice.amplitude * each.drive.factor * factor
            measured = self._of_drive(each, rate_hz, stimulus.limb.band_hz)
            channels.setdefault(each.voice.location, []).append((weight, each, measured))
            energy += weight**2 * measured.energy
            outside += weight**2 * measured.energy * measured.outside
        peak = squares = 0.0
        for inputs in channels.values():
            if len(inputs) == 1:
                weight, _, measured = inputs[0]
                peak = max(peak, abs(weight) * measured.peak)
                squares += weight**2 * measured.energy
            else:
                total = _sum(inputs, n_times)
                peak = max(peak, float(np.abs(total).max()))
                squares += float(np.vecdot(total, total))
        return {
            "drive_peak": peak,
            "drive_rms": float(np.sqrt(squares / (n_times * max(len(channels), 1)))),
            "share_outside_band": outside / energy if energy > 0.0 else np.nan,
        }

    def _of_drive(self, placed: Placed, rate_hz: float, band_hz: Band | None) -> _MeasuredDrive:
        measured = self._cached.get(placed.voice.id)
        if measured is None or measured.drive is not placed.drive:
            samples = placed.drive.samples
            measured = self._cached[placed.voice.id] = _MeasuredDrive(
                placed.drive,
                float(np.abs(samples).max(initial=0.0)),
                float(np.vecdot(samples, samples)),
                share_outside_band(samples, rate_hz, band_hz) if band_hz else np.nan,
            )
        return measured


def _sum(inputs: list[tuple[float, Placed, _MeasuredDrive]], n_times: int) -> Floats:
    """Return the sum of the drives at one place, (n_times,)."""
    total = np.zeros(n_times)
    for weight, placed, _ in inputs:
        total[placed.start : placed.end] += weight * placed.drive.samples
    return total


# Sets of places whose distances are cached.
_MOST = 1000
_Key = tuple[str, tuple[int, ...]]


class Extents:
    """Computes how far vibrations reach; caches the distances of outputs."""

    def __init__(self) -> None:
        self._distances: dict[_Key, Floats] = {}

    def of(
        self, rms: Sequence[Floats], stimuli: Sequence[PreparedStimulus | None]
    ) -> list[dict[str, float]]:
        """Return the metrics of `skinsource.extent` of each stimulus; NaN where there is none.

        Parameters
        ----------
        rms : (n_outputs,) each
            RMS of the outputs.
        """
        extents = [dict.fromkeys(EXTENT_COLUMNS, np.nan) for _ in stimuli]
        by_places: dict[_Key, list[int]] = {}
        for which, stimulus in enumerate(stimuli):
            if stimulus is None:
                continue
            key = (
                stimulus.limb.name,
                tuple(dict.fromkeys(each.voice.location for each in stimulus.moving)),
            )
            distance_mm = self._distances_mm(stimulus.limb, key)
            if rms[which][np.isfinite(distance_mm)].any():
                by_places.setdefault(key, []).append(which)
        for key, numbers in by_places.items():
            metrics = spread(np.array([rms[which] for which in numbers]), self._distances[key])
            for row, which in enumerate(numbers):
                extents[which] = {name: float(metrics[name][row]) for name in EXTENT_COLUMNS}
        return extents

    def _distances_mm(self, limb: Limb, key: _Key) -> Floats:
        """Return the distance of each output from the nearest place, mm; NaN: nothing plays."""
        if key not in self._distances:
            if len(self._distances) >= _MOST:
                self._distances.clear()
            places = key[1]
            self._distances[key] = (
                distances_mm(limb, places) if places else np.full(limb.n_outputs, np.nan)
            )
        return self._distances[key]
