"""What curves say of themselves in files and pictures: whose they are, and how they were made."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from skinsource.design.labels import limb_word, signal_words
from skinsource.export.exported_design import describe_levels, describe_played, describe_projection

#: What a panel has to ask for to be able to say it.
NEEDS = frozenset(
    {
        "actuation",
        "axes",
        "inputs",
        "limb",
        "limb_data",
        "match_gain",
        "method",
        "scaling",
        "span",
    }
)


#: What is said where curves are along each axis by itself.
EACH_AXIS = "each axis of the sensors"


def lines_later(
    results: Mapping[str, Any], *first: str, each_axis: bool = False
) -> Callable[[], tuple[str, ...]]:
    """What gives lines for the head of a table: written when there is one, not at each edit."""
    return partial(_lines, {name: results[name] for name in NEEDS}, first, each_axis)


def _lines(results: Mapping[str, Any], first: tuple[str, ...], each_axis: bool) -> tuple[str, ...]:
    note, inputs = results["limb_data"].note, results["inputs"]
    return (
        *first,
        *describe_played(results["limb"], note, results["scaling"], inputs, results["actuation"]),
        f"axes: {EACH_AXIS}, by itself"
        if each_axis
        else describe_projection(results["axes"], results["method"]),
        describe_levels(results["span"]),
    )


def heading_of(results: Mapping[str, Any], *, each_axis: bool = False) -> tuple[str, ...]:
    """Parts of the heading of a picture: the caption below says what is played, and how."""
    along = f"along {EACH_AXIS}"
    words = along if each_axis else signal_words(results["axes"], results["method"])
    return limb_word(results["limb"]).title, words
