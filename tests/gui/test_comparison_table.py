"""The rows of a benchmark, as the page shows them."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt

from skinsource.method_comparison.table import Row
from skinsource_gui.accuracy_page.bench_table import BenchTable, verdict
from skinsource_gui.theme import DARK

KEPT = Row(
    scene="S1",
    engine="this program",
    precision="float64",
    setting="all channels",
    inputs_changed=1,
    inputs=1,
    samples=1171,
    reference="S1",
    t_min_ms=2.0,
    t_median_ms=3.0,
    t_mad_ms=0.5,
    err_window=1e-12,
    err_max=1e-16,
    promise="kept",
)
BROKEN = replace(KEPT, promise="broken: error of the peak 2e-14, promised 1e-14")
FAILED = replace(KEPT, engine="direct", t_min_ms=None, err_window=None, failure="too long")
SLOWER = replace(KEPT, engine="oaconvolve", t_min_ms=10.0)
_Role = Qt.ItemDataRole


@pytest.fixture
def shown(qtmodeltester, use_theme):
    """Show rows in a table that Qt itself has looked through."""

    def show(*rows):
        model = BenchTable()
        model.show_rows(rows)
        use_theme(DARK)
        qtmodeltester.check(model)
        return model

    return show


def test_a_broken_promise_is_red_and_says_which(shown):
    model = shown(BROKEN)
    promise = model.index(0, 9)
    assert promise.data() == "broken"
    assert promise.data(_Role.ForegroundRole).name() == DARK.error
    assert "promised 1e-14" in promise.data(_Role.ToolTipRole)


def test_a_method_that_failed_stays_listed_and_says_why(shown):
    model = shown(KEPT, FAILED)
    assert model.index(1, 4).data() == ""
    assert model.index(1, 9).data() == "failed"
    assert model.index(1, 9).data(_Role.ToolTipRole) == "too long"


def test_what_nothing_beats_is_bold(shown):
    model = shown(KEPT, SLOWER, FAILED)
    assert model.index(0, 1).data(_Role.FontRole).bold()
    assert model.index(1, 1).data(_Role.FontRole) is None
    model.sort(4, Qt.SortOrder.DescendingOrder)
    assert [model.index(row, 1).data(_Role.FontRole) is None for row in range(3)] == [
        True,
        True,
        False,
    ]


def test_the_verdict_counts_own_rows_only():
    assert verdict([KEPT, SLOWER]) == "This program keeps its promises in 1 of 1 rows."
    assert verdict([KEPT, BROKEN, FAILED]) == (
        "This program breaks its promises in 1 of 2 rows; the first: S1, all channels: error of "
        "the peak 2e-14, promised 1e-14. 1 of 3 rows could not be measured."
    )
