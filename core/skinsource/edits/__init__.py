"""What can be done to a design and the view on it: pure functions that return an `Edit`.

Whatever they are given, they raise nothing: what cannot be done is a `Refusal` with one sentence.
"""

from skinsource.edits.edit import Edit, Refusal
from skinsource.edits.inputs import (
    clear_inputs,
    duplicate_inputs,
    move_inputs,
    mute_inputs,
    place_input,
    remove_inputs,
    solo_inputs,
    toggle_mute,
    toggle_solo,
)
from skinsource.edits.selection import kept_selection
from skinsource.edits.values import change_field, change_kind, change_waveform

__all__ = [
    "Edit",
    "Refusal",
    "change_field",
    "change_kind",
    "change_waveform",
    "clear_inputs",
    "duplicate_inputs",
    "kept_selection",
    "move_inputs",
    "mute_inputs",
    "place_input",
    "remove_inputs",
    "solo_inputs",
    "toggle_mute",
    "toggle_solo",
]
