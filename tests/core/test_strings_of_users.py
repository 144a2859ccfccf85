"""Labels have at most four words, hints twelve; errors two sentences, and say what to do."""

import re
from collections import Counter

from tests.nightly.strings import Found, strings_of_users

#: Parts of longer messages, and words in figures of the paper, where there is room for them.
EXCEPTIONS = re.compile(
    r"the (text is not what|encoder wrote|content) |reading it crashed|of a number|"
    r"\{\}: \{\} Nothing was|r = 0.99|each row relative to its peak|magnitude, dB re"
)


def test_strings_keep_their_limits():
    found = [each for each in strings_of_users() if not EXCEPTIONS.match(each.text)]
    # What reads the code still finds them.
    kinds = Counter(each.kind for each in found)
    assert all(kinds[kind] > 100 for kind in ("label", "help", "error", "heading"))
    assert kinds["tooltip"] > 300
    assert [each for each in found if each.faults()] == []


def test_faults_are_found():
    assert Found("a.py:1", "label", "Show all of the arm").faults() == ["5 words"]
    assert Found("a.py:1", "tooltip", "word " * 13).faults() == ["13 words"]
    too_long = Found("a.py:1", "error", "That failed. Really. {} is wrong.")
    assert too_long.faults() == ["3 sentences", "no cure"]
    assert Found("a.py:1", "message", "what plays is kept").faults() == ["what plays", "kept"]
