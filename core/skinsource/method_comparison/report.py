"""The page of text: what was measured, which promises hold, and every figure."""

from collections.abc import Iterable, Sequence
from textwrap import dedent

from skinsource.decibels import decibels
from skinsource.method_comparison.accuracy import QUIETEST
from skinsource.method_comparison.every_scene import any_scene, is_ours
from skinsource.method_comparison.machine import Fact
from skinsource.method_comparison.measure import Effort
from skinsource.method_comparison.pareto import pareto_front
from skinsource.method_comparison.signal_scenes import SignalScene
from skinsource.method_comparison.table import Row
from skinsource.method_comparison.timing import ONCE_FROM_S

# Long times are written without a power of ten.
_WHOLE_FROM = 1000.0
_HEADINGS = (
    "engine",
    "precision",
    "setting",
    "fastest ms",
    "median ms",
    "first ms",
    "worst window",
    "of the peak",
    "L2",
    "ratio",
    "memory MB",
    "promise",
)


def report_of(
    rows: Sequence[Row], facts: Iterable[Fact], effort: Effort, *, n_cases: int | None = None
) -> str:
    """Return the report as Markdown.

    Parameters
    ----------
    rows, facts, effort
        What was measured, on what, and how.
    n_cases
        How many rows there would be, where measuring was stopped; None: it was not.
    """
    keys = list(dict.fromkeys(row.scene for row in rows))
    parts = [
        "# Error against run time",
        "\n".join(f"- {fact.name}: {fact.value}" for fact in facts),
        *([] if n_cases is None else [_stopped(rows, n_cases)]),
        "## Promises",
        _promises(rows),
    ]
    for key in keys:
        parts += _scene([row for row in rows if row.scene == key])
    parts += ["## What could not be measured", _failures(rows)]
    parts += ["## How to read this", _how_to_read(effort)]
    return "\n\n".join(parts) + "\n"


def _stopped(rows: Sequence[Row], n_cases: int) -> str:
    fewest = min((row.processes for row in rows if not row.failure), default=0)
    return (
        f"**Stopped before the end:** {len(rows)} of {n_cases} rows are there, each from "
        f"{fewest} fresh process(es) or more."
    )


def _promises(rows: Sequence[Row]) -> str:
    ours = [row for row in rows if is_ours(row.engine) and row.promise != "none"]
    measured = [row for row in ours if not row.failure]
    broken = [row for row in measured if row.promise != "kept"]
    others = [row for row in rows if row not in ours and row.promise.startswith("broken")]
    if broken:
        lines = [f"This program breaks {len(broken)} of {len(measured)} rows' promises:"]
        lines += [_line(row, row.promise.removeprefix("broken: ")) for row in broken]
    else:
        lines = [f"This program keeps every promise in all {len(measured)} rows measured."]
    if others:
        lines += ["", "Other engines, held to the same errors:"]
        lines += [_line(row, row.promise.removeprefix("broken: ")) for row in others]
    return "\n".join(lines)


def _scene(rows: Sequence[Row]) -> list[str]:
    scene = any_scene(rows[0].scene)
    measured = sorted((row for row in rows if not row.failure), key=lambda row: row.t_min_ms or 0.0)
    front = pareto_front(rows)
    if isinstance(scene, SignalScene):
        about = (
            f"{scene.response_samples} samples; exact values from {scene.reference}; promised "
            f"error {scene.allowed_error:.2g} of the peak."
        )
    else:
        about = (
            f"{scene.active_inputs} of {scene.n_inputs} inputs change between two runs; "
            f"{scene.response_samples} samples of response."
        )
    table = [_table_row(_HEADINGS), _table_row(["---"] * len(_HEADINGS))]
    table += [_table_row(_cells(row, row in front)) for row in measured]
    return [f"## {scene.key}: {scene.title}", about, "\n".join(table)]


def _cells(row: Row, on_front: bool) -> list[str]:
    mark = "**" if on_front else ""
    spread = "" if row.stable else " unstable"
    return [
        f"{mark}{row.engine}{mark}",
        row.precision,
        row.setting,
        _number(row.t_min_ms, ".3g"),
        f"{_number(row.t_median_ms, '.3g')} ± {_number(row.t_mad_ms, '.2g')}{spread}",
        _number(row.t_first_ms, ".3g"),
        _number(row.err_window, ".1e"),
        _number(row.err_max, ".1e"),
        _number(row.err_l2, ".1e"),
        _number(row.ratio, ".2g") if _has_ratio(row) else "",
        _number(row.peak_mb, ".0f"),
        "broken" if row.promise.startswith("broken") else row.promise,
    ]


def _has_ratio(row: Row) -> bool:
    """Only for convolutions the rounding that cannot be helped is known."""
    return row.promise != "none" and not isinstance(any_scene(row.scene), SignalScene)


def _failures(rows: Sequence[Row]) -> str:
    failed = [_line(row, row.failure) for row in rows if row.failure]
    return "\n".join(failed) or "Every method computed every scene."


def _how_to_read(effort: Effort) -> str:
    quietest_db = float(decibels(QUIETEST))
    text = f"""\
        Every row was measured in {effort.processes} fresh process(es), those of scenes S5, A and R
        in one, all rows of a round in random order; in each process at most {effort.most_runs} runs
        or {effort.longest_s:g} s, after up to {effort.warm_ups} runs that do not count. What runs
        for {ONCE_FROM_S:g} s or longer is run once.
        *fastest* is the least disturbed figure; the median stands with its median absolute
        deviation; *first* is preparation and first run together. A row is *unstable* where 95 %
        of the runs took up to more than three times the fastest. *memory* is what the process
        held above idle, without drives that the program would have drawn itself.

        All rows but *map and 6 traces* give all 216 channels in time. Between two runs the
        drives change, so nothing but the spectra of the responses can be kept. *predict()* is one
        call of the library, which keeps nothing. Responses and drives are made up in whole
        numbers, without the normalisation of inputs.

        Errors are against exact values, computed in fractions without rounding, at 8 samples of
        each of up to 24 windows of 100 ms, the largest sample of each window among them, in 12
        channels. *worst window*: largest error in a window over that window's own peak, for
        windows down to {-quietest_db:.0f} dB below the channel's peak. *of the peak*: over the
        channel's peak. *ratio*: error over eps log2(n) sum ||x|| ||h||.

        Scenes A are actuators after a step of the voltage: acceleration, velocity, displacement
        and current, each over its own peak. Scenes R are signals at another sample rate. There
        all samples are compared, with exact values from elsewhere, and there is no *ratio*.

        Rows in **bold** are those that nothing else beats in both time and worst window.
        Settings that trade error for time (*cut*, *rank*) promise nothing."""
    return dedent(text)


def _line(row: Row, words: str) -> str:
    return f"- {row.scene}, {row.engine}, {row.precision}, {row.setting}: {words}"


def _table_row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _number(value: float | None, form: str) -> str:
    if value is None:
        return ""
    return format(value, ".0f" if value >= _WHOLE_FROM else form)
