"""Keys and gestures: what they do at a place of the window, and how a text names them.

A widget asks `meaning_of` what a press means at its place, and does it.  Texts that name a key ask
`key_text`, or for the shortcut of an action `shortcut_text`.
"""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from PySide6.QtCore import QEvent, QKeyCombination, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence

from skinsource_gui.qt.resources import read_text


@dataclass(frozen=True, slots=True)
class Gesture:
    """What is done with keys that mean nearly the same, or with the mouse.

    Attributes
    ----------
    shown
        The keys, or what a hand does, as a reader calls it.
    effect
        What comes of it, in a few words that can begin a sentence.
    keys
        All keys, as Qt writes them; the first is shown where there is room for one.
    """

    shown: str
    effect: str
    keys: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Place:
    """Where gestures work: heading on the page of keys and mouse, and the gestures by name."""

    heading: str
    gestures: dict[str, Gesture]

    def sentences(self, *names: str) -> list[str]:
        """What some gestures do: ``"Arrow keys: move the ring to another place"``."""
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
#: By place: the keys of widgets, and what the mouse does.
KEYS, MOUSE = _places(_TABLE["keys"]), _places(_TABLE["mouse"])
#: Shortcuts of actions by their names; the table of actions fills it.
SHORTCUTS: dict[str, tuple[str, ...]] = {}


def meaning_of(place: str, event: QKeyEvent) -> str:
    """Name of what a press means at a place; "" where it means nothing there."""
    modifiers = event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    return _meanings(place).get(QKeyCombination(modifiers, Qt.Key(event.key())).toCombined(), "")


def key_text(place: str, name: str) -> str:
    """The first key that does something at a place, as the desktop writes it: ``"Ctrl+D"``."""
    return _native(KEYS[place].gestures[name].keys[0])


def shortcut_text(action: str) -> str:
    """The first shortcut of an action, as the desktop writes it."""
    return _native(SHORTCUTS[action][0])


def native_text(keys: tuple[str, ...]) -> str:
    """All of some keys, as the desktop writes them: ``"Ctrl+Shift+Z, Ctrl+Y"``."""
    return ", ".join(_native(key) for key in keys)


def claims_shortcut(event: QEvent, wanted: Callable[[QKeyEvent], object]) -> bool:
    """Whether an event asks for a key that is ``wanted`` here: then no shortcut gets it.

    Before it looks for a shortcut, Qt asks the widget that has the keyboard, by an event of its
    own; what is accepted there is pressed here.
    """
    is_asked = event.type() == QEvent.Type.ShortcutOverride
    if not is_asked or not isinstance(event, QKeyEvent) or not wanted(event):
        return False
    event.accept()
    return True


def _native(key: str) -> str:
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def _combined(key: str) -> int:
    first: QKeyCombination = QKeySequence(key)[0]  # type: ignore[index]  # PySide's stubs forget it
    return first.toCombined()


@cache
def _meanings(place: str) -> Mapping[int, str]:
    gestures = KEYS[place].gestures
    return {_combined(key): name for name, each in gestures.items() for key in each.keys}
