"""The graph of quantities: what runs, what is remembered and refused, and its tables."""

import weakref
from pathlib import Path

import numpy as np
import pytest

from benchmarks.graph_tables import updated
from skinsource.engine.graph import Graph


def doubled(number):
    return 2 * number


def squared(number):
    return number**2


def total(doubled, squared):
    return doubled + squared


def vector(number):
    return np.arange(float(number))


def length(vector):
    return len(vector)


def pair(number):
    return np.arange(3.0), np.full(2, float(number))


def pair_total(pair):
    return sum(part.sum() for part in pair)


def test_what_is_wanted_comes_out():
    graph = Graph(total, squared, doubled)
    assert graph.evaluate(["total"], {"number": 3}) == {"total": 15}
    assert graph.evaluate([], {"number": 3}) == {}
    assert graph.evaluate(iter(["doubled", "number"]), {"number": 4}) == {"doubled": 8, "number": 4}


class Made:
    """Holds what it was made of; equal to nothing else."""

    def __init__(self, large):
        self.large = large


@pytest.mark.parametrize(("size", "are_gone"), [(2**17, True), (2**10, False)])
def test_a_large_array_is_freed_before_it_is_computed_again_with_all_that_holds_it(size, are_gone):
    held, gone = [], []

    def large(number):
        gone.append([old() is None for old in held])
        return np.full(size, float(number))

    def made(large):
        return Made(large)

    graph = Graph(large, made)
    values = graph.evaluate(["large", "made"], {"number": 1})
    held += [weakref.ref(values.pop("large")), weakref.ref(values.pop("made"))]
    graph.evaluate(["made"], {"number": 2})
    assert gone == [[], [are_gone] * 2]


def test_tuples_of_arrays_are_compared_part_by_part():
    graph = Graph(pair_total)
    first, other = np.arange(3.0), np.ones(2)
    graph.evaluate(["pair_total"], {"pair": (first, other)})
    graph.evaluate(["pair_total"], {"pair": (first, other)})
    assert graph.runs["pair_total"] == 1
    graph.evaluate(["pair_total"], {"pair": (first, other.copy())})
    graph.evaluate(["pair_total"], {"pair": (first,)})
    assert graph.runs["pair_total"] == 3


@pytest.mark.parametrize(("old", "new"), [(1, 1.0), (1, True), (0, False), ((1, 2), (1, 2.0))])
def test_equal_values_of_different_types_are_different(old, new):
    graph = Graph(text)
    assert graph.evaluate(["text"], {"value": old}) == {"text": repr(old)}
    assert graph.evaluate(["text"], {"value": new}) == {"text": repr(new)}


def text(value):
    return repr(value)


def test_results_cannot_be_written_to():
    result = Graph(vector, pair).evaluate(["vector", "pair"], {"number": 4})
    for array in (result["vector"], *result["pair"]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_an_array_goes_before_the_next_one_is_made():
    alive = []

    def large(size: int) -> np.ndarray:
        alive.append([reference() is not None for reference in references])
        made = np.zeros(size)
        references.append(weakref.ref(made))
        return made

    references: list = []
    graph = Graph(large)
    for size in (3, 4, 5):
        graph.evaluate({"large"}, {"size": size})
    assert alive == [[], [False], [False, False]]


def test_results_that_nobody_can_use_again_go_and_others_stay():
    graph = Graph(vector, length, pair, pair_total)
    whole = graph.evaluate(["vector", "length", "pair_total"], {"number": 3, "other": 1})
    held = weakref.ref(whole.pop("vector"))
    graph.evaluate(["pair_total"], {"number": 3, "other": 2})
    assert held() is not None
    graph.evaluate(["length"], {"number": 3, "other": 2})
    assert graph.runs == {"vector": 1, "length": 1, "pair": 1, "pair_total": 1}
    graph.evaluate(["pair_total"], {"number": 4, "other": 2})
    assert held() is None


DOCUMENT = Path(__file__).parents[2] / "docs" / "internals" / "rendering.md"


def test_the_document_shows_the_graph_as_it_is():
    text = DOCUMENT.read_text(encoding="utf-8")
    assert updated(text) == text, (
        "docs/internals/rendering.md shows another graph; run "
        "python benchmarks/graph_tables.py docs/internals/rendering.md"
    )
