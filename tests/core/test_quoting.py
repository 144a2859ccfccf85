import ast
from pathlib import Path

import pytest

import skinsource
from skinsource.base.errors import MOST_CHARACTERS, counted, printable, quoted


class Strange:
    def __repr__(self):
        return "strange\x1b[31m\n" * 1000


STRANGE = [
    "x" * 10**6,
    "\x1b[2J" * 1000,
    b"\xff\x00" * 10**6,
    10**5000,
    [["a" * 100] * 100] * 100,
    Strange(),
    ("\u202e", "\ud800"),
]


@pytest.mark.parametrize("value", STRANGE, ids=range(len(STRANGE)))
def test_a_quotation_is_short_and_can_be_printed(value):
    for text in (quoted(value), printable(str(value) if type(value) is not int else "1")):
        assert 1 <= len(text) <= MOST_CHARACTERS
        assert text.isprintable()


@pytest.mark.parametrize("value", [1, -0.5, None, True, "upstream", (1.0, 2.0), [3], b"ab", "é"])
def test_what_is_short_is_quoted_whole(value):
    assert quoted(value) == repr(value)


def test_a_cut_can_be_seen():
    assert quoted("x" * 81).endswith("…")
    assert printable("a" * 80) == "a" * 80
    assert printable("a" * 81) == "a" * 79 + "…"


def test_of_several_things_the_noun_is_plural():
    clips = [counted(n, "clip") for n in (0, 1, 2, 31)]
    assert clips == ["0 clips", "1 clip", "2 clips", "31 clips"]
    assert [counted(n, "axis", "axes") for n in (1, 3)] == ["1 axis", "3 axes"]


def test_commands_for_a_terminal_are_written_out():
    assert printable("Not\x1b[31m found\r\nhere") == "Not\\x1b[31m found here"


def test_every_message_of_the_library_quotes_in_this_way():
    """Python's own way of quoting in a text (``!r``) has no limit."""
    places = []
    for path in sorted(Path(skinsource.__file__).parent.rglob("*.py")):
        nodes = ast.walk(ast.parse(path.read_text("utf-8")))
        raised = [part for node in nodes if isinstance(node, ast.Raise) for part in ast.walk(node)]
        formatted = [part for part in raised if isinstance(part, ast.FormattedValue)]
        quotes = [part for part in formatted if part.conversion == ord("r")]
        places += [f"{path.name}:{quote.lineno}" for quote in quotes]
    assert places == []
