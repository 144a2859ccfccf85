"""Measures ways of computing the cases, of this program and of others: error against time."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import astuple, dataclass, fields, replace
from functools import partial
from io import BytesIO
from itertools import count
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import scipy

from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import csv_text
from skinsource.base.extras import package_of_extra
from skinsource.base.files import write_bytes
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design, View, track
from skinsource.design.waveforms.samples import Recording
from skinsource.engine.graph import Graph
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.plot import COLOURS, style
from skinsource.inverse.drives_in_time import Cost
from skinsource.inverse.responses import gram_of
from skinsource.signals.resampling import resample
from skinsource.specs.samples import Samples
from skinsource.studies.accuracy.cases import (
    Actuation,
    Case,
    Convolution,
    Inversion,
    Resampling,
)

#: Computes a case, (n_rows, n_times), after all preparation.
Run = Callable[[], Floats]
#: More products than these take a personal computer more than ten seconds.
_MOST_PRODUCTS = 2e10


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """A way of computing problems of one kind.

    Attributes
    ----------
    name
        Library and function.
    kind
        Class of the problems.
    prepare
        Returns the function that computes a problem repeatedly: its first run is not timed.
    fits
        Returns whether it computes a problem in reasonable time.
    """

    name: str
    kind: type
    prepare: Callable[[Any], Run]
    fits: Callable[[Any], bool] = lambda _: True

    def computes(self, case: Case) -> bool:
        """Return whether a case is of its kind, and fits."""
        return isinstance(case.problem, self.kind) and self.fits(case.problem)


def _predict(problem: Convolution) -> Run:
    limb, drives, locations = problem.limb, problem.drives, problem.locations
    return lambda: problem.solution(predict(limb, drives, locations, scaling="relative"))


def _studio(problem: Convolution, *, edited: bool) -> Run:
    """Compute what the window shows of a design: levels of all outputs, traces of some.

    At each run the first input has a new waveform.  ``edited``: everything else is cached from the
    run before; otherwise nothing is, as in a design that was just opened.
    """
    limb, numbers = problem.limb, count()
    recordings = [
        Recording(Samples(values=drive, sample_rate_hz=limb.sample_rate_hz))
        for drive in problem.drives
    ]
    inputs = [track(*placed) for placed in zip(problem.locations, recordings, strict=True)]
    view = View(outputs=problem.outputs, axes="xyz", selected_inputs=(1,))

    def show(graph: Graph) -> Floats:
        another = replace(recordings[0], name=str(next(numbers)))
        inputs[0] = track(problem.locations[0], another)
        design = Design(limb=limb.name, inputs=tuple(inputs), scaling="relative")
        all_sources = {**sources(design, view), "limb_data": limb}
        traces: Floats = graph.evaluate({"axis_traces", "output_rms"}, all_sources)["axis_traces"]
        return traces.reshape(-1, traces.shape[-1])

    return partial(show, new_graph()) if edited else lambda: show(new_graph())


def _fftconvolve(problem: Convolution) -> Run:
    drives, responses = problem.drives, problem.responses

    def run() -> Floats:
        total = scipy.signal.fftconvolve(responses[0], drives[:1], axes=-1)
        for response, drive in zip(responses[1:], drives[1:], strict=True):
            total += scipy.signal.fftconvolve(response, drive[None], axes=-1)
        return problem.solution(total)

    return run


def _direct_sums(problem: Convolution) -> Run:
    drives, responses = problem.drives, problem.responses

    def run() -> Floats:
        n_channels, n_taps = responses[0].shape
        total = np.zeros((n_channels, drives.shape[1] + n_taps - 1))
        for response, drive in zip(responses, drives, strict=True):
            for channel, taps in zip(total, response, strict=True):
                channel += np.convolve(drive, taps)
        return problem.solution(total)

    return run


def _few_products(problem: Convolution) -> bool:
    limb = problem.limb
    per_sample = limb.n_outputs * limb.n_axes * limb.n_taps
    return float(per_sample) * problem.drives.size <= _MOST_PRODUCTS


def _resample(problem: Resampling) -> Run:
    return lambda: resample(problem.signal, problem.from_hz, problem.to_hz)[None]


def _resample_poly(problem: Resampling) -> Run:
    shared = math.gcd(problem.from_hz, problem.to_hz)
    up, down = problem.to_hz // shared, problem.from_hz // shared
    return lambda: scipy.signal.resample_poly(problem.signal, up, down)[None]


def _resample_fourier(problem: Resampling) -> Run:
    return lambda: np.asarray(scipy.signal.resample(problem.signal, problem.to_hz))[None]


def _simulate(problem: Actuation) -> Run:
    def run() -> Floats:
        moved = problem.coil.simulate(problem.voltage, problem.sample_rate_hz)
        return np.stack((moved.acceleration, moved.velocity, moved.displacement, moved.current))

    return run


def _lsim(problem: Actuation) -> Run:
    coil = problem.coil
    r, ind, bl = coil.resistance_ohm, coil.inductance_h, coil.force_factor_n_per_a
    m, c, k = coil.moving_mass_kg, coil.damping_n_s_per_m, coil.stiffness_n_per_m
    # Current, velocity and displacement.
    states = np.array([[-r / ind, -bl / ind, 0.0], [bl / m, -c / m, -k / m], [0.0, 1.0, 0.0]])
    drive = np.array([[1.0 / ind], [0.0], [0.0]])
    read = np.array([states[1], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    system = states, drive, read, np.zeros((4, 1))
    time_s = np.arange(problem.voltage.size) / problem.sample_rate_hz
    return lambda: scipy.signal.lsim(system, problem.voltage, time_s, interp=False)[1].T


def _cost_of(problem: Inversion) -> tuple[Cost, Complexes]:
    n_fft = problem.wanted.shape[1]
    rows = np.moveaxis(scipy.fft.rfft(problem.taps, n_fft), 2, 0)
    normal = gram_of(rows) + problem.load * np.eye(rows.shape[-1])
    b = np.einsum("fri,rf->fi", rows.conj(), scipy.fft.rfft(problem.wanted))
    return Cost(normal=normal, n_fft=n_fft, n_times=problem.n_times), b


def _exact_drives(problem: Inversion) -> Run:
    cost, b = _cost_of(problem)
    return lambda: cost.exact(b)


def _drives_bin_by_bin(problem: Inversion) -> Run:
    cost, b = _cost_of(problem)
    return lambda: cost.fast(b)


def _drives_of_matrix(problem: Inversion) -> Run:
    matrix = problem.convolution
    b = matrix.T @ problem.wanted.ravel()

    def run() -> Floats:
        normal = matrix.T @ matrix + problem.load * np.eye(b.size)
        return scipy.linalg.solve(normal, b, assume_a="pos").reshape(-1, problem.n_times)

    return run


WAYS = (
    Way(name="SkinSource predict", kind=Convolution, prepare=_predict),
    Way(name="SkinSource, opened", kind=Convolution, prepare=partial(_studio, edited=False)),
    Way(name="SkinSource, edited", kind=Convolution, prepare=partial(_studio, edited=True)),
    Way(name="SciPy fftconvolve", kind=Convolution, prepare=_fftconvolve),
    Way(name="direct sums", kind=Convolution, prepare=_direct_sums, fits=_few_products),
    Way(name="SkinSource resample", kind=Resampling, prepare=_resample),
    Way(name="SciPy resample_poly", kind=Resampling, prepare=_resample_poly),
    Way(name="SciPy resample", kind=Resampling, prepare=_resample_fourier),
    Way(name="SkinSource simulate", kind=Actuation, prepare=_simulate),
    Way(name="SciPy lsim", kind=Actuation, prepare=_lsim),
    Way(name="SkinSource reproduce", kind=Inversion, prepare=_exact_drives),
    Way(name="bin by bin, cut", kind=Inversion, prepare=_drives_bin_by_bin),
    Way(name="SciPy solve", kind=Inversion, prepare=_drives_of_matrix),
)


#: Meaning of the numbers of a row, for people.
MEANING = (
    "An error is the largest difference to the exact values of a case over the largest of them. It "
    "says how exactly numbers are computed, not how well responses describe another hand. A time "
    "is that of the fastest run."
)
#: Headings of `cells_of`.
COLUMNS = ("Case", "Way", "Error", "Time (ms)")
#: Runs of one way on one case: as many, unless all together take longer.
REPEATS, QUICK_REPEATS = 20, 5
_LONGEST_S = 1.0
_SMALLEST = 5e-324
_LONG_MS = 100.0
_STOPPED = "Measuring was stopped."


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One way on one case.

    Attributes
    ----------
    case, way
        Their names.
    error
        Largest difference to an exact value over the largest exact value of its row, the worst of
        all rows; infinite where a result is not a number.
    time_s
        Time of the fastest run.
    runs
        Number of runs.
    """

    case: str
    way: str
    error: float
    time_s: float
    runs: int


def measure(
    cases: Sequence[Case],
    ways: Sequence[Way] = WAYS,
    repeats: int = REPEATS,
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> Iterator[Row]:
    """Yield a row for each way and each case that it computes.

    Parameters
    ----------
    repeats
        Largest number of runs of each.
    progress, stop
        Called before each row, and before each run.

    Raises
    ------
    Stopped
        ``stop`` said so.
    """
    pairs = [(case, way) for case in cases for way in ways if way.computes(case)]
    for k, (case, way) in enumerate(pairs):
        stop_if(stop, _STOPPED)
        progress(k, len(pairs), f"{case.name}: {way.name}")
        yield _measured(case, way, repeats, stop)


# Overflow and its results are an error of a row, not a warning.
@np.errstate(all="ignore")
def _measured(case: Case, way: Way, repeats: int, stop: Stop) -> Row:
    run = way.prepare(case.problem)
    # The first run is not timed: it alone reads and imports.
    error = error_of(run()[:, case.samples], case.reference)
    seconds: list[float] = []
    while not seconds or (len(seconds) < repeats and sum(seconds) < _LONGEST_S):
        stop_if(stop, _STOPPED)
        start_s = perf_counter()
        run()
        seconds.append(perf_counter() - start_s)
    return Row(case=case.name, way=way.name, error=error, time_s=min(seconds), runs=len(seconds))


def error_of(values: Floats, reference: Floats) -> float:
    """Return `Row.error` for values and reference, (n_rows, n_samples)."""
    peaks = np.maximum(np.abs(reference).max(axis=1), _SMALLEST)
    error = float((np.abs(values - reference).max(axis=1) / peaks).max())
    return math.inf if math.isnan(error) else error


def best_of(rows: Sequence[Row]) -> list[Row]:
    """Return the rows of one case that no other beats in error and time; the fastest first."""
    best: list[Row] = []
    for row in sorted(rows, key=lambda row: (row.time_s, row.error)):
        if not best or row.error < best[-1].error:
            best.append(row)
    return best


def cells_of(row: Row) -> tuple[str, ...]:
    """Return a row as text, by `COLUMNS`."""
    time_ms = 1e3 * row.time_s
    time = f"{time_ms:.0f}" if time_ms >= _LONG_MS else f"{time_ms:.3g}"
    return row.case, row.way, f"{row.error:.1e}", time


def table_text(rows: Sequence[Row]) -> str:
    """Return the rows as a table of Markdown, in columns."""
    columns = list(zip(COLUMNS, ("---", "---", "---:", "---:"), *map(cells_of, rows), strict=True))
    for k, put in enumerate((str.ljust, str.ljust, str.rjust, str.rjust)):
        columns[k] = tuple(put(cell, max(map(len, columns[k]))) for cell in columns[k])
    return "".join(f"| {' | '.join(line)} |\n" for line in zip(*columns, strict=True))


def table_csv(rows: Sequence[Row]) -> str:
    """Return the rows as CSV with a header; numbers are not rounded."""
    return csv_text([field.name for field in fields(Row)], map(astuple, rows))


#: Errors beyond these are drawn at the edge.
LEAST_ERROR, MOST_ERROR = 1e-17, 10.0
_EXTRA = "bench"
_COLUMNS, _PANEL_INCHES = 4, 2.4


def write_plots(rows: Sequence[Row], stem: Path) -> None:
    """Write ``stem`` + ".svg" and ".png"; the same rows give the same files.

    Raises
    ------
    MissingExtraError
        matplotlib is not installed; the message holds the line to type.
    StorageError
        A file cannot be written.
    """
    new_figure = package_of_extra("matplotlib.figure", _EXTRA).Figure
    with style():
        names = list(dict.fromkeys(row.case for row in rows))
        lines = -(-len(names) // _COLUMNS)
        size = _COLUMNS * _PANEL_INCHES, (lines + 0.5) * _PANEL_INCHES
        figure = new_figure(figsize=size, layout="constrained")
        panels = figure.subplots(lines, _COLUMNS, squeeze=False, sharey=True).flat
        for panel in panels[len(names) :]:
            panel.remove()
        shown_ms = [1e3 * row.time_s for row in rows]
        for panel, name in zip(panels, names, strict=False):
            _draw(panel, [row for row in rows if row.case == name])
            panel.set_xlim(0.5 * min(shown_ms), 2.0 * max(shown_ms))
        figure.supylabel("largest error over the largest exact value")
        handles = {h.get_label(): h for panel in figure.axes for h in panel.get_lines()[1:]}
        figure.legend(handles=list(handles.values()), loc="outside lower center", ncols=_COLUMNS)
        for kind, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
            content = BytesIO()
            figure.savefig(content, format=kind, metadata=metadata)
            write_bytes(stem.with_suffix(f".{kind}"), content.getvalue())


def _draw(panel: Any, rows: Sequence[Row]) -> None:
    best = best_of(rows)
    times, errors = [1e3 * row.time_s for row in best], [_shown(row) for row in best]
    panel.plot(times, errors, color="#CCCCCC", linewidth=3.0, drawstyle="steps-post")
    for row, colour in zip(rows, COLOURS, strict=False):
        panel.plot(1e3 * row.time_s, _shown(row), "o", color=colour, label=row.way)
    panel.set(title=rows[0].case, xlabel="fastest run, ms", xscale="log", yscale="log")
    panel.set_ylim(LEAST_ERROR, MOST_ERROR)


def _shown(row: Row) -> float:
    return min(max(row.error, LEAST_ERROR), MOST_ERROR)
