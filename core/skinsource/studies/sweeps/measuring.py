"""Measurement of stimuli: the metrics of one stimulus after another, by the graph of the engine."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from skinsource.actuators.actuation import Actuation, profile_of
from skinsource.actuators.equalising import equalised, followed_band
from skinsource.actuators.prediction import Limits, breaches, predicted
from skinsource.actuators.rigs import strictest
from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB, decibels
from skinsource.base.errors import InvalidInputError, SkinSourceError, Stopped, sentence
from skinsource.base.job import Stop, never, stop_if
from skinsource.design.design import Design, View
from skinsource.engine.actuator_demand import drive_at
from skinsource.engine.analysis_rules import SILENT_DB, Sensation
from skinsource.engine.gains import Placed
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.streaming import projected_signals
from skinsource.engine.trace_rules import shown_outputs
from skinsource.engine.voice_rules import moving_places
from skinsource.export.tables import EXTENT_COLUMNS
from skinsource.limbs.extent import distances_mm, spread
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of
from skinsource.people.others import people_of
from skinsource.people.ranges import People, people_like
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.loudest_window import loudest_energy, window_samples
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
#: Ends of the range between people at the loudest output, where a plan asks for it.
RANGE_METRICS = ("range_low_db", "range_high_db")
Metrics = dict[str, float]


def columns_of(plan: Plan) -> tuple[str, ...]:
    """Return the names of the metrics of a plan."""
    return (
        *METRICS,
        *(f"output_{output}_{name}" for output in plan.outputs for name in METRICS_OF_OUTPUTS),
        *(RANGE_METRICS if plan.people else ()),
        *(ACTUATOR_METRICS if plan.drives_actuators else ()),
    )


def extent_metrics(rms: Floats, limb: Limb, placed: Sequence[Placed]) -> Metrics:
    """Return the metrics of `skinsource.extent` for the RMS of all outputs; NaN for silence."""
    locations = moving_places(placed)
    distance_mm = distances_mm(limb, locations) if locations else np.full(rms.size, np.nan)
    if not rms[np.isfinite(distance_mm)].any():
        return dict.fromkeys(EXTENT_COLUMNS, np.nan)
    return {name: float(value) for name, value in spread(rms, distance_mm).items()}


def drive_metrics(placed: Sequence[Placed], n_times: int, limb: Limb, factor: float) -> Metrics:
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
    peaks, squares = [0.0], []
    for location in dict.fromkeys(each.voice.location for each in placed):
        channel = drive_at(placed, location)
        peaks.append(float(np.abs(channel).max(initial=0.0)))
        squares.append(float(np.vecdot(channel, channel)))
    energy = outside = 0.0
    for each in placed:
        samples, share = each.drive.samples, np.nan
        own = (each.voice.amplitude * each.drive.factor) ** 2 * np.vecdot(samples, samples)
        if own and limb.band_hz is not None:
            share = share_of_scaled(samples, limb.sample_rate_hz, limb.band_hz)
        energy += own
        outside += own * share if own else 0.0
    return {
        "drive_peak": factor * max(peaks),
        "drive_rms": factor * float(np.sqrt(sum(squares) / (n_times * max(len(squares), 1)))),
        "share_outside_band": outside / energy if energy > 0.0 else np.nan,
    }


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
    for location in moving_places(placed):
        drive = np.zeros(n_times)
        here = drive_at(placed, location)
        drive[: here.size] = factor * here
        at = actuation.at(location)
        listed = profile_of(at.actuator)
        allowed = limits if listed is None else strictest(limits, listed.limits)
        thermal = None if listed is None else listed.thermal
        known = known or allowed != Limits()
        rate_hz = limb.sample_rate_hz
        if actuation.equaliser is not None:
            drive = equalised(
                drive,
                rate_hz,
                at.model,
                actuation.equaliser,
                band_hz=followed_band(limb.band_hz, rate_hz),
                lead_s=_RINGS_S,
                tail_s=_RINGS_S,
            )
        (demand,) = predicted(drive, round(rate_hz), at.model, thermal=thermal)
        passed |= {breach.name for breach in breaches(demand, allowed)}
        for name in ACTUATOR_METRICS[:-1]:
            metrics[name] = float(np.maximum(metrics[name], getattr(demand, name)))
    metrics["limits_passed"] = float(len(passed)) if known else np.nan
    return metrics


# Outputs whose RMS differ by less are equally loud: the first of them is the loudest.
_TIE = 1e-12
#: What metrics are computed from; levels need more.
_QUANTITIES = (
    "placed",
    "driven_limb",
    "stimulus_samples",
    "response_samples",
    "record_rms",
    "projection",
    "total_spectrum",
    "streamed_vibration",
    "loudest_rms",
)


class Measurer:
    """Measures stimuli of a plan, for one thread; computes again only what the next one changes.

    Parameters
    ----------
    plan
        The stimuli, and what is measured.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._graph = new_graph()
        # The sum of all inputs but the selected one is computed once.  Which input is selected
        # follows from the plan, so that the last bit does not depend on earlier stimuli.
        varying = tuple(plan.varying)
        self._view = View(
            axes=plan.axes,
            method=plan.method,
            span="loudest" if plan.level == "loudest_100ms" else "record",
            outputs=(),
            selected_inputs=varying if len(varying) == 1 else (),
        )
        self._people: dict[tuple[str, ...], People] = {}

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
        - ``outputs_in_noise``: how many outputs are less than 6 dB above the noise of the
          measurement, which the extent counts too; NaN where the noise is not known;
        - ``range_low_db``, ``range_high_db``: what to expect there of ``rms`` on people who were
          not measured, dB re 1 m/s², see `skinsource.people.levels`; only where the plan asks;
        - ``output_N_rms``, ``output_N_rms_100ms``, ``output_N_peak`` of each selected output;
        - where predictions go through actuators, `skinsource.studies.sweeps.measuring`.

        Unknown numbers, such as those of silence, are NaN.

        Raises
        ------
        InvalidInputError
            The stimulus is not possible: a value does not fit, a place does not exist.
        DatasetMissingError
            Its limb is a measured one, and the measured dataset is not installed.
        """
        plan = self.plan
        design = plan.design_of(number)
        # Nothing else needs the drives that noise is computed from, and synthetic limbs have none.
        noise = () if facts_of(design.limb).synthetic else ("above_noise_db",)
        felt = ("sensation",) if plan.level == "above_threshold" else ()
        wanted = (*_QUANTITIES, *noise, *felt)
        values = self._graph.evaluate(wanted, sources(design, self._view), stop)
        placed, limb, rms = values["placed"], values["driven_limb"], values["record_rms"]
        n_times = values["stimulus_samples"]
        level = self._level(values)
        factor = 1.0 if level is None else _factor(plan.level_db, level)
        loudest = int(np.argmax(rms >= (1.0 - _TIE) * rms.max())) + 1
        outputs = (loudest, *shown_outputs(plan.outputs, limb))
        windows = _windows_of(values, outputs, stop)
        metrics = {
            "factor": factor,
            "duration_s": n_times / limb.sample_rate_hz,
            **drive_metrics(placed, n_times, limb, factor),
            "loudest_output": loudest if rms[loudest - 1] > 0.0 else np.nan,
            **_of_output("", rms[loudest - 1], windows[0], factor),
            **_levels_db(plan.level, level, factor),
            **extent_metrics(rms, limb, placed),
            "outputs_in_noise": _outputs_in_noise(values.get("above_noise_db")),
        }
        for output, window in zip(outputs[1:], windows[1:], strict=True):
            metrics |= _of_output(f"output_{output}_", rms[output - 1], window, factor)
        if plan.people:
            metrics |= self._range(design, loudest, factor)
        if plan.drives_actuators:
            metrics |= actuator_metrics(placed, n_times, limb, design.actuated, factor, plan.limits)
        return {name: float(value) for name, value in metrics.items()}

    def _range(self, design: Design, output: int, factor: float) -> Metrics:
        """Return the range between people at an output, over the whole record."""
        names = people_like(design.limb)
        if names not in self._people:
            view = View(axes=self.plan.axes, method=self.plan.method)
            self._people[names] = People(people_of(names, 2), view)
        found = self._people[names].range_of(design)
        if found.mean_db[output - 1] <= FLOOR_DB:
            return dict.fromkeys(RANGE_METRICS, np.nan)
        louder_db = float(decibels(factor))
        ends_db = found.low_db[output - 1], found.high_db[output - 1]
        return {
            name: end_db + louder_db for name, end_db in zip(RANGE_METRICS, ends_db, strict=True)
        }

    def _level(self, values: dict[str, Any]) -> float | None:
        """Return what is brought to the level of the plan: m/s², or a ratio; None: nothing is."""
        if self.plan.level == "loudest_100ms":
            return float(values["loudest_rms"].max())
        if self.plan.level != "above_threshold":
            return None
        sensation: Sensation = values["sensation"]
        if sensation.problem:
            raise InvalidInputError(sensation.problem)
        highest_db = float(sensation.level_db.max())
        return 10.0 ** (highest_db / 20.0) if highest_db > SILENT_DB else 0.0


def _outputs_in_noise(above_noise_db: Floats | None) -> float:
    if above_noise_db is None:
        return np.nan
    return float(np.sum(above_noise_db < LEAST_ABOVE_NOISE_DB))


def _windows_of(
    values: dict[str, Any], outputs: tuple[int, ...], stop: Stop
) -> list[tuple[float, float]]:
    """Return the RMS of the loudest 100 ms and the largest sample at some outputs."""
    projection, streamed = values["projection"], values["streamed_vibration"]
    rows = np.array(outputs) - 1
    if streamed is None:
        signals = projected_signals(values["total_spectrum"], projection, rows)
    else:
        signals = projection.at(rows).signals(
            streamed.traces(outputs, projection.axis_numbers, stop)
        )
    signals = signals[:, : values["response_samples"]]
    n_window = window_samples(values["driven_limb"].sample_rate_hz)
    loudest = np.sqrt(loudest_energy(signals, n_window) / n_window)
    peaks = np.abs(signals).max(axis=-1, initial=0.0)
    return list(zip(loudest.tolist(), peaks.tolist(), strict=True))


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
