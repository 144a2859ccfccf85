"""Methods that no other method beats in both time and error."""

from collections.abc import Sequence

from skinsource.method_comparison.table import Row


def pareto_front(rows: Sequence[Row]) -> list[Row]:
    """Rows of one scene that no row equals or beats in both, fastest first; failed ones never."""
    ranked = sorted(
        (row.t_min_ms, row.err_window, k)
        for k, row in enumerate(rows)
        # An error that is not a number is not comparable.
        if row.t_min_ms is not None and row.err_window is not None and row.err_window < float("inf")
    )
    front = []
    smallest = float("inf")
    for _, error, k in ranked:
        if error < smallest:
            front.append(rows[k])
            smallest = error
    return front
