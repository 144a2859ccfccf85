"""The table of promises in ``docs``: it is made by the tests, and names all that they promise."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CELLS = re.compile(r"^\| (\w+ [^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)


@pytest.fixture(scope="module")
def committed(request) -> list[tuple[str, ...]]:
    if request.config.getoption("--stability-table", default=None):
        pytest.skip("the table is being made")
    text = (ROOT / "docs" / "stability.md").read_text(encoding="utf-8")
    return [tuple(row) for row in CELLS.findall(text)]


def test_the_table_lists_the_cases_of_the_tests_with_their_promises(committed, promises):
    listed = [(key, what, float(promise)) for key, what, promise, _, _ in committed]
    stated = [(key, what, float(promise)) for key, (what, promise) in promises.items()]
    assert listed == stated, "make it again: see the head of docs/stability.md"


def test_the_numbers_in_the_table_keep_their_promises(committed):
    for key, _, promise, value, margin in committed:
        assert float(value) <= float(promise), key
        assert margin != "BROKEN"


def test_every_promise_is_measured_by_a_test(promises):
    sources = [path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_*.py")]
    used = set(re.findall(r'noted\(\s*"([^"]+)"', "".join(sources)))
    assert used == set(promises)
