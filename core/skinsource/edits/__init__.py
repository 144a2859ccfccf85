"""What can be done to a design and the view on it: pure functions that return an `Edit`.

Whatever they are given, they raise nothing: what cannot be done is a `Refusal` with one sentence.
To add one, write a function in the module that it belongs to, and name it here.
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
from skinsource.edits.motions import add_motion
from skinsource.edits.order import put_inputs_before, shift_inputs
from skinsource.edits.outputs import select_outputs
from skinsource.edits.selection import (
    kept_selection,
    select_all_inputs,
    select_inputs,
    select_through,
    toggle_selected,
)
from skinsource.edits.setup import (
    change_limb,
    change_scaling,
    level_over,
    look_along,
    look_by_method,
    remove_delay,
)
from skinsource.edits.values import (
    change_field,
    change_kind,
    change_waveform,
    drag_field,
    fields_of,
    value_of,
)
from skinsource.edits.wavelets import equalise_on_skin

__all__ = [
    "Edit",
    "Refusal",
    "add_motion",
    "change_field",
    "change_kind",
    "change_limb",
    "change_scaling",
    "change_waveform",
    "clear_inputs",
    "drag_field",
    "duplicate_inputs",
    "equalise_on_skin",
    "fields_of",
    "kept_selection",
    "level_over",
    "look_along",
    "look_by_method",
    "move_inputs",
    "mute_inputs",
    "place_input",
    "put_inputs_before",
    "remove_delay",
    "remove_inputs",
    "select_all_inputs",
    "select_inputs",
    "select_outputs",
    "select_through",
    "shift_inputs",
    "solo_inputs",
    "toggle_mute",
    "toggle_selected",
    "toggle_solo",
    "value_of",
]
