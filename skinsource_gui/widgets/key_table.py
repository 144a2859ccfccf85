"""The keys of the widgets in the panels, in one table: the keys page is made from it.

What a widget does with its keys stands beside the widget; a test asks each widget which keys it
takes, and compares.  The keys of actions stand in the table of actions.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class KeyHint:
    """Keys that mean the same, or nearly so.

    Attributes
    ----------
    words
        What a reader calls them.
    means
        What they do.
    keys
        All of them, as Qt writes them.
    """

    words: str
    means: str
    keys: tuple[str, ...]


_ARROWS = ("Left", "Right", "Up", "Down")
_ENTER = ("Return", "Enter", "Space")

#: By the place where they work: name of a widget, heading on the keys page, and its keys.
WIDGET_KEYS: dict[str, tuple[str, tuple[KeyHint, ...]]] = {
    "hand": (
        "On the hand",
        (
            KeyHint(words="Arrow keys", means="move the ring from place to place", keys=_ARROWS),
            KeyHint(
                words="1 to 20, Home, End",
                means="move the ring to the place of that number, to the first, to the last",
                keys=(*(str(digit) for digit in range(10)), "Home", "End"),
            ),
            KeyHint(
                words="Enter or Space",
                means="place an input at the ring, or select the one that is there",
                keys=_ENTER,
            ),
            KeyHint(
                words="Insert, +, or Shift or Ctrl and Enter",
                means="one more input at the same place",
                keys=(
                    *("+", "Ins", "Shift++", "Shift+Ins"),
                    *(f"{held}+{key}" for key in _ENTER for held in ("Shift", "Ctrl")),
                    *(f"Ctrl+Shift+{key}" for key in _ENTER),
                ),
            ),
            KeyHint(
                words="Shift and arrow keys",
                means="move the selected inputs",
                keys=tuple(f"Shift+{key}" for key in _ARROWS),
            ),
            KeyHint(words="Ctrl+A", means="select all inputs", keys=("Ctrl+A",)),
            KeyHint(words="Delete", means="remove the selected inputs", keys=("Del", "Backspace")),
        ),
    ),
    "inputs": (
        "In the list of inputs",
        (
            KeyHint(
                words="Up, Down, Home, End",
                means="go to another input; with Shift select those on the way",
                keys=tuple(
                    f"{held}{key}"
                    for key in ("Up", "Down", "Home", "End")
                    for held in ("", "Shift+")
                ),
            ),
            KeyHint(words="Alt+Up, Alt+Down", means="reorder", keys=("Alt+Up", "Alt+Down")),
            KeyHint(words="M, S", means="mute, solo", keys=("M", "S")),
            KeyHint(words="Enter", means="type the amplitude", keys=("Return", "Enter", "F2")),
            KeyHint(words="Ctrl+A", means="select all inputs", keys=("Ctrl+A",)),
            KeyHint(words="Ctrl+D", means="duplicate the selected inputs", keys=("Ctrl+D",)),
            KeyHint(words="Delete", means="remove the selected inputs", keys=("Del", "Backspace")),
        ),
    ),
    "skin": (
        "On the skin map",
        (
            KeyHint(words="Arrow keys", means="move the ring from output to output", keys=_ARROWS),
            KeyHint(
                words="Enter or Space",
                means="select the output in the ring; with Shift add it, or take it away",
                keys=_ENTER,
            ),
            KeyHint(words="Ctrl+A, Esc", means="select all outputs, none", keys=("Ctrl+A", "Esc")),
            KeyHint(words="0, H", means="show hand and arm, the hand alone", keys=("0", "H")),
        ),
    ),
    "plot": (
        "In a plot",
        (
            KeyHint(
                words="Left, Right, Home, End",
                means="move the crosshair; Esc takes it away",
                keys=("Left", "Right", "Home", "End", "Esc"),
            ),
            KeyHint(words="+ and −", means="zoom at the crosshair", keys=("+", "-", "=")),
            KeyHint(words="0", means="show everything", keys=("0", "A")),
        ),
    ),
}
