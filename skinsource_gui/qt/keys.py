"""Keys and mouse gestures: their meaning at a place of the window, and their names in texts.

A widget asks `meaning_of` for the meaning of a key at its place.  Texts get the name of a key from
`key_text`, or that of the shortcut of an action from `shortcut_text`.
"""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from PySide6 import QtGui
from PySide6.QtCore import QEvent, QKeyCombination, Qt

from skinsource_gui.qt.resources import read_text


@dataclass(frozen=True, slots=True)
class Gesture:
    """Keys with nearly the same meaning, or a gesture of the mouse.

    Attributes
    ----------
    shown
        Text for the keys or the gesture.
    effect
        Text for its effect, which can begin a sentence.
    keys
        All keys, as Qt writes them; where there is little room, the first one is shown.
    """

    shown: str
    effect: str
    keys: tuple[str, ...] = ()

    @property
    def hint(self) -> str:
        """The effect and the keys, for the tooltip of a button that does the same."""
        return f"{self.effect[:1].upper()}{self.effect[1:]} ({self.shown})"


@dataclass(frozen=True, slots=True)
class Place:
    """A part of the window: its heading on the page of keys, and its gestures by name."""

    heading: str
    gestures: dict[str, Gesture]

    def sentences(self, *names: str) -> list[str]:
        """Return sentences on gestures: ``"Arrow keys: move the ring to another place"``."""
        return [f"{self.gestures[name].shown}: {self.gestures[name].effect}" for name in names]


def _places(table: Mapping[str, Any]) -> dict[str, Place]:
    return {
        place: Place(
            rows["heading"],
            {
                name: Gesture(shown, effect, tuple(" ".join(keys).split()))
                for name, (shown, effect, *keys) in rows.items()
                if name != "heading"
            },
        )
        for place, rows in table.items()
    }


_TABLE = tomllib.loads(read_text("keys.toml"))
#: Keys of widgets, and gestures of the mouse, by place.
KEYS, MOUSE = _places(_TABLE["keys"]), _places(_TABLE["mouse"])
#: Shortcuts of actions by their names; the table of actions fills it.
SHORTCUTS: dict[str, tuple[str, ...]] = {}


def meaning_of(place: str, event: QtGui.QKeyEvent) -> str:
    """Return the name of the meaning of a key at a place; "" where it has none."""
    modifiers = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    return _meanings(place).get(QKeyCombination(modifiers, Qt.Key(event.key())).toCombined(), "")


def key_text(place: str, name: str) -> str:
    """Return the first key with a meaning at a place, as the desktop writes it: ``"Ctrl+D"``."""
    return _native(KEYS[place].gestures[name].keys[0])


def shortcut_text(action: str) -> str:
    """Return the first shortcut of an action, as the desktop writes it."""
    return _native(SHORTCUTS[action][0])


def native_text(keys: tuple[str, ...]) -> str:
    """Return keys as the desktop writes them: ``"Ctrl+Shift+Z, Ctrl+Y"``."""
    return ", ".join(_native(key) for key in keys)


_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


def arrow_steps(event: QtGui.QKeyEvent) -> tuple[int, int]:
    """Return the steps of an arrow key to the right and up; with Shift ten times as many."""
    far = 10 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1
    right, up = _ARROWS.get(Qt.Key(event.key()), (0, 0))
    return far * right, far * up


def claims_shortcut(event: QEvent, wanted: Callable[[QtGui.QKeyEvent], object]) -> bool:
    """Accept a ShortcutOverride event for a key that is ``wanted``; return whether it is one.

    Qt sends this event to the widget with the focus before it looks for a shortcut; if the widget
    accepts it, the widget gets the key press.
    """
    is_requested = event.type() == QEvent.Type.ShortcutOverride
    if not is_requested or not isinstance(event, QtGui.QKeyEvent) or not wanted(event):
        return False
    event.accept()
    return True


def _native(key: str) -> str:
    return QtGui.QKeySequence(key).toString(QtGui.QKeySequence.SequenceFormat.NativeText)


def _combined(key: str) -> int:
    first: QKeyCombination = QtGui.QKeySequence(key)[0]  # type: ignore[index]  # PySide's stubs forget it
    return first.toCombined()


@cache
def _meanings(place: str) -> Mapping[int, str]:
    gestures = KEYS[place].gestures
    return {_combined(key): name for name, each in gestures.items() for key in each.keys}
