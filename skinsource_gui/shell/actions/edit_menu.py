"""What the Edit menu does."""

from collections.abc import Callable, Iterable

from skinsource.design import edits
from skinsource.design.design import Design, Input
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.shell.action_spec import ActionSpec, action
from skinsource_gui.shell.actions.clipboard_actions import CLIPBOARD
from skinsource_gui.shell.actions.snapshot_actions import SNAPSHOTS
from skinsource_gui.state.wavelet_levelling import selected_train
from skinsource_gui.widgets.keys import key_text


def _has_inputs(design: Design, view: View) -> bool:
    return bool(design.inputs)


def _has_clips(design: Design, view: View) -> bool:
    return any(one.clips for one in design.inputs)


def _has_outputs(design: Design, view: View) -> bool:
    return bool(view.outputs)


def _selected(design: Design, view: View) -> list[Input]:
    return [one for one in design.inputs if one.id in view.selected_inputs]


def _has_selected(design: Design, view: View) -> bool:
    return bool(view.selected_inputs)


def _has_train(design: Design, view: View) -> bool:
    return selected_train(design, view) is not None


def _all_muted(design: Design, view: View) -> bool:
    chosen = _selected(design, view)
    return bool(chosen) and all(one.muted for one in chosen)


def _all_solo(design: Design, view: View) -> bool:
    chosen = _selected(design, view)
    return bool(chosen) and all(one.solo for one in chosen)


def _of_selected(
    edit: Callable[[Design, View, Iterable[int]], Edit | Refusal],
) -> Callable[[Design, View], Edit | Refusal]:
    """Return ``edit`` of the inputs that are selected."""

    def of_selected(design: Design, view: View) -> Edit | Refusal:
        return edit(design, view, view.selected_inputs)

    return of_selected


def _select_no_outputs(design: Design, view: View) -> Edit | Refusal:
    return edits.select_outputs(design, view, ())


def _shift_up(design: Design, view: View) -> Edit | Refusal:
    return edits.shift_inputs(design, view, view.selected_inputs, down=False)


def _shift_down(design: Design, view: View) -> Edit | Refusal:
    return edits.shift_inputs(design, view, view.selected_inputs, down=True)


def _key(name: str) -> str:
    return key_text("inputs", name)


EDIT: tuple[ActionSpec, ...] = (
    action("undo", "Edit", "Undo", "Take the last edit back", "Ctrl+Z", command="steps.undo"),
    action("redo", "Edit", "Redo", "Do it again", "Ctrl+Shift+Z", "Ctrl+Y", command="steps.redo"),
    *CLIPBOARD,
    action(
        "make_motion",
        "Edit",
        "Motion…",
        "Sweeps, apparent motion, taps, … along a path of places",
        command="pages.show_motion",
        keywords="path sweep apparent phantom alternate rabbit travelling wave preset",
        separated=True,
    ),
    action(
        "save_to_library",
        "Edit",
        "Save to library…",
        "Keep the selected clips, a track or the whole design as a preset",
        command="library.ask_and_save",
        enabled=_has_clips,
        keywords="preset keep store template reuse",
    ),
    action(
        "add_input",
        "Edit",
        "Add input",
        "Add an input at the next place without one, as the selected one is",
        "Ctrl+Shift+N",
        edit=edits.add_input,
        keywords="new track place insert",
        separated=True,
    ),
    action(
        "duplicate_input",
        "Edit",
        "Duplicate input",
        "Add a copy of the selected input",
        "Ctrl+D",
        edit=_of_selected(edits.duplicate_inputs),
        enabled=_has_selected,
        keywords="copy clone actuator",
    ),
    action(
        "remove_input",
        "Edit",
        "Remove input",
        f"Remove the selected input ({_key('remove')}, on the hand and in the list)",
        "Ctrl+Backspace",
        edit=_of_selected(edits.remove_inputs),
        enabled=_has_selected,
        keywords="delete actuator",
    ),
    action(
        "mute_input",
        "Edit",
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
        "Edit",
        "Solo input",
        "Only solo inputs are felt, all others rest",
        "Ctrl+Shift+M",
        edit=_of_selected(edits.toggle_solo),
        enabled=_has_selected,
        checked=_all_solo,
        keywords="alone only actuator",
    ),
    action(
        "equalise_on_skin",
        "Edit",
        "Equal on the skin",
        "Give the wavelets of the selected train gains with which the loudest 100 ms of each, "
        "anywhere on the skin, are predicted alike",
        command="levelling.equalise",
        enabled=_has_train,
        keywords="wavelet train gains level loudness equalise normalise",
        separated=True,
    ),
    action(
        "shift_input_up",
        "Edit",
        "Move input up in the list",
        f"List the selected inputs one place further up ({_key('shift_up')}, in the list)",
        edit=_shift_up,
        enabled=_has_selected,
        keywords="reorder order sort before",
        separated=True,
    ),
    action(
        "shift_input_down",
        "Edit",
        "Move input down in the list",
        f"List the selected inputs one place further down ({_key('shift_down')}, in the list)",
        edit=_shift_down,
        enabled=_has_selected,
        keywords="reorder order sort after",
    ),
    action(
        "select_all_inputs",
        "Edit",
        "Select all inputs",
        "Edit, mute, move or remove them together "
        f"({_key('select_all')}, on the hand and in the list)",
        edit=edits.select_all_inputs,
        enabled=_has_inputs,
        keywords="several multiple everything",
        separated=True,
    ),
    action(
        "clear_inputs",
        "Edit",
        "Remove all inputs",
        "Empty the hand",
        edit=edits.clear_inputs,
        enabled=_has_inputs,
        keywords="delete clear actuators",
    ),
    action(
        "select_no_outputs",
        "Edit",
        "Select no outputs",
        "Empty the selection of outputs",
        "Ctrl+Shift+A",
        edit=_select_no_outputs,
        enabled=_has_outputs,
        keywords="deselect sensors clear",
        separated=True,
    ),
    *SNAPSHOTS,
)
