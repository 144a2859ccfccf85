"""Labels have at most four words, hints twelve; errors two sentences, and say what to do."""

import re
import tomllib
from collections import Counter

from benchmarks.strings import ROOT, Found, strings_of_users

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


def test_menus_that_texts_name_exist():
    menus = tomllib.loads((ROOT / "resources/actions.toml").read_text("utf-8"))
    known = {
        f"{menu} > {each['text'].rstrip('…')}" for menu in menus for each in menus[menu].values()
    }
    known |= {"View > Panels", "View > Present"}  # what tables of panels and workspaces make
    files = [ROOT / "README.md", *ROOT.glob("docs/*.md"), *ROOT.glob("data/presets/*")]
    texts = [each.text for each in strings_of_users()]
    texts += [" ".join(path.read_text("utf-8").split()) for path in files]
    named = [
        named
        for text in texts
        for named in re.findall(rf"\b(?:{'|'.join(menus)}) > [A-Z].{{0,30}}", text)
    ]
    assert len(named) > 30
    assert [each for each in named if not each.startswith(tuple(known))] == []
