"""The line below the hand names the place that is meant, and both where there are two."""

from PySide6.QtGui import QColor

from skinsource_gui.panels.hand.layout import HandState, Mark
from skinsource_gui.panels.hand.picture import HINT, caption_of

MARKS = (Mark(site=7, colour=QColor("red")), Mark(site=13, colour=QColor("blue")))


def caption(most=200, **state):
    return caption_of(HandState(**state), "synthetic-1", lambda text: len(text) <= most)


def test_one_place_is_named_where_pointer_and_ring_agree():
    assert caption() == HINT
    assert caption(marks=MARKS) == ""
    for state in ({"selected": 0}, {"hovered": 7}, {"selected": 0, "hovered": 7}, {"cursor": 7}):
        assert caption(marks=MARKS, **state) == "7 · Digit II, pad", state
    assert caption(marks=MARKS, selected=0, most=9) == "7 · II pad"
    # What is dragged goes to the target, whatever was selected.
    assert caption(marks=MARKS, selected=0, moving=0, target=3).startswith("3 · ")
    assert caption(marks=MARKS, selected=0, hovered=3, note="No") == "No"


def test_pointer_and_ring_are_both_named_where_they_differ():
    state = {"marks": MARKS, "selected": 0, "hovered": 13}
    whole = caption(**state)
    assert whole == "Pointer: 13 · Digit III, base  |  Selected: 7 · Digit II, pad"
    short = caption(**state, most=len(whole) - 1)
    assert short.startswith("Pointer: 13 · III")
    assert short.endswith("Selected: 7 · II pad")
    assert caption(**state, most=len(short) - 1).endswith("Selected: 7")
    assert caption(**state, most=1) == "Pointer: 13  |  Selected: 7"
    # The ring of the keyboard is drawn rather than that of the selection.
    assert caption(**state, cursor=5).endswith("Keys: 5 · " + caption(cursor=5).split(" · ")[1])
