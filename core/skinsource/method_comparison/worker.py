"""Measures one method on one scene, in a process of its own; the result is one line of JSON.

python -m skinsource.method_comparison.worker S1 "this program" float64 "all channels" 0.3 20 2
"""

import json
import os
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from threading import Thread
from time import perf_counter
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.method_comparison.accuracy import errors_of, picked, rounding_ratio
from skinsource.method_comparison.compared_limb import MADE_UP, limb_called
from skinsource.method_comparison.engines import engine_of
from skinsource.method_comparison.every_scene import any_scene
from skinsource.method_comparison.made_up import made_up_drive
from skinsource.method_comparison.method import Unfit
from skinsource.method_comparison.references import Reference, load_reference
from skinsource.method_comparison.scenes import ComparedScene
from skinsource.method_comparison.signal_scenes import SignalScene
from skinsource.method_comparison.signal_worker import measured_signal
from skinsource.method_comparison.timing import repeated

_STATUS = Path("/proc/self/status")


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """What one process measures.

    Attributes
    ----------
    scene, engine, precision, setting
        Names of the row.
    longest_s, most_runs, warm_ups
        See `skinsource.method_comparison.timing.repeated`.
    limb, digest
        Of the limb that the scene is computed on; empty: the made-up one.
    references
        File with the exact values; empty: those that come with the program.
    """

    scene: str
    engine: str
    precision: str
    setting: str
    longest_s: float
    most_runs: int
    warm_ups: int
    limb: str = ""
    digest: str = ""
    references: str = ""

    def words(self) -> list[str]:
        """Command-line words that `task_of` reads."""
        return [str(value) for value in asdict(self).values()]


def task_of(words: Sequence[str]) -> Task:
    """Read the words of `Task.words`."""
    scene, engine, precision, setting, longest_s, most_runs, warm_ups, *limb = words
    return Task(
        scene=scene,
        engine=engine,
        precision=precision,
        setting=setting,
        longest_s=float(longest_s),
        most_runs=int(most_runs),
        warm_ups=int(warm_ups),
        **dict(zip(("limb", "digest", "references"), limb, strict=False)),
    )


def measured(task: Task) -> dict[str, Any]:
    """Times and errors; or, under ``"unfit"``, why there are none."""
    limb = limb_called(task.limb, task.digest) if task.limb else MADE_UP
    scene = any_scene(task.scene, limb)
    if isinstance(scene, SignalScene):
        return measured_signal(
            scene,
            task.engine,
            task.setting,
            longest_s=task.longest_s,
            most_runs=task.most_runs,
            warm_ups=task.warm_ups,
        )
    engine = engine_of(task.engine)
    path = Path(task.references) if task.references else None
    reference = load_reference(scene.reference, path)
    idle = _peak_bytes()
    try:
        start = perf_counter()
        prepared = engine.prepare(scene, engine.method_of(task.precision, task.setting))
        ready = perf_counter()
        values = picked(reference, prepared.rows, prepared.run(0))
        end = perf_counter()
    except Unfit as reason:
        return {"unfit": str(reason)}
    except MemoryError:
        return {"unfit": "the memory of this machine did not suffice"}
    run_s = repeated(
        prepared.run,
        first_s=end - ready,
        warm_ups=task.warm_ups,
        longest_s=task.longest_s,
        most_runs=task.most_runs,
    )
    peak = _peak_bytes()
    held = None if idle is None or peak is None else max(peak - idle - prepared.lent_bytes, 0)
    deviation = np.abs((values - reference.high) - reference.low).max(axis=(1, 2))
    precision = np.float64 if task.precision == "float64" else np.float32
    return {
        "first_s": end - start,
        "run_s": run_s,
        "channels": int(prepared.rows.size),
        "errors": asdict(errors_of(reference, values)),
        "ratio": rounding_ratio(
            deviation, _bound_scale(scene, reference), scene.response_samples, precision
        ),
        "bytes_above_idle": held,
    }


def _bound_scale(scene: ComparedScene, reference: Reference) -> Floats:
    """Sum over inputs of the norms of drive and response, (n_channels,)."""
    total, limb = np.zeros(reference.channels.size), scene.limb.load()
    for player in scene.players:
        response = limb.response_to(player.location).reshape(scene.limb.n_channels, -1)
        drive = made_up_drive(player.seed, player.n_times) * player.amplitude
        taps = response[reference.channels]
        total += np.linalg.norm(drive) * np.linalg.norm(taps, axis=-1)
    return total


def _peak_bytes() -> int | None:
    """Most memory this process has held; None where the system does not tell."""
    if not _STATUS.is_file():
        return None
    lines = _STATUS.read_text(encoding="ascii", errors="replace").splitlines()
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith("VmHWM")), None)


def end_with_parent() -> None:
    """End this process as soon as its input is closed, which is when its parent ends."""

    def wait() -> None:
        # Not through `sys.stdin`, whose lock would be held at the regular end.
        while os.read(0, 1):
            pass
        os._exit(1)

    Thread(target=wait, daemon=True).start()


if __name__ == "__main__":
    end_with_parent()
    sys.stdout.write(json.dumps(measured(task_of(sys.argv[1:]))) + "\n")
