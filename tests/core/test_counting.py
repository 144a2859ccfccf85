"""One is said of one, and several of several."""

import pytest

from skinsource.base.work import counted


@pytest.mark.parametrize(
    ("count", "text"), [(0, "0 clips"), (1, "1 clip"), (2, "2 clips"), (31, "31 clips")]
)
def test_only_one_is_called_as_one(count, text):
    assert counted(count, "clip") == text


def test_words_before_a_noun_stay_as_they_are():
    assert [counted(n, "more clip") for n in (1, 2)] == ["1 more clip", "2 more clips"]


def test_a_noun_may_have_a_plural_of_its_own():
    assert [counted(n, "axis", "axes") for n in (1, 3)] == ["1 axis", "3 axes"]
