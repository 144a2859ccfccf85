"""The same words for the same things, in the window, on the command line and in files."""

import doctest
from dataclasses import replace
from pathlib import Path

import pytest

from skinsource import choice_words
from skinsource.limb import LIMB_NAMES
from skinsource.loudest_window import SPANS
from skinsource.projection import AXES, METHODS
from skinsource.scaling.response_scaling import SCALINGS

PAGE = Path(__file__).parents[2] / "docs" / "words.md"


def table():
    """The table of the page, made from the words themselves."""
    lines = ["| in files | in the window | means |", "|---|---|---|"]
    for field, title, sentence, options in choice_words.CHOICES:
        lines.append(f"| **`{field}`** | **{title}** | {sentence} |")
        lines += [f"| `{word.name}` | {word.title} | {word.sentence} |" for word in options]
    return "\n".join(lines)


def test_the_page_of_words_shows_them_as_they_are():
    assert table() in PAGE.read_text("utf-8")


def test_where_there_is_little_room_only_a_published_limb_is_called_less(monkeypatch):
    assert choice_words.short_limb_title("synthetic-1") == "Synthetic 1"
    own = replace(choice_words.facts_of("synthetic-1"), title="Foot (left)")
    monkeypatch.setattr(choice_words, "facts_of", lambda name: own)
    assert choice_words.short_limb_title("foot") == "Foot (left)"


@pytest.mark.parametrize(
    ("options", "names"),
    [
        (choice_words.LIMBS, LIMB_NAMES),
        (choice_words.SCALINGS, SCALINGS),
        (choice_words.AXES, AXES),
        (choice_words.METHODS, METHODS),
        (choice_words.SPANS, SPANS),
    ],
)
def test_every_value_of_a_choice_has_a_title_and_a_sentence(options, names):
    assert tuple(word.name for word in options) == names
    assert len({word.title for word in options}) == len(names)
    assert all(word.sentence.endswith(".") for word in options)


def test_examples_in_the_docstrings_are_true():
    assert doctest.testmod(choice_words).failed == 0


def test_words_of_something_unknown_are_its_name():
    assert choice_words.word_of(choice_words.METHODS, "new").both == "new"
    assert choice_words.word_of(choice_words.METHODS, "pca").both == "Principal axis (pca)"


def test_a_signal_is_named_by_its_axes_and_unless_there_is_one_by_its_method():
    assert choice_words.signal_words("xyz", "rms") == "x, y, z, RMS direction"
    assert choice_words.signal_words("y", "rms") == "y"


def test_a_level_says_what_it_is_the_rms_over():
    assert choice_words.level_words("record") == "RMS over the whole record"
    assert choice_words.level_words("loudest") == "RMS over the loudest 100 ms"
