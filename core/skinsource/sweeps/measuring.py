"""Metrics of one stimulus after another."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from skinsource.analysis import extent
from skinsource.arrays import Floats
from skinsource.decibels import decibels
from skinsource.design import Design
from skinsource.job import Stop, never
from skinsource.limb import Limb
from skinsource.loudest_window import loudest_energy, window_samples
from skinsource.quantities import new_graph, sources
from skinsource.rendering.level_rules import loudest_rms, projection, record_rms
from skinsource.rendering.placed import Placed
from skinsource.rendering.trace_rules import shown_outputs
from skinsource.rendering.transforms import inverse
from skinsource.shared import Shared
from skinsource.spectra import share_outside_band
from skinsource.sweeps.field import Fields
from skinsource.sweeps.plan import Plan
from skinsource.view import View

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
    "mean_distance_mm",
    "d90_mm",
    "share_above_12_db",
    "share_above_20_db",
    "participation",
)
_OF_OUTPUTS = ("rms", "rms_100ms", "peak")
Metrics = dict[str, float]
_FIRST = (
    "placed",
    "responses",
    "response_samples",
    "stimulus_samples",
    "limb_data",
    "axis_numbers",
    "products_needed",
)


def columns_of(outputs: tuple[int, ...]) -> tuple[str, ...]:
    """Names of the metrics where ``outputs`` are measured beside the loudest one."""
    return (*METRICS, *(f"output_{one}_{name}" for one in outputs for name in _OF_OUTPUTS))


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
        self._graph = new_graph(Shared())
        self._fields = Fields(plan.varying)
        # No input stands apart: which of them vary is another matter here.
        self._view = View(axes=plan.axes, method=plan.method, outputs=(), selected_inputs=())
        self._shares: dict[int, tuple[Any, float]] = {}

    def measure(self, number: int, stop: Stop = never) -> Metrics:
        """Metrics of stimulus ``number``, by name.

        In m/s², m/s² of the drive under probe scaling, seconds, mm and shares from 0 to 1:

        - ``factor``: what all amplitudes were multiplied with to reach the plan's level;
        - ``duration_s``; ``drive_peak``, ``drive_rms``: largest and RMS of all channels;
        - ``share_outside_band``: of the energy of the drive, outside 25 to 600 Hz;
        - ``loudest_output``: where the RMS of the whole record is highest; there ``rms``,
          ``rms_100ms`` (the loudest 100 ms) and ``peak``;
        - ``level_100ms_db``: the highest RMS of any 100 ms at whatever output, dB re 1 m/s²; only
          where the plan has a level;
        - what `skinsource.extent` says of the RMS of the whole record;
        - ``output_N_rms``, ``output_N_rms_100ms``, ``output_N_peak`` of each output asked for.

        What cannot be said, of silence for instance, is NaN.

        Raises
        ------
        InvalidInputError
            The stimulus cannot be: a value does not fit, a place does not exist.
        DatasetMissingError
            Its limb is a measured one, and the measured dataset is not installed.
        """
        design = self.plan.design_of(number)
        found = self._evaluate(design, self._view, _FIRST, stop)
        limb: Limb = found["limb_data"]
        seen = self._seen(design, found, stop)
        factor = 1.0 if seen.level is None else _factor(self.plan.level_db, seen.level)
        rate_hz = limb.sample_rate_hz
        loudest, rms = seen.loudest, seen.rms
        metrics = {
            "factor": factor,
            "duration_s": found["stimulus_samples"] / rate_hz,
            **self._drive(found["placed"], found["stimulus_samples"], rate_hz, factor),
            "loudest_output": loudest if rms[loudest - 1] > 0.0 else np.nan,
            **_of_trace("", rms[loudest - 1], seen.traces[loudest], rate_hz, factor),
            "level_100ms_db": _level_db(seen.level, factor),
            **_extent(rms, limb, found["placed"]),
        }
        for one in self.plan.outputs:
            metrics |= _of_trace(f"output_{one}_", rms[one - 1], seen.traces[one], rate_hz, factor)
        return {name: float(value) for name, value in metrics.items()}

    def _seen(self, design: Design, found: dict[str, Any], stop: Stop) -> "_Seen":
        """What the skin does."""
        shown_outputs(self.plan.outputs, found["limb_data"])
        field = self._fields.of(
            found["responses"], found["placed"], stop, products=found["products_needed"]
        )
        if field is None:
            return self._seen_in_blocks(design, stop)
        limb, plan, n_times = found["limb_data"], self.plan, found["response_samples"]
        projected = projection(field.moments, found["axis_numbers"], plan.method, n_times)
        rms = record_rms(field.moments, projected, field.spectrum, n_times)
        level = None
        if plan.level_db is not None:
            loud = loudest_rms("loudest", limb, projected, field.spectrum, None, stop)
            level = None if loud is None else float(loud.max())
        rows = np.array(self._outputs(rms)) - 1
        spectra = field.spectrum.rows(rows, projected.axis_numbers)
        traces = inverse(spectra, field.spectrum.n_fft)[..., :n_times]
        signals = projected.at(rows).signals(traces)
        return _Seen(rms, dict(zip(self._outputs(rms), signals, strict=True)), level)

    def _seen_in_blocks(self, design: Design, stop: Stop) -> "_Seen":
        """The same of a long design, by the rules that stream it."""
        rms = self._evaluate(design, self._view, ("output_rms",), stop)["output_rms"]
        level = None
        if self.plan.level_db is not None:
            view = replace(self._view, span="loudest")
            level = float(self._evaluate(design, view, ("output_rms",), stop)["output_rms"].max())
        outputs = self._outputs(rms)
        view = replace(self._view, outputs=outputs)
        traces = self._evaluate(design, view, ("selected_traces",), stop)["selected_traces"]
        return _Seen(rms, dict(zip(outputs, traces, strict=True)), level)

    def _outputs(self, rms: Floats) -> tuple[int, ...]:
        """Those whose traces are looked at, each once; the loudest first."""
        return tuple(dict.fromkeys((int(np.argmax(rms)) + 1, *self.plan.outputs)))

    def _evaluate(
        self, design: Design, view: View, names: tuple[str, ...], stop: Stop
    ) -> dict[str, Any]:
        return self._graph.evaluate(names, sources(design, view), stop)

    def _drive(
        self, placed: tuple[Placed, ...], n_times: int, rate_hz: float, factor: float
    ) -> Metrics:
        channels: dict[int, Floats] = {}
        energy = outside = 0.0
        for one in placed:
            weight = one.voice.amplitude * one.drive.factor * factor
            channel = channels.setdefault(one.voice.location, np.zeros(n_times))
            channel[one.start : one.end] += weight * one.drive.samples
            own = weight**2 * float(np.square(one.drive.samples).sum())
            energy += own
            outside += own * self._share_outside(one, rate_hz)
        drives = np.array(list(channels.values()))
        return {
            "drive_peak": float(np.abs(drives).max(initial=0.0)),
            "drive_rms": float(np.sqrt(np.mean(np.square(drives)))) if drives.size else 0.0,
            "share_outside_band": outside / energy if energy > 0.0 else np.nan,
        }

    def _share_outside(self, one: Placed, rate_hz: float) -> float:
        """Of the drive; asked again for those that did not change."""
        id = one.voice.id
        known = self._shares.get(id)
        if known is None or known[0] is not one.drive:
            known = self._shares[id] = (one.drive, share_outside_band(one.drive.samples, rate_hz))
        return known[1]


@dataclass(frozen=True, slots=True, eq=False)
class _Seen:
    """RMS of each output, (n_outputs,); traces of some, (n_times,), by number; and the level."""

    rms: Floats
    traces: dict[int, Floats]
    level: float | None

    @property
    def loudest(self) -> int:
        return next(iter(self.traces))


def _level_db(level: float | None, factor: float) -> float:
    return np.nan if level is None else float(decibels(level * factor))


def _factor(level_db: float | None, level: float) -> float:
    """What brings ``level``, m/s², to ``level_db``; 1 for silence."""
    return 10.0 ** ((level_db or 0.0) / 20.0) / level if level > 0.0 else 1.0


def _of_trace(before: str, rms: float, trace: Floats, rate_hz: float, factor: float) -> Metrics:
    n_window = window_samples(rate_hz)
    return {
        f"{before}rms": factor * rms,
        f"{before}rms_100ms": factor * np.sqrt(float(loudest_energy(trace, n_window)) / n_window),
        f"{before}peak": factor * float(np.abs(trace).max(initial=0.0)),
    }


def _extent(rms: Floats, limb: Limb, placed: tuple[Placed, ...]) -> Metrics:
    names = (
        "mean_distance_mm",
        "d90_mm",
        "share_above_12_db",
        "share_above_20_db",
        "participation",
    )
    places = tuple({one.voice.location for one in placed if one.moves})
    on_map = np.isfinite(limb.map.output_positions).all(axis=1)
    if not places or not rms[on_map].any():
        return dict.fromkeys(names, np.nan)
    found = extent(rms, limb, places)
    return {name: float(getattr(found, name)) for name in names}
