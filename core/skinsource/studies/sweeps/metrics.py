"""What a stimulus plays, before anything moves."""

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
from skinsource.base.published import Band
from skinsource.design.design import Design, Input, audible_indices
from skinsource.design.signal_path import Drive, check_drive
from skinsource.engine.gains import Placed, Remembered, Responses
from skinsource.engine.quantities import voices
from skinsource.engine.shared import Shared
from skinsource.engine.transforms import length_at_once
from skinsource.limbs.extent import distances_mm, spread
from skinsource.limbs.limb import Limb
from skinsource.signals.spectra import share_outside_band


@dataclass(frozen=True, slots=True, eq=False)
class PreparedStimulus:
    """A stimulus with its limb and its drives.

    Attributes
    ----------
    design
        Of which it is.
    limb
        What it moves.
    placed
        Inputs that are heard, with what they play, in their order.
    n_taps
        Samples of a response of the limb itself, without what actuators ring.
    stimulus_samples
        Samples from time 0 to the end of the last drive; 1 where nothing is heard.
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
        """Length of transforms of its response, or of a longer one; None: too long at once."""
        places = {placed.voice.location for placed in self.placed}
        return length_at_once(
            response_samples or self.response_samples,
            len(places),
            self.limb.n_outputs * self.limb.n_axes,
        )


@dataclass(frozen=True, slots=True, eq=False)
class _DrawnTrack:
    """What an input plays at a rate, and through which actuators it was found to be possible."""

    input: Input
    rate_hz: float
    band_hz: Band | None
    actuation: Actuation | None
    placed: Placed

    def holds_for(
        self, track: Input, rate_hz: float, band_hz: Band | None, actuation: Actuation | None
    ) -> bool:
        """Whether it is what ``one`` plays."""
        followed = self.rate_hz, self.band_hz, self.actuation
        return self.input is track and followed == (rate_hz, band_hz, actuation)


class Preparing:
    """Prepares stimuli; remembers what they have in common.

    Parameters
    ----------
    shared
        Limbs, and what rendering remembers.
    """

    def __init__(self, shared: Shared) -> None:
        self._shared = shared
        # Nobody else keeps the responses that were read of it.
        self._latest: Limb | None = None
        # Of the latest design, by id: neighbours share the inputs that do not vary.
        self._known: dict[int, _DrawnTrack] = {}

    @property
    def _remembered(self) -> Remembered:
        return self._shared.remembered()

    def of(self, design: Design, stop: Stop) -> PreparedStimulus:
        """Draw what the inputs of ``design`` play.

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
        known = {}
        for index in audible_indices(design.inputs):
            track = design.inputs[index]
            before = self._known.get(track.id)
            if before is None or not before.holds_for(track, rate_hz, band_hz, design.actuated):
                stop_if(stop)
                placed = self._placed(track, rate_hz, band_hz, design.actuated)
                before = _DrawnTrack(track, rate_hz, band_hz, design.actuated, placed)
            known[track.id] = before
        self._known = known
        found = tuple(drawn.placed for drawn in known.values())
        end = max([1, *(each.end for each in found)])
        return PreparedStimulus(design, limb, found, n_taps, end)

    def _placed(
        self, track: Input, rate_hz: float, band_hz: Band | None, actuation: Actuation | None
    ) -> Placed:
        """An input that is heard, with what it plays."""
        (voice,) = voices(self._remembered, (track,), rate_hz)
        drive = self._remembered.drives.drawn(voice.unit, rate_hz)
        check_drive(actuation, drive, rate_hz, band_hz, voice.location)
        return Placed(voice, drive, voice.start)

    def responses(self, stimulus: PreparedStimulus, n_fft: int | None) -> Responses:
        """Responses of its limb at the length ``n_fft``."""
        return Responses(self._remembered, stimulus.limb, stimulus.design.scaling, n_fft)


# Main axes of many outputs at once.
#
# A library for linear algebra takes one small matrix after the other, and longer for the way to
# each than for the matrix itself.  Jacobi's rotations are done here with all of them side by side
# (Golub and Van Loan, "Matrix Computations", 4th ed., 8.5), which is as exact.

# Convergence is quadratic: four sweeps reach rounding, whatever the matrix; most need two.
_SWEEPS = 5
#: An axis that turns less does not move.
_LEAST_TANGENT = 2.0**-54
_PAIRS = ((0, 1, 2), (0, 2, 1), (1, 2, 0))


def main_axes(covariance: Floats) -> Floats:
    """Unit vectors along the largest eigenvalue of symmetric matrices, (n, 3), of (n, 3, 3).

    Of either sign; along the first axis where a matrix is zero.
    """
    # Powers of two, so that nothing over- or underflows, and nothing rounds.
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
    """Whether what is left between the axes of all matrices turns none of them."""
    return all(
        bool(np.all(np.abs(rows[p][q]) <= _LEAST_TANGENT * np.abs(rows[q][q] - rows[p][p])))
        for p, q, _ in _PAIRS
    )


def _rotate(rows: list[list[Floats]], vectors: list[Floats], p: int, q: int, r: int) -> None:
    """Turn axes ``p`` and ``q`` so that nothing is left between them.

    Parameters
    ----------
    rows
        Of the matrices, (n,) each; turned in place, as the axes are, (3, n) each.
    """
    between, apart = rows[p][q], rows[q][q] - rows[p][p]
    # tan of the angle, the smaller of the two, in a form that divides by nothing small.
    twice = 2.0 * between
    # Numbers of at most 1: what is lost of a square here is nothing beside the other one.
    longest = np.abs(apart) + np.sqrt(apart * apart + twice * twice)
    tangent = twice * np.copysign(1.0, apart) / (longest + (longest == 0.0))
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


# What the actuators of a stimulus have to do, and which of their limits it passes.

#: Of the channel where each is largest, in the order of the columns.
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
# What an equaliser rings for before and after belongs to what the actuator does.
_RINGS_S = 0.1


def actuator_metrics(stimulus: PreparedStimulus, factor: float, limits: Limits) -> dict[str, float]:
    """Metrics of the voltages at the actuators that a design is predicted through.

    ``limits_passed`` counts the limits that any channel passes, of ``limits`` and those that the
    library knows of the actuator; NaN where there are none.  All are NaN where the design is not
    predicted through actuators.

    Parameters
    ----------
    factor
        What all amplitudes are multiplied with.

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
        told = _actuator_demand(drive, stimulus.limb, at, actuation, thermal)
        passed |= {breach.name for breach in breaches(told, allowed)}
        for name in ACTUATOR_METRICS[:-1]:
            metrics[name] = float(np.maximum(metrics[name], getattr(told, name)))
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
    (told,) = predicted(voltage, round(rate_hz), at.model, thermal=thermal)
    return told


def _limits_of(at: ActuatorAt) -> tuple[Limits, Thermal | None]:
    """What the library knows of an actuator by its name."""
    if at.actuator not in names():
        return Limits(), None
    about = profile(at.actuator)
    return about.limits, about.thermal


def _drives_of(stimulus: PreparedStimulus, factor: float) -> dict[int, Floats]:
    """The drive of each place where anything moves, (n_times,), m/s² or V."""
    n_times = stimulus.stimulus_samples
    channels: dict[int, Floats] = {}
    for each in stimulus.moving:
        drive = channels.setdefault(each.voice.location, np.zeros(n_times))
        weight = each.voice.amplitude * each.drive.factor * factor
        drive[each.start : each.end] += weight * each.drive.samples
    return channels


# What actuators get, in numbers.


@dataclass(frozen=True, slots=True, eq=False)
class _MeasuredDrive:
    """Of a drive: its largest sample, its energy, and the share of that outside the band."""

    drive: Drive
    peak: float
    energy: float
    outside: float


class DriveMetrics:
    """Measures drives; those of inputs that stay as they are once."""

    def __init__(self) -> None:
        self._known: dict[int, _MeasuredDrive] = {}

    def of(self, stimulus: PreparedStimulus, factor: float) -> dict[str, float]:
        """Peak and RMS of all channels, and the share of energy outside the band.

        Parameters
        ----------
        factor
            What all amplitudes are multiplied with.
        """
        rate_hz, n_times = stimulus.limb.sample_rate_hz, stimulus.stimulus_samples
        channels: dict[int, list[tuple[float, Placed, _MeasuredDrive]]] = {}
        energy = outside = 0.0
        for each in stimulus.placed:
            weight = each.voice.amplitude * each.drive.factor * factor
            known = self._of_drive(each, rate_hz, stimulus.limb.band_hz)
            channels.setdefault(each.voice.location, []).append((weight, each, known))
            energy += weight**2 * known.energy
            outside += weight**2 * known.energy * known.outside
        peak = squares = 0.0
        for inputs in channels.values():
            if len(inputs) == 1:
                weight, _, known = inputs[0]
                peak = max(peak, abs(weight) * known.peak)
                squares += weight**2 * known.energy
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
        known = self._known.get(placed.voice.id)
        if known is None or known.drive is not placed.drive:
            samples = placed.drive.samples
            known = self._known[placed.voice.id] = _MeasuredDrive(
                placed.drive,
                float(np.abs(samples).max(initial=0.0)),
                float(np.vecdot(samples, samples)),
                share_outside_band(samples, rate_hz, band_hz) if band_hz else np.nan,
            )
        return known


def _sum(inputs: list[tuple[float, Placed, _MeasuredDrive]], n_times: int) -> Floats:
    """What inputs at one place play together, (n_times,)."""
    total = np.zeros(n_times)
    for weight, placed, _ in inputs:
        total[placed.start : placed.end] += weight * placed.drive.samples
    return total


# How far the vibrations of a sweep reach.

OF_EXTENT = (
    "mean_distance_mm",
    "d90_mm",
    "share_above_12_db",
    "share_above_20_db",
    "participation",
)
# Sets of places whose distances are remembered.
_MOST = 1000
_Key = tuple[str, tuple[int, ...]]


class Extents:
    """Says how far vibrations reach; remembers where places lie."""

    def __init__(self) -> None:
        self._known: dict[_Key, Floats] = {}

    def of(
        self, rms: Sequence[Floats], stimuli: Sequence[PreparedStimulus | None]
    ) -> list[dict[str, float]]:
        """What `skinsource.extent` says, by name, of each stimulus; NaN where there is none.

        Parameters
        ----------
        rms : (n_outputs,) each
            Of the outputs.
        """
        extents = [dict.fromkeys(OF_EXTENT, np.nan) for _ in stimuli]
        alike: dict[_Key, list[int]] = {}
        for which, stimulus in enumerate(stimuli):
            if stimulus is None:
                continue
            key = (
                stimulus.limb.name,
                tuple(dict.fromkeys(each.voice.location for each in stimulus.moving)),
            )
            distance_mm = self._distances_mm(stimulus.limb, key)
            if rms[which][np.isfinite(distance_mm)].any():
                alike.setdefault(key, []).append(which)
        for key, numbers in alike.items():
            made = spread(np.array([rms[which] for which in numbers]), self._known[key])
            for row, which in enumerate(numbers):
                extents[which] = {name: float(made[name][row]) for name in OF_EXTENT}
        return extents

    def _distances_mm(self, limb: Limb, key: _Key) -> Floats:
        """Distance of each output from the nearest place, mm; NaN where nothing plays."""
        if key not in self._known:
            if len(self._known) >= _MOST:
                self._known.clear()
            places = key[1]
            self._known[key] = (
                distances_mm(limb, places) if places else np.full(limb.n_outputs, np.nan)
            )
        return self._known[key]
