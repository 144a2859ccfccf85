"""Files of version 1 are read by a process of their own, which may crash or hang."""

import sys
from pathlib import Path

import pytest

from skinsource.codec import image
from skinsource.design_file import VERSION, open_design, version_1, version_1_process
from skinsource.design_file.version_1_child import answer
from skinsource.errors import FileFormatError, InvalidInputError, StorageError

STORED = Path(__file__).parents[2] / "references" / "designs-v1" / "every-kind.skinsource"


def python(code):
    return (sys.executable, "-c", code)


def test_what_the_process_finds_is_what_is_in_the_file_and_this_one_reads_no_byte(monkeypatch):
    design, view, layout = version_1.content_of(STORED.read_bytes())

    def refuse(*_):
        raise AssertionError("read in this process")

    monkeypatch.setattr(version_1, "content_of", refuse)
    content = open_design(STORED)
    assert (content.design, content.view, content.layout) == (design, view, layout)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("import os; os.abort()", "reading it crashed"),
        ("raise SystemExit(3)", "reading it crashed"),
        ("print('something else')", "reading it crashed"),
        ("import time; time.sleep(600)", "reading it takes too long"),
    ],
)
def test_a_process_that_crashes_or_hangs_makes_a_damaged_file(code, words):
    longest_s = 2.0 if "sleep" in code else 60.0
    with pytest.raises(FileFormatError, match=words):
        version_1_process.as_today(STORED.read_bytes(), python(code), longest_s)


@pytest.mark.parametrize(
    ("word", "kind"), [("damaged", FileFormatError), ("refused", InvalidInputError)]
)
def test_its_sentence_is_ours(word, kind):
    with pytest.raises(kind, match=r"^This and that\.$"):
        version_1_process.as_today(
            STORED.read_bytes(), python(f"print('{word}\\nThis and that.', end='')")
        )


def test_where_no_process_can_be_started_the_file_is_not_called_damaged():
    with pytest.raises(StorageError, match="no other process can be started"):
        version_1_process.as_today(STORED.read_bytes(), ("/nowhere/at/all",))


def test_for_what_cannot_be_such_a_file_none_is_started():
    with pytest.raises(FileFormatError, match="not a SkinSource design"):
        version_1_process.as_today(b"something else", ("/nowhere/at/all",))


def test_a_damaged_answer_is_refused_like_any_damaged_file(monkeypatch):
    today = answer(STORED.read_bytes())
    assert today.startswith(version_1_process.FOUND)
    content = bytearray(today.removeprefix(version_1_process.FOUND))
    assert image.from_image(bytes(content), VERSION)
    content[len(content) // 2] ^= 1
    with pytest.raises((FileFormatError, InvalidInputError)):
        image.from_image(bytes(content), VERSION)
