"""The table of promises in ``docs``: it is made by the tests, and names all that they promise.

That its numbers are those of this machine too is seen where they are measured (``noted``).
"""

import re
from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _only_of_a_table_that_is_there(request):
    if request.config.getoption("--stability-table", default=None):
        pytest.skip("the table is being made")


def test_the_table_lists_the_cases_of_the_tests_with_their_promises(documented, promises):
    listed = [(key, what, float(promise)) for key, what, promise, _, _ in documented.values()]
    stated = [(key, what, float(promise)) for key, (what, promise) in promises.items()]
    assert listed == stated, "make it again: see the head of docs/stability.md"


def test_the_numbers_in_the_table_keep_the_promises_of_the_tests(documented, promises):
    for key, (_, promise) in promises.items():
        _, _, _, value, margin = documented[key]
        assert float(value) <= promise, key
        if float(value) == 0:
            assert margin == "exact", key
        else:
            times = float(margin.removesuffix("×").replace(" ", ""))
            assert times == pytest.approx(promise / float(value), rel=0.06), key


def test_every_promise_is_measured_by_a_test(promises):
    sources = [path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_*.py")]
    used = set(re.findall(r'noted\(\s*"([^"]+)"', "".join(sources)))
    assert used == set(promises)
