"""The drawings of the graph in the documents are those of the graph."""

from pathlib import Path

import pytest

from skinsource.cli.graph_drawing import drawing, rules_of, table, updated
from skinsource.engine.graph import Graph
from skinsource.engine.quantities import new_graph, sources

DOCUMENT = Path(__file__).parents[2] / "docs" / "internals" / "rendering.md"


def total(parts, weights):
    """Sum of the parts."""
    return parts + weights


def level(total, floor):
    """Level of the sum.

    And more words.
    """
    return total + floor


def test_a_drawing_shows_rules_what_they_need_and_what_comes_from_elsewhere():
    graph = Graph(level, total)
    assert rules_of(graph, ["level"]) == ("total", "level")
    drawn = drawing(graph, ["total", "level"])
    assert "parts --> total" in drawn
    assert "total --> level" in drawn
    assert "floor([floor])" in drawn
    assert "total([" not in drawn
    assert "| `level` | Level of the sum. |" in table(graph, ["total", "level"])


def test_the_document_shows_the_graph_as_it_is():
    text = DOCUMENT.read_text(encoding="utf-8")
    assert updated(text) == text, (
        "docs/internals/rendering.md shows another graph; run "
        "python -m skinsource.cli.graph_drawing docs/internals/rendering.md"
    )


@pytest.mark.parametrize("quantities", ["surface_levels_db", "selected_spectra", "trace_error"])
def test_what_is_drawn_is_what_runs(quantities):
    from skinsource.design.design import Design, track
    from skinsource.design.view import View

    graph = new_graph()
    design = Design(limb="synthetic-1", inputs=(track(7),))
    graph.evaluate({quantities}, sources(design, View()))
    assert set(graph.runs) == set(rules_of(graph, [quantities]))
