"""What can be done to a design and the view on it: pure functions that return an `Edit`.

Whatever they are given, they raise nothing: what cannot be done is a `Refusal` with one sentence.
To add one, write a function in the module that it belongs to, and name it here.
"""

from skinsource.edits.actuation import predict_through
from skinsource.edits.clip_selection import (
    move_playhead,
    select_all_clips,
    select_clips,
    toggle_clip,
)
from skinsource.edits.clips import (
    add_clip,
    copy_clips,
    duplicate_clips,
    move_clips,
    remove_clips,
    repeat_clips,
    set_clips,
    toggle_mute_clips,
)
from skinsource.edits.clips_to_places import move_clips_to_place
from skinsource.edits.cutting import fade_clip, join_clips, split_clips, stretch_clip, trim_clip
from skinsource.edits.drawing import bound_clip, draw_clip
from skinsource.edits.edit import Edit, Refusal
from skinsource.edits.effects import (
    add_effect,
    change_effect_field,
    move_effect,
    remove_effect,
    set_envelope,
    switch_effect,
)
from skinsource.edits.fragments import (
    cut_clips,
    fragment_from,
    fragment_of,
    fragment_text,
    paste_fragment,
    place_fragment,
)
from skinsource.edits.glides import set_glide_curve
from skinsource.edits.groups import group_clips, ungroup_clips
from skinsource.edits.inputs import (
    add_input,
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
from skinsource.edits.mending import mend
from skinsource.edits.motions import add_motion
from skinsource.edits.order import put_inputs_before, shift_inputs
from skinsource.edits.outputs import select_outputs
from skinsource.edits.placing import place_waveform
from skinsource.edits.ruler import (
    add_marker,
    move_marker,
    remove_marker,
    rename_marker,
    set_gain_curve,
    set_loop,
)
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
    play_slower,
    remove_delay,
)
from skinsource.edits.snapshots import (
    forget_snapshot,
    keep_match_gain,
    match_levels,
    show_snapshot,
    store_snapshot,
    take_snapshot,
)
from skinsource.edits.times import insert_time, remove_time
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
    "add_clip",
    "add_effect",
    "add_input",
    "add_marker",
    "add_motion",
    "bound_clip",
    "change_effect_field",
    "change_field",
    "change_kind",
    "change_limb",
    "change_scaling",
    "change_waveform",
    "clear_inputs",
    "copy_clips",
    "cut_clips",
    "drag_field",
    "draw_clip",
    "duplicate_clips",
    "duplicate_inputs",
    "equalise_on_skin",
    "fade_clip",
    "fields_of",
    "forget_snapshot",
    "fragment_from",
    "fragment_of",
    "fragment_text",
    "group_clips",
    "insert_time",
    "join_clips",
    "keep_match_gain",
    "kept_selection",
    "level_over",
    "look_along",
    "look_by_method",
    "match_levels",
    "mend",
    "move_clips",
    "move_clips_to_place",
    "move_effect",
    "move_inputs",
    "move_marker",
    "move_playhead",
    "mute_inputs",
    "paste_fragment",
    "place_fragment",
    "place_input",
    "place_waveform",
    "play_slower",
    "predict_through",
    "put_inputs_before",
    "remove_clips",
    "remove_delay",
    "remove_effect",
    "remove_inputs",
    "remove_marker",
    "remove_time",
    "rename_marker",
    "repeat_clips",
    "select_all_clips",
    "select_all_inputs",
    "select_clips",
    "select_inputs",
    "select_outputs",
    "select_through",
    "set_clips",
    "set_envelope",
    "set_gain_curve",
    "set_glide_curve",
    "set_loop",
    "shift_inputs",
    "show_snapshot",
    "solo_inputs",
    "split_clips",
    "store_snapshot",
    "stretch_clip",
    "switch_effect",
    "take_snapshot",
    "toggle_clip",
    "toggle_mute",
    "toggle_mute_clips",
    "toggle_selected",
    "toggle_solo",
    "trim_clip",
    "ungroup_clips",
    "value_of",
]
