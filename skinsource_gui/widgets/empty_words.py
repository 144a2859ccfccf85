"""What an empty panel says can be done: always something that works with the panels in sight."""

from skinsource_gui.widgets.keys import shortcut_text

#: Names of the panels that the words are about.
HAND, TIMELINE, SKIN = "hand", "timeline", "skin"
#: What is taken to be in sight until somebody says.
USUALLY_IN_SIGHT = frozenset({HAND, TIMELINE, SKIN})


def add_words(in_sight: frozenset[str], what: str = "an input") -> str:
    """How to add ``what``: an input, or a track, as the timeline calls it."""
    if HAND in in_sight:
        return f"Click a place on the hand to add {what}"
    return f"Press {shortcut_text('add_input')} to add {what}"


def select_words(in_sight: frozenset[str]) -> str:
    """How to select an input, where there are some."""
    ways = [
        words
        for name, words in ((HAND, "on the hand"), (TIMELINE, "in the timeline"))
        if name in in_sight
    ]
    if not ways:
        return "Show the timeline or the hand (View > Panels) to select an input"
    return f"Select an input, {' or '.join(ways)}, to edit it"


def clip_words(in_sight: frozenset[str], *, inputs: bool) -> str:
    """How to get at a clip; ``inputs``: whether there are some."""
    if not inputs:
        return add_words(in_sight)
    if TIMELINE in in_sight:
        return "Select a clip in the timeline to see and draw it"
    if HAND in in_sight:
        return "Select an input on the hand to see and draw its clip"
    return "Show the timeline (View > Panels) to select a clip"


def output_words(in_sight: frozenset[str]) -> str:
    """How to select outputs."""
    if SKIN in in_sight:
        return "Select outputs on the skin map"
    return "Show the skin map (View > Panels) to select outputs"
