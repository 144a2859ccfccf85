"""Measures one method on one signal scene."""

from collections.abc import Iterable
from dataclasses import asdict
from time import perf_counter
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.method_comparison.accuracy import QUIETEST, Block, Errors
from skinsource.method_comparison.method import Unfit
from skinsource.method_comparison.signal_engines import checked, signal_engine_of
from skinsource.method_comparison.signal_scenes import SignalScene
from skinsource.method_comparison.timing import repeated

_WINDOW_S = 0.1


def measured_signal(
    scene: SignalScene,
    engine: str,
    setting: str,
    *,
    longest_s: float,
    most_runs: int,
    warm_ups: int,
) -> dict[str, Any]:
    """Times and errors; or, under ``"unfit"``, why there are none: failures are rows too."""
    exact = scene.exact()
    try:
        start = perf_counter()
        compute = signal_engine_of(engine, scene.family).prepare(scene, setting)
        values = checked(compute(), exact)
        end = perf_counter()
    except Unfit as reason:
        return {"unfit": str(reason)}

    def run(_: int) -> Iterable[Block]:
        return ((0, compute()),)

    seconds = repeated(
        run, first_s=end - start, warm_ups=warm_ups, longest_s=longest_s, most_runs=most_runs
    )
    errors = signal_errors(values, exact, scene.sample_rate_hz)
    return {
        "first_s": end - start,
        "run_s": seconds,
        "channels": len(exact),
        "errors": asdict(errors),
        "ratio": errors.peak / float(np.finfo(np.float64).eps),
        "bytes_above_idle": None,
    }


def signal_errors(values: Floats, exact: Floats, sample_rate_hz: float) -> Errors:
    """Errors of ``values``, (n_rows, n_times): each row against its own peak, the worst counts."""
    peaks = np.abs(exact).max(axis=1)
    heard_rows = peaks > 0.0
    deviation = np.abs(values - exact)[heard_rows]
    kept, peaks = exact[heard_rows], peaks[heard_rows]
    n = max(int(_WINDOW_S * sample_rate_hz), 1)
    padding = ((0, 0), (0, -kept.shape[1] % n))
    by_window = np.pad(deviation, padding).reshape(len(kept), -1, n).max(axis=2)
    window_peaks = np.abs(np.pad(kept, padding)).reshape(len(kept), -1, n).max(axis=2)
    heard = window_peaks >= QUIETEST * peaks[:, None]
    norm = np.sqrt(np.square(kept).sum(axis=1))
    return Errors(
        peak=float((deviation.max(axis=1) / peaks).max()),
        l2=float((np.sqrt(np.square(deviation).sum(axis=1)) / norm).max()),
        window=float((by_window[heard] / window_peaks[heard]).max()),
        silence=0.0,
    )
