"""Names of the metrics of a stimulus, and those of its drives, actuators and extent."""

from collections.abc import Sequence
from weakref import WeakKeyDictionary

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.catalog import profile_of
from skinsource.actuators.equalising import equalised, followed_band
from skinsource.actuators.prediction import Limits, Prediction, Thermal, breaches, predicted
from skinsource.actuators.rigs import strictest
from skinsource.base.arrays import Floats
from skinsource.base.measurement_conditions import Band
from skinsource.design.signal_path import Drive
from skinsource.engine.actuator_demand import drive_at
from skinsource.engine.gains import Placed
from skinsource.export.tables import EXTENT_COLUMNS
from skinsource.limbs.extent import distances_mm, spread
from skinsource.limbs.limb import Limb
from skinsource.signals.spectra import share_of_scaled
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
    "outputs_in_noise",
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


def moving_locations(placed: Sequence[Placed]) -> tuple[int, ...]:
    """Return the locations at which anything moves the skin, each once."""
    return tuple(dict.fromkeys(each.voice.location for each in placed if each.moves))


class ExtentMetrics:
    """Measures extents; distances are computed once for as long as the places stay."""

    def __init__(self) -> None:
        self._cached: tuple[Limb | None, tuple[int, ...], Floats] = None, (), np.empty(0)

    def of(self, rms: Floats, limb: Limb, placed: Sequence[Placed]) -> Metrics:
        """Return the metrics of `skinsource.extent` for the RMS of all outputs; NaN for silence."""
        locations = moving_locations(placed)
        if not locations:
            return dict.fromkeys(EXTENT_COLUMNS, np.nan)
        if self._cached[:2] != (limb, locations):
            self._cached = limb, locations, distances_mm(limb, locations)
        distance_mm = self._cached[2]
        if not rms[np.isfinite(distance_mm)].any():
            return dict.fromkeys(EXTENT_COLUMNS, np.nan)
        return {name: float(value) for name, value in spread(rms, distance_mm).items()}


class DriveMetrics:
    """Measures drives; what inputs at a place play is measured once for as long as it stays."""

    def __init__(self) -> None:
        # The inputs at a place; peak and energy of their sum, energies of each, and outside of it.
        self._cached: dict[int, tuple[list[Placed], Band | None, tuple[float, ...]]] = {}
        # Inputs that play the same share a drive.
        self._shares = WeakKeyDictionary[Drive, tuple[Band, float]]()

    def of(self, placed: Sequence[Placed], n_times: int, limb: Limb, factor: float) -> Metrics:
        """Return peak and RMS of all channels, and the share of energy outside the band.

        Parameters
        ----------
        placed
            Audible inputs with their drives.
        n_times
            Samples of the stimulus.
        factor
            Factor of all amplitudes.
        """
        places: dict[int, list[Placed]] = {}
        for each in placed:
            places.setdefault(each.voice.location, []).append(each)
        figures = [self._of_place(here, limb) for here in places.values()] or [(0.0,) * 4]
        peaks, squares, energies, outside = zip(*figures, strict=True)
        energy = sum(energies)
        return {
            "drive_peak": factor * max(peaks),
            "drive_rms": factor * float(np.sqrt(sum(squares) / (n_times * len(figures)))),
            "share_outside_band": sum(outside) / energy if energy > 0.0 else np.nan,
        }

    def _of_place(self, here: list[Placed], limb: Limb) -> tuple[float, ...]:
        location = here[0].voice.location
        cached = self._cached.get(location)
        if cached is None or cached[:2] != (here, limb.band_hz):
            channel = drive_at(here, location)
            energy = outside = 0.0
            for each in here:
                samples, share = each.drive.samples, np.nan
                if limb.band_hz is not None and not each.drive.silent:
                    share = self._share_outside(each.drive, limb.sample_rate_hz, limb.band_hz)
                own = (each.voice.amplitude * each.drive.factor) ** 2 * np.vecdot(samples, samples)
                energy += own
                outside += own * share if own else 0.0
            peak = float(np.abs(channel).max(initial=0.0))
            figures = peak, float(np.vecdot(channel, channel)), float(energy), float(outside)
            cached = self._cached[location] = here, limb.band_hz, figures
        return cached[2]

    def _share_outside(self, drive: Drive, rate_hz: float, band_hz: Band) -> float:
        known = self._shares.get(drive)
        if known is None or known[0] != band_hz:
            known = band_hz, share_of_scaled(drive.samples, rate_hz, band_hz)
            self._shares[drive] = known
        return known[1]


# An equaliser rings before and after the drive, and the actuator has to play that too.
_RINGS_S = 0.1


def actuator_metrics(
    placed: Sequence[Placed],
    n_times: int,
    limb: Limb,
    actuation: Actuation | None,
    factor: float,
    limits: Limits,
) -> Metrics:
    """Return metrics of the voltages at the actuators that a design is predicted through.

    ``limits_passed`` counts the limits that any channel passes, of ``limits`` and those that the
    library knows of the actuator; NaN where there are none.  All are NaN where the design is not
    predicted through actuators.

    Parameters
    ----------
    placed
        Audible inputs with their drives.
    n_times
        Samples of the stimulus.
    factor
        Factor of all amplitudes.

    Raises
    ------
    InvalidInputError
        A place has no actuator, or drives at one place leave a velocity, so that nothing can follow
        them.
    """
    if actuation is None:
        return dict.fromkeys(ACTUATOR_METRICS, np.nan)
    metrics = dict.fromkeys(ACTUATOR_METRICS, 0.0)
    passed: set[str] = set()
    known = False
    for location in moving_locations(placed):
        drive = np.zeros(n_times)
        here = drive_at(placed, location)
        drive[: here.size] = factor * here
        at = actuation.at(location)
        listed = profile_of(at.actuator)
        allowed = limits if listed is None else strictest(limits, listed.limits)
        thermal = None if listed is None else listed.thermal
        known = known or allowed != Limits()
        demand = _actuator_demand(drive, limb, at, actuation, thermal)
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
