"""Metrics of one stimulus after another."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.decibels import decibels
from skinsource.design import Design
from skinsource.errors import InvalidInputError, SkinSourceError, Stopped
from skinsource.job import Stop, never
from skinsource.limb import axis_numbers
from skinsource.quantities import new_graph, sources
from skinsource.rendering.moments import needs_products
from skinsource.rendering.trace_rules import shown_outputs
from skinsource.shared import Shared
from skinsource.sweeps.actuator_metrics import ACTUATOR_METRICS, actuator_metrics
from skinsource.sweeps.drive_metrics import DriveMetrics
from skinsource.sweeps.extents import OF_EXTENT, Extents
from skinsource.sweeps.field import Fields
from skinsource.sweeps.neighbours import Together
from skinsource.sweeps.plan import Plan
from skinsource.sweeps.prepared import Prepared, Preparing
from skinsource.sweeps.stimulus_response import (
    Seen,
    looked_at,
    seen_alone,
    seen_together,
    windows_of,
)
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
    "level_above_threshold_db",
    *OF_EXTENT,
)
_OF_OUTPUTS = ("rms", "rms_100ms", "peak")
Metrics = dict[str, float]


def columns_of(plan: Plan) -> tuple[str, ...]:
    """Names of the metrics of a plan."""
    return (
        *METRICS,
        *(f"output_{one}_{name}" for one in plan.outputs for name in _OF_OUTPUTS),
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
        self._together = Together(self._preparing)
        # Of the neighbours that were asked for latest; None: each by itself.
        self._latest = range(0)
        self._prepared: dict[int, Prepared] = {}
        self._seen: dict[int, Seen] | None = None
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
        - where predictions go through actuators, `skinsource.sweeps.actuator_metrics`.

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
        for one in self.plan.outputs:
            metrics |= _of_output(f"output_{one}_", rms[one - 1], seen.windows[one], factor)
        if self.plan.drives_actuators:
            metrics |= actuator_metrics(prepared, factor, self.plan.limits)
        return {name: float(value) for name, value in metrics.items()}

    def _looked_at(self, number: int, stop: Stop) -> tuple[Prepared, Seen]:
        """A stimulus, and what the skin does."""
        if number not in self._latest:
            neighbours = self.plan.neighbours(number)
            self._latest, self._prepared, self._seen = range(0), {}, None
            self._seen = self._seen_together(neighbours, stop)
            self._latest = neighbours
        prepared = self._prepared.pop(number, None) or self._prepare(number, stop)
        seen = (self._seen or {}).get(number)
        return prepared, seen or self._seen_alone(prepared, stop)

    def _prepare(self, number: int, stop: Stop) -> Prepared:
        prepared = self._preparing.of(self.plan.design_of(number), stop)
        shown_outputs(self.plan.outputs, prepared.limb)
        return prepared

    def _seen_together(self, neighbours: range, stop: Stop) -> dict[int, Seen] | None:
        """What the skin does by each of the neighbours; None where they have little in common."""
        found: list[Prepared | None] = []
        for number in neighbours:
            try:
                one = self._prepared[number] = self._prepare(number, stop)
            except Stopped:
                raise
            except (SkinSourceError, MemoryError):
                # It is said when it is that one's turn.
                found.append(None)
                continue
            if one.n_fft() is None:
                return None
            found.append(one)
        vibrations = self._together.of(found, stop, products=self._products(found))
        if vibrations is None:
            return None
        seen = seen_together(self.plan, vibrations, found, self._extents, stop)
        return dict(zip(neighbours, seen, strict=True))

    def _products(self, stimuli: Iterable[Prepared | None]) -> bool:
        """Whether products of different axes are needed of any."""
        plan = self.plan
        return any(
            needs_products(axis_numbers(plan.axes, one.limb.axes), plan.method)
            for one in stimuli
            if one is not None
        )

    def _seen_alone(self, one: Prepared, stop: Stop) -> Seen:
        responses = self._preparing.responses(one, one.n_fft())
        field = self._fields.of(responses, one.placed, stop, products=self._products([one]))
        if field is None:
            return self._seen_in_blocks(one, stop)
        return seen_alone(self.plan, field, one, self._extents, stop)

    def _seen_in_blocks(self, one: Prepared, stop: Stop) -> Seen:
        """The same of a long design, by the rules that stream it."""
        design, plan = one.design, self.plan
        rms = self._evaluate(design, self._view, "output_rms", stop)
        level = None
        if plan.level == "above_threshold":
            raise InvalidInputError(
                f"the response lasts {one.response_samples / one.limb.sample_rate_hz:.4g} s, which "
                "is too long to be brought to a level above threshold. Shorten the stimulus, or "
                "choose the level loudest_100ms."
            )
        if plan.level_db is not None:
            view = replace(self._view, span="loudest")
            level = float(self._evaluate(design, view, "output_rms", stop).max())
        outputs = looked_at(rms, plan)
        view = replace(self._view, outputs=outputs)
        traces = self._evaluate(design, view, "selected_traces", stop)
        windows = windows_of(traces, one.limb.sample_rate_hz)
        (extent,) = self._extents.of([rms], [one])
        return Seen(rms, dict(zip(outputs, windows, strict=True)), level, extent)

    def _evaluate(self, design: Design, view: View, name: str, stop: Stop) -> Floats:
        found: Floats = self._graph.evaluate((name,), sources(design, view), stop)[name]
        return found


def _levels_db(kind: str | None, level: float | None, factor: float) -> Metrics:
    found = float(decibels(level * factor)) if level else np.nan
    return {
        "level_100ms_db": found if kind == "loudest_100ms" else np.nan,
        "level_above_threshold_db": found if kind == "above_threshold" else np.nan,
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
