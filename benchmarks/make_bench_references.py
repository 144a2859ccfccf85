"""Exact values of the cases of ``skinsource bench`` with mpmath: ``data/bench-references.npz``.

Convolutions are sums of products, resampled signals their formula, actuators the exponential of
their equations in ``tests/references/check.py``, and wanted drives the solution of their normal
equations: no engine of the library is involved.

    PYTHONPATH=core:. python benchmarks/make_bench_references.py

Then write the list of data files anew: PYTHONPATH=core python tests/core/test_shipped_files.py
"""

import io
from dataclasses import asdict

import numpy as np
from mpmath import mp, mpf

from skinsource.base.assets import data_folder
from skinsource.base.files import write_bytes
from skinsource.studies.accuracy.cases import (
    BELL_S,
    FILE_NAME,
    MIDDLE_S,
    TONES_HZ,
    Case,
    Convolution,
    Inversion,
    Resampling,
    cases_without_reference,
)
from tests.references.check import motion


def convolved(problem: Convolution, samples: np.ndarray) -> np.ndarray:
    """Sums of products at some samples of the channels asked for."""
    responses = [problem.solution(value)[:, ::-1] for value in problem.responses]
    n_taps = problem.limb.n_taps
    padded = np.pad(problem.drives, ((0, 0), (n_taps - 1, n_taps - 1)))
    drives = [[mpf(value) for value in row] for row in padded.tolist()]
    rows = []
    for row in zip(*responses, strict=True):
        taps = [mpf(value) for response in row for value in response.tolist()]
        pieces = ([value for drive in drives for value in drive[k : k + n_taps]] for k in samples)
        rows.append([float(mp.fdot(taps, piece)) for piece in pieces])
    return np.array(rows)


def resampled(problem: Resampling, samples: np.ndarray) -> np.ndarray:
    """The formula of `skinsource.studies.accuracy.cases.tone_burst`."""
    times = [mpf(int(k)) / problem.to_hz - mpf(MIDDLE_S) for k in samples]
    bells = [mp.exp(-((time / mpf(BELL_S)) ** 2) / 2) for time in times]
    tones = [sum(mp.cos(2 * mp.pi * mpf(hz) * time) for hz in TONES_HZ) for time in times]
    return np.array([[float(a * b) for a, b in zip(bells, tones, strict=True)]])


def inverted(problem: Inversion) -> np.ndarray:
    """The solution of the normal equations."""
    matrix = [[mpf(value) for value in column] for column in problem.convolution.T.tolist()]
    wanted = [mpf(value) for value in problem.wanted.ravel().tolist()]
    normal = mp.matrix([[mp.fdot(one, other) for other in matrix] for one in matrix])
    for k in range(normal.rows):
        normal[k, k] += mpf(problem.load)
    drives = mp.lu_solve(normal, mp.matrix([mp.fdot(column, wanted) for column in matrix]))
    return np.array([float(value) for value in drives]).reshape(-1, problem.n_times)


def reference_of(case: Case) -> np.ndarray:
    """Exact values, (n_rows, n_samples), rounded once."""
    problem = case.problem
    if isinstance(problem, Convolution):
        return convolved(problem, case.samples)
    if isinstance(problem, Resampling):
        return resampled(problem, case.samples)
    if isinstance(problem, Inversion):
        return inverted(problem)
    coil = {"kind": "VoiceCoil", **asdict(problem.coil)}
    return np.array(motion(coil, problem.voltage, "zero"))[:, case.samples]


def main() -> None:
    """Write the file."""
    mp.dps = 60
    content = io.BytesIO()
    np.savez_compressed(
        content, **{case.name: reference_of(case) for case in cases_without_reference()}
    )
    write_bytes(data_folder() / FILE_NAME, content.getvalue())


if __name__ == "__main__":
    main()
