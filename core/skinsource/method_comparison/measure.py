"""Measures every method on every scene, each time in a fresh process, in random order."""

import json
import os
import random
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.method_comparison.accuracy import Errors
from skinsource.method_comparison.compared_limb import MADE_UP
from skinsource.method_comparison.every_scene import Engine, Scene, limb_of
from skinsource.method_comparison.method import Method
from skinsource.method_comparison.promises import Outcome, broken_promises
from skinsource.method_comparison.table import Row
from skinsource.method_comparison.timing import times_of
from skinsource.method_comparison.worker import Task

_SEED = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Effort:
    """How long is measured.

    Attributes
    ----------
    processes
        Fresh processes for each row.
    longest_s, most_runs, warm_ups
        In each process, see `skinsource.method_comparison.timing.repeated`.
    timeout_s
        A process that takes longer has failed.
    """

    processes: int
    longest_s: float
    most_runs: int
    warm_ups: int
    timeout_s: float


FULL = Effort(processes=3, longest_s=0.2, most_runs=20, warm_ups=3, timeout_s=90.0)
QUICK = Effort(processes=1, longest_s=0.1, most_runs=10, warm_ups=2, timeout_s=20.0)


@dataclass(slots=True, kw_only=True)
class Case:
    """A row in the making.

    Attributes
    ----------
    scene, engine, method
        What is measured.
    results
        What the processes gave.
    failure
        Why no more processes are started; empty while all is well.
    """

    scene: Scene
    engine: Engine
    method: Method
    results: list[dict[str, Any]] = field(default_factory=list)
    failure: str = ""


def cases_of(
    scenes: Sequence[Scene], engines: Sequence[Engine], *, quick: bool = False
) -> list[Case]:
    """Every method on every scene of its family; for a short run, those that it includes."""
    return [
        Case(scene=scene, engine=engine, method=method)
        for scene in scenes
        for engine in engines
        for method in engine.methods
        if engine.family == scene.family
        and (method.setting.is_exact or not scene.exact_only)
        and (not quick or (scene.in_quick and method.in_quick))
    ]


def measure(
    cases: Sequence[Case],
    effort: Effort,
    progress: Progress = silent,
    start: Callable[[Task, float], dict[str, Any]] | None = None,
    stop: Stop = never,
    keep: Callable[[list[Row]], None] | None = None,
    references: Path | None = None,
) -> list[Row]:
    """Rows of all ``cases``, in their order; those that failed are among them.

    Every case is measured once before any is measured again.

    Parameters
    ----------
    start
        Measures a task within some seconds; by default in a fresh process.
    keep
        Gets the rows that there are, in their order, after each process: what is stopped later
        has not been for nothing.
    stop
        Asked before each process.
    references
        File with the exact values; None: those that come with the program.

    Raises
    ------
    Stopped
        ``stop`` said so.
    """
    run = in_fresh_process if start is None else start
    shuffle = random.Random(_SEED).shuffle  # noqa: S311, an order, not a secret
    total = processes_of(cases, effort)
    done = 0
    rows: dict[int, Row] = {}
    for turn in range(effort.processes):
        order = [k for k, case in enumerate(cases) if turn < case.scene.most_processes]
        shuffle(order)
        for k in order:
            case = cases[k]
            stop_if(stop, "Measuring was stopped.")
            progress(done, total, f"{case.scene.key} {case.engine.name}")
            done += 1
            if not case.failure:
                _measure_once(case, effort, run, references)
                rows[k] = row_of(case)
                if keep is not None:
                    keep([rows[each] for each in sorted(rows)])
    return [rows[k] for k in sorted(rows)]


def processes_of(cases: Sequence[Case], effort: Effort) -> int:
    """How many processes `measure` starts if none fails."""
    return sum(min(effort.processes, case.scene.most_processes) for case in cases)


def _measure_once(
    case: Case,
    effort: Effort,
    run: Callable[[Task, float], dict[str, Any]],
    references: Path | None,
) -> None:
    limb = limb_of(case.scene)
    task = Task(
        scene=case.scene.key,
        engine=case.engine.name,
        precision=case.method.precision,
        setting=case.method.setting.name,
        longest_s=effort.longest_s,
        most_runs=effort.most_runs,
        warm_ups=effort.warm_ups,
        limb="" if limb == MADE_UP else limb.name,
        digest=limb.digest,
        references="" if references is None else str(references),
    )
    result = run(task, effort.timeout_s)
    if "unfit" in result:
        case.failure = result["unfit"]
    else:
        case.results.append(result)


def in_fresh_process(task: Task, timeout_s: float) -> dict[str, Any]:
    """Measure ``task`` in a process of its own; a crash or a time-out comes back as unfit.

    However this process ends, that one ends with it: its input is a pipe that is then closed.
    """
    read_end, write_end = os.pipe()
    try:
        done = subprocess.run(  # noqa: S603, our own interpreter and our own words
            [sys.executable, "-m", "skinsource.method_comparison.worker", *task.words()],
            stdin=read_end,
            capture_output=True,
            text=True,
            timeout=timeout_s,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return {"unfit": f"took longer than {timeout_s:g} s"}
    finally:
        os.close(write_end)
        os.close(read_end)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["without a word"])[-1]
        return {"unfit": f"ended with code {done.returncode}: {last}"}
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def row_of(case: Case) -> Row:
    """Put the results of all processes of a case together."""
    scene, method = case.scene, case.method
    row = Row(
        scene=scene.key,
        engine=case.engine.name,
        precision=method.precision,
        setting=method.setting.name,
        inputs_changed=scene.active_inputs,
        inputs=scene.n_inputs,
        samples=scene.response_samples,
        reference=scene.reference,
        failure=case.failure,
        limb=limb_of(scene),
    )
    if case.failure or not case.results:
        return row
    times = times_of([s for result in case.results for s in result["run_s"]])
    errors = _worst([Errors(**result["errors"]) for result in case.results])
    held = [r["bytes_above_idle"] for r in case.results if r["bytes_above_idle"] is not None]
    outcome = Outcome(
        errors=errors, minimum_s=times.minimum_s, bytes_above_idle=max(held, default=None)
    )
    return replace(
        row,
        channels=case.results[0]["channels"],
        t_min_ms=1e3 * times.minimum_s,
        t_median_ms=1e3 * times.median_s,
        t_mad_ms=1e3 * times.deviation_s,
        t_p95_ms=1e3 * times.p95_s,
        t_first_ms=1e3 * min(result["first_s"] for result in case.results),
        runs=times.runs,
        processes=len(case.results),
        peak_mb=None if outcome.bytes_above_idle is None else outcome.bytes_above_idle / 1e6,
        err_max=errors.peak,
        err_l2=errors.l2,
        err_window=errors.window,
        err_silence=errors.silence,
        ratio=max(result["ratio"] for result in case.results),
        promise=_promise(case, outcome),
        stable=times.is_stable,
    )


def _promise(case: Case, outcome: Outcome) -> str:
    if not case.method.setting.is_exact:
        return "none"
    broken = broken_promises(
        outcome, case.scene, case.method.precision, is_ours=case.engine.is_ours
    )
    return f"broken: {'; '.join(broken)}" if broken else "kept"


def _worst(errors: Sequence[Errors]) -> Errors:
    # NumPy's maximum, because Python's forgets what is not a number.
    return Errors(
        peak=float(np.max([one.peak for one in errors])),
        l2=float(np.max([one.l2 for one in errors])),
        window=float(np.max([one.window for one in errors])),
        silence=float(np.max([one.silence for one in errors])),
    )
