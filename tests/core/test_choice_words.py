"""The same words for the same things, in the window, on the command line and in files."""

from pathlib import Path

import pytest

from skinsource.base.conventions import AXES, LIMB_NAMES
from skinsource.design import labels
from skinsource.limbs.scaling import SCALINGS
from skinsource.signals.loudest_window import SPANS
from skinsource.signals.projection import METHODS

PAGE = Path(__file__).parents[2] / "docs" / "words.md"


def table():
    """The table of the page, made from the words themselves."""
    lines = ["| in files | in the window | means |", "|---|---|---|"]
    for field, title, sentence, options in labels.CHOICES:
        lines.append(f"| **`{field}`** | **{title}** | {sentence} |")
        lines += [f"| `{word.name}` | {word.title} | {word.sentence} |" for word in options]
    return "\n".join(lines)


def test_the_page_of_words_shows_them_as_they_are():
    assert table() in PAGE.read_text("utf-8")


@pytest.mark.parametrize(
    ("options", "names"),
    [
        (labels.LIMBS, LIMB_NAMES),
        (labels.SCALINGS, SCALINGS),
        (labels.AXES, AXES),
        (labels.METHODS, METHODS),
        (labels.SPANS, SPANS),
    ],
)
def test_every_value_of_a_choice_has_a_title_and_a_sentence(options, names):
    assert tuple(word.name for word in options) == names
    assert len({word.title for word in options}) == len(names)
    assert all(word.sentence.endswith(".") for word in options)
