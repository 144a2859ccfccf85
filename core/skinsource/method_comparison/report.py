"""The page of text: what was measured, which promises hold, and every figure."""

from collections.abc import Iterable, Sequence

from skinsource.method_comparison.compared_limb import MADE_UP, ComparedLimb
from skinsource.method_comparison.every_scene import any_scene, is_ours
from skinsource.method_comparison.machine import Fact
from skinsource.method_comparison.measure import Effort
from skinsource.method_comparison.pareto import pareto_front
from skinsource.method_comparison.reading import how_to_read
from skinsource.method_comparison.signal_scenes import SignalScene
from skinsource.method_comparison.table import Row

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
    rows: Sequence[Row],
    facts: Iterable[Fact],
    effort: Effort,
    *,
    n_cases: int | None = None,
    bound: float | None = None,
) -> str:
    """Return the report as Markdown.

    Parameters
    ----------
    rows, facts, effort
        What was measured, on what, and how.
    n_cases
        How many rows there would be, where measuring was stopped; None: it was not.
    bound
        How far the exact values of a limb may be off, over the channel's peak; None: they are
        those that come with the program.
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
    parts += ["## How to read this", how_to_read(effort, _limb_of(rows), bound)]
    return "\n\n".join(parts) + "\n"


def _limb_of(rows: Sequence[Row]) -> ComparedLimb:
    return rows[0].limb if rows else MADE_UP


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
    scene = any_scene(rows[0].scene, rows[0].limb)
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
    return row.promise != "none" and not isinstance(any_scene(row.scene, row.limb), SignalScene)


def _failures(rows: Sequence[Row]) -> str:
    failed = [_line(row, row.failure) for row in rows if row.failure]
    return "\n".join(failed) or "Every method computed every scene."


def _line(row: Row, words: str) -> str:
    return f"- {row.scene}, {row.engine}, {row.precision}, {row.setting}: {words}"


def _table_row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _number(value: float | None, form: str) -> str:
    if value is None:
        return ""
    return format(value, ".0f" if value >= _WHOLE_FROM else form)
