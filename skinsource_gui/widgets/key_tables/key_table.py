"""The keys of the widgets in the panels, in one table: widgets, tooltips and the keys page read it.

A widget asks `meant` what a press means at its place, and does it; where it is said which key does
something, `key_text` is asked.  The keys of actions stand in the table of actions.
"""

from collections.abc import Mapping
from functools import cache

from PySide6.QtCore import QKeyCombination, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence

from skinsource_gui.widgets.key_tables.effect_keys import CURVE, EFFECTS, PARTS
from skinsource_gui.widgets.key_tables.key_hint import KeyHint
from skinsource_gui.widgets.key_tables.library_keys import LIBRARY
from skinsource_gui.widgets.key_tables.timeline_keys import (
    CLIP_EDITOR,
    GAIN_CURVE,
    PLAYHEAD,
    TIMELINE,
)

_ARROWS = ("Left", "Right", "Up", "Down")
_ENTER = ("Return", "Enter", "Space")
_REMOVE = KeyHint(
    name="remove", words="Delete", means="remove the selected inputs", keys=("Del", "Backspace")
)
_ALL_INPUTS = KeyHint(
    name="select_all", words="Ctrl+A", means="select all inputs", keys=("Ctrl+A",)
)
_ZOOM = (
    # On many keyboards a plus is typed with Shift, or stands where Shift makes it of another sign.
    KeyHint(name="zoom_in", words="+", means="zoom in", keys=("+", "=", "Shift++", "Shift+=")),
    KeyHint(name="zoom_out", words="−", means="zoom out", keys=("-", "Shift+-")),
)


def _held(modifiers: tuple[str, ...], keys: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{held}{key}" for held in modifiers for key in keys)


#: By the place where they work: name of a widget, heading on the keys page, and its keys.
WIDGET_KEYS: dict[str, tuple[str, tuple[KeyHint, ...]]] = {
    "hand": (
        "On the hand",
        (
            KeyHint(
                name="go", words="Arrow keys", means="move the ring to another place", keys=_ARROWS
            ),
            KeyHint(
                name="jump",
                words="A number, Home, End",
                means="move the ring to the place of that number, to the first, to the last",
                keys=(*(str(digit) for digit in range(10)), "Home", "End"),
            ),
            KeyHint(
                name="place",
                words="Enter or Space",
                means="place an input at the ring, or select the one that is there",
                keys=_ENTER,
            ),
            KeyHint(
                name="place_another",
                words="Insert, +, or Shift or Ctrl and Enter",
                means="place one more input where there is one",
                keys=(
                    *_held(("", "Shift+"), ("Ins", "+")),
                    *_held(("Shift+", "Ctrl+", "Ctrl+Shift+"), _ENTER),
                ),
            ),
            KeyHint(
                name="move",
                words="Shift and arrow keys",
                means="move the selected inputs",
                keys=_held(("Shift+",), _ARROWS),
            ),
            _ALL_INPUTS,
            _REMOVE,
        ),
    ),
    "inputs": (
        "On the heads of tracks",
        (
            KeyHint(
                name="go",
                words="Up, Down, Home, End",
                means="go to another input; with Shift select those on the way",
                keys=_held(("", "Shift+"), ("Up", "Down", "Home", "End")),
            ),
            KeyHint(
                name="shift_up",
                words="Alt+Up",
                means="move the selected inputs up",
                keys=("Alt+Up",),
            ),
            KeyHint(
                name="shift_down",
                words="Alt+Down",
                means="move the selected inputs down",
                keys=("Alt+Down",),
            ),
            KeyHint(name="mute", words="M", means="mute the selected inputs", keys=("M",)),
            KeyHint(name="solo", words="S", means="make the selected inputs solo", keys=("S",)),
            KeyHint(
                name="type",
                words="Enter",
                means="type the amplitude",
                keys=("Return", "Enter", "F2"),
            ),
            GAIN_CURVE,
            _ALL_INPUTS,
            KeyHint(
                name="duplicate",
                words="Ctrl+D",
                means="duplicate the selected inputs",
                keys=("Ctrl+D",),
            ),
            _REMOVE,
        ),
    ),
    "timeline": ("On the timeline", TIMELINE),
    "playhead": ("On the timeline and on the traces", PLAYHEAD),
    "clip_editor": ("In the editor of a clip", CLIP_EDITOR),
    "skin": (
        "On the skin map",
        (
            KeyHint(
                name="go", words="Arrow keys", means="move the ring to another output", keys=_ARROWS
            ),
            KeyHint(
                name="select",
                words="Enter or Space",
                means="select the output in the ring",
                keys=_ENTER,
            ),
            KeyHint(
                name="toggle",
                words="Shift or Ctrl and Enter",
                means="add the output in the ring to the selected ones, or take it away",
                keys=_held(("Shift+", "Ctrl+"), _ENTER),
            ),
            KeyHint(
                name="select_all",
                words="Ctrl+A",
                means="select all outputs in sight",
                keys=("Ctrl+A",),
            ),
            KeyHint(
                name="select_none",
                words="Esc",
                means="select no outputs; after a click on an input, no inputs",
                keys=("Esc",),
            ),
            _REMOVE,
            *_ZOOM,
            KeyHint(name="whole", words="0", means="show hand and arm", keys=("0", "Shift+0")),
            KeyHint(name="hand", words="H", means="show the hand alone", keys=("H", "Shift+H")),
        ),
    ),
    "colour_bar": (
        "On the colour bar and its ends",
        (
            KeyHint(
                name="step",
                words="Arrow keys",
                means="move by 1 dB; with Ctrl by 0.1 dB, with Shift by 5 dB",
                keys=_held(("", "Ctrl+", "Shift+"), _ARROWS),
            ),
            KeyHint(
                name="page",
                words="Page Up, Page Down",
                means="move by 10 dB; with Ctrl by 1 dB, with Shift by 50 dB",
                keys=_held(("", "Ctrl+", "Shift+"), ("PgUp", "PgDown")),
            ),
        ),
    ),
    "number": (
        "In a number",
        (
            KeyHint(
                name="step",
                words="Up, Down",
                means="change it; with Ctrl finely, with Shift coarsely",
                keys=_held(("", "Ctrl+", "Shift+"), ("Up", "Down")),
            ),
            KeyHint(
                name="page",
                words="Page Up, Page Down",
                means="change it coarsely",
                keys=("PgUp", "PgDown"),
            ),
            KeyHint(
                name="type",
                words="Enter, F2, Ctrl+A, or a digit",
                means="type it, with or without its unit; Esc takes typing back",
                keys=("Return", "Enter", "F2", "Ctrl+A"),
            ),
            KeyHint(name="empty", words="Delete", means="type it anew", keys=("Del", "Backspace")),
        ),
    ),
    "snapshot": (
        "On a card of a snapshot",
        (
            KeyHint(
                name="act",
                words="Enter or Space",
                means="show the snapshot, or store one where there is none",
                keys=_ENTER,
            ),
            KeyHint(name="forget", words="Delete", means="forget it", keys=("Del", "Backspace")),
        ),
    ),
    "curve": ("On a small curve", CURVE),
    "effects": ("On an effect of a clip", EFFECTS),
    "parts": ("On a part of layers", PARTS),
    "history": (
        "In the history",
        (
            KeyHint(
                name="walk",
                words="Up, Down, Home, End",
                means="move to another step",
                keys=("Up", "Down", "Home", "End"),
            ),
            KeyHint(
                name="go",
                words="Enter or Space",
                means="take back, or do again, all up to that step",
                keys=_ENTER,
            ),
        ),
    ),
    "library": ("In the library", LIBRARY),
    "plot": (
        "In a plot",
        (
            KeyHint(
                name="step",
                words="Left, Right",
                means="move the crosshair; with Shift by ten samples",
                keys=_held(("", "Shift+"), ("Left", "Right")),
            ),
            KeyHint(
                name="jump",
                words="Home, End",
                means="move the crosshair to the first sample, to the last",
                keys=_held(("", "Shift+"), ("Home", "End")),
            ),
            KeyHint(name="give_up", words="Esc", means="take the crosshair away", keys=("Esc",)),
            *_ZOOM,
            KeyHint(
                name="whole",
                words="A or 0",
                means="show everything",
                keys=("A", "0", "Shift+A", "Shift+0"),
            ),
        ),
    ),
}


def meant(place: str, event: QKeyEvent) -> str:
    """Name of what a press means at a place; "" where it means nothing there."""
    held = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    return _meanings(place).get(QKeyCombination(held, Qt.Key(event.key())).toCombined(), "")


def key_text(place: str, name: str) -> str:
    """The key that does something at a place, as the desktop writes it: ``"Ctrl+D"``; or ""."""
    keys = next((hint.keys for hint in WIDGET_KEYS[place][1] if hint.name == name), ("",))
    return QKeySequence(keys[0]).toString(QKeySequence.SequenceFormat.NativeText)


def _combined(key: str) -> int:
    first: QKeyCombination = QKeySequence(key)[0]  # type: ignore[index]  # PySide's stubs forget it
    return first.toCombined()


@cache
def _meanings(place: str) -> Mapping[int, str]:
    return {_combined(key): hint.name for hint in WIDGET_KEYS[place][1] for key in hint.keys}
