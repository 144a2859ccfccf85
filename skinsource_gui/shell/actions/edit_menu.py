"""The entries of the Edit menu.

The usual keys of the clipboard are about clips, but in texts and in tables.
"""

from collections.abc import Callable, Iterable
from functools import partial

from skinsource.design import edits
from skinsource.design.comparing import NUMBERS
from skinsource.design.design import Design, Input
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.panels.timeline.clipboard import copy_clips, cut_clips, paste_clips
from skinsource_gui.qt.keys import key_text
from skinsource_gui.shell.actions.spec import ActionSpec, action


def _has_clips(design: Design, view: View) -> bool:
    return bool(design.clips)


def _has_snapshot(number: int, design: Design, view: View) -> bool:
    return any(snapshot.number == number for snapshot in view.snapshots)


def _has_snapshots(design: Design, view: View) -> bool:
    return bool(view.snapshots)


def _toggle_match(design: Design, view: View) -> Edit | Refusal:
    return edits.match_levels(design, view, not view.levels_matched)


def _has_match_gain(design: Design, view: View) -> bool:
    return view.match_gain(design) != 1.0


def _matched(design: Design, view: View) -> bool:
    return view.levels_matched


def _has_inputs(design: Design, view: View) -> bool:
    return bool(design.inputs)


def _has_outputs(design: Design, view: View) -> bool:
    return bool(view.outputs)


def _selected(design: Design, view: View) -> list[Input]:
    return [track for track in design.inputs if track.id in view.selected_inputs]


def _has_selected(design: Design, view: View) -> bool:
    return bool(view.selected_inputs)


def _all_muted(design: Design, view: View) -> bool:
    chosen = _selected(design, view)
    return bool(chosen) and all(track.muted for track in chosen)


def _all_solo(design: Design, view: View) -> bool:
    chosen = _selected(design, view)
    return bool(chosen) and all(track.solo for track in chosen)


def _of_selected(
    edit: Callable[[Design, View, Iterable[int]], Edit | Refusal],
) -> Callable[[Design, View], Edit | Refusal]:
    """Return ``edit`` of the inputs that are selected."""

    def of_selected(design: Design, view: View) -> Edit | Refusal:
        return edit(design, view, view.selected_inputs)

    return of_selected


def _select_no_outputs(design: Design, view: View) -> Edit | Refusal:
    return edits.select_outputs(design, view, ())


def _key(name: str) -> str:
    return key_text("inputs", name)


EDIT: tuple[ActionSpec, ...] = (
    action("undo", "Undo", "Undo the last edit", "Ctrl+Z", command="steps.undo"),
    action("redo", "Redo", "Redo an undone edit", "Ctrl+Shift+Z", "Ctrl+Y", command="steps.redo"),
    action(
        "cut_clips",
        "Cut clips",
        "Move the selected clips to the clipboard",
        "Ctrl+X",
        edit=cut_clips,
        enabled=_has_clips,
        keywords="clipboard remove move",
        separated=True,
    ),
    action(
        "copy_clips",
        "Copy clips",
        "Put the selected clips on the clipboard",
        "Ctrl+C",
        edit=copy_clips,
        enabled=_has_clips,
        keywords="clipboard",
    ),
    action(
        "paste_clips",
        "Paste clips",
        "Put clips at the playhead, on the selected track",
        "Ctrl+V",
        edit=paste_clips,
        keywords="clipboard insert",
    ),
    action(
        "save_to_library",
        "Save to library…",
        "Save the selected clips, a track or the design as a preset",
        command="library.ask_and_save",
        enabled=_has_clips,
        keywords="preset keep store template reuse",
    ),
    action(
        "add_input",
        "Add input",
        "Add an input like the selected one at the next free place",
        "Ctrl+Shift+N",
        edit=edits.add_input,
        keywords="new track place insert",
        separated=True,
    ),
    action(
        "duplicate_input",
        "Duplicate input",
        "Add a copy of the selected input",
        "Ctrl+D",
        edit=_of_selected(edits.duplicate_inputs),
        enabled=_has_selected,
        keywords="copy clone actuator",
    ),
    action(
        "remove_input",
        "Remove input",
        f"Remove the selected input ({_key('remove')}, on the hand and in the list)",
        "Ctrl+Backspace",
        edit=_of_selected(edits.remove_inputs),
        enabled=_has_selected,
        keywords="delete actuator",
    ),
    action(
        "mute_input",
        "Mute input",
        "Silence the selected input",
        "Ctrl+M",
        edit=_of_selected(edits.toggle_mute),
        enabled=_has_selected,
        checked=_all_muted,
        keywords="silence off actuator",
    ),
    action(
        "solo_input",
        "Solo input",
        "Play only solo inputs",
        "Ctrl+Shift+M",
        edit=_of_selected(edits.toggle_solo),
        enabled=_has_selected,
        checked=_all_solo,
        keywords="alone only actuator",
    ),
    action(
        "shift_input_up",
        "Move input up",
        f"Move the selected inputs up ({_key('shift_up')}, in the list)",
        edit=_of_selected(partial(edits.shift_inputs, down=False)),
        enabled=_has_selected,
        keywords="reorder order sort before",
        separated=True,
    ),
    action(
        "shift_input_down",
        "Move input down",
        f"Move the selected inputs down ({_key('shift_down')}, in the list)",
        edit=_of_selected(partial(edits.shift_inputs, down=True)),
        enabled=_has_selected,
        keywords="reorder order sort after",
    ),
    action(
        "select_all_inputs",
        "Select all inputs",
        f"Edit all inputs together ({_key('select_all')}, on the hand and in the list)",
        edit=edits.select_all_inputs,
        enabled=_has_inputs,
        keywords="several multiple everything",
        separated=True,
    ),
    action(
        "clear_inputs",
        "Remove all inputs",
        "Remove all inputs from the hand",
        edit=edits.clear_inputs,
        enabled=_has_inputs,
        keywords="delete clear actuators",
    ),
    action(
        "select_no_outputs",
        "Deselect outputs",
        "Clear the selection of outputs",
        "Ctrl+Shift+A",
        edit=_select_no_outputs,
        enabled=_has_outputs,
        keywords="deselect sensors clear",
        separated=True,
    ),
    *(
        ActionSpec(
            name=f"store_snapshot_{number}",
            text=f"Store snapshot {number}",
            hint="Store the design, to compare others with it",
            keys=(f"Ctrl+Shift+{number}",),
            keywords="a/b compare keep variant version",
            command="comparison.store",
            argument=str(number),
            separated=number == NUMBERS[0],
        )
        for number in NUMBERS
    ),
    *(
        ActionSpec(
            name=f"show_snapshot_{number}",
            text=f"Show snapshot {number}",
            hint="Replace the design by the snapshot; Undo brings it back",
            keys=(f"Ctrl+{number}",),
            keywords="a/b compare recall variant version",
            command="comparison.recall",
            argument=str(number),
            enabled=partial(_has_snapshot, number),
        )
        for number in NUMBERS
    ),
    action(
        "take_snapshot",
        "Snapshot from a file…",
        "Store the design of a file as a snapshot",
        command="files.take_snapshot",
        keywords="a/b compare design file side by side open",
    ),
    action(
        "toggle_snapshots",
        "Compare with previous snapshot",
        "Switch between the last two snapshots that were shown",
        "X",
        command="comparison.toggle",
        enabled=_has_snapshots,
        keywords="a/b toggle switch exchange snapshot",
    ),
    action(
        "match_levels",
        "Match levels of snapshots",
        "Show snapshots equally loud at their loudest output",
        edit=_toggle_match,
        checked=_matched,
        keywords="a/b loudness gain equal snapshot",
    ),
    action(
        "keep_match_gain",
        "Apply match gain",
        "Change the amplitudes to those shown for the matched level",
        edit=edits.keep_match_gain,
        enabled=_has_match_gain,
        keywords="a/b loudness level snapshot amplitude",
    ),
)
