"""The table of promises in ``docs``: each is measured by a test, and kept by what was measured."""

from pathlib import Path

import pytest


def test_the_numbers_in_the_table_keep_their_promises(documented):
    for key, _, promise, value, margin in documented.values():
        assert float(value) <= float(promise), key
        if float(value) == 0:
            assert margin == "exact", key
        else:
            times = float(margin.removesuffix("×").replace(" ", ""))
            assert times == pytest.approx(float(promise) / float(value), rel=0.06), key


def test_every_promise_is_measured_by_a_test(documented):
    paths = Path(__file__).parent.glob("test_stability_*.py")
    text = "".join(path.read_text(encoding="utf-8") for path in paths)
    assert [key for key in documented if f'"{key}"' not in text] == []
