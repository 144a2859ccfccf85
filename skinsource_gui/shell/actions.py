"""The one table of what can be done: menus, shortcuts, the palette and the keys page use it."""

from collections.abc import Callable, Iterable
from typing import Any

from skinsource import edits
from skinsource.design import Design, Input
from skinsource.edits import Edit, Refusal
from skinsource.view import View
from skinsource_gui.files.exports import EXPORTS
from skinsource_gui.shell.action_spec import ActionSpec
from skinsource_gui.shell.arrangements import ARRANGEMENTS

MENUS = ("File", "Edit", "View", "Help")


def _action(name: str, menu: str, text: str, hint: str, *keys: str, **more: Any) -> ActionSpec:
    return ActionSpec(name=name, menu=menu, text=text, hint=hint, keys=keys, **more)


def _has_inputs(design: Design, view: View) -> bool:
    return bool(design.inputs)


def _has_outputs(design: Design, view: View) -> bool:
    return bool(view.outputs)


def _selected(design: Design, view: View) -> list[Input]:
    return [one for one in design.inputs if one.id in view.selected_inputs]


def _has_selected(design: Design, view: View) -> bool:
    return bool(view.selected_inputs)


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


def _toggle_delay(design: Design, view: View) -> Edit | Refusal:
    return edits.remove_delay(design, view, not view.delay_removed)


def _shift_up(design: Design, view: View) -> Edit | Refusal:
    return edits.shift_inputs(design, view, view.selected_inputs, down=False)


def _shift_down(design: Design, view: View) -> Edit | Refusal:
    return edits.shift_inputs(design, view, view.selected_inputs, down=True)


def _delay_removed(design: Design, view: View) -> bool:
    return view.delay_removed


_FILE = (
    _action(
        "new_design",
        "File",
        "New",
        "Start over with an empty design",
        "Ctrl+N",
        command="files.new",
        keywords="clear empty reset blank",
    ),
    _action(
        "open_design",
        "File",
        "Open…",
        "Open a design file",
        "Ctrl+O",
        command="files.ask_and_open",
        keywords="load read import",
    ),
    _action(
        "save_design",
        "File",
        "Save",
        "Save the design",
        "Ctrl+S",
        command="files.save",
        keywords="write store keep",
        separated=True,
    ),
    _action(
        "save_design_as",
        "File",
        "Save as…",
        "Save under another name",
        "Ctrl+Shift+S",
        command="files.ask_and_save",
        keywords="copy rename",
    ),
    *(
        ActionSpec(
            name=f"export_{export.name}",
            menu="File",
            text=f"Export {export.title}",
            hint=export.hint,
            keys=export.keys,
            keywords=f"save write {export.keywords}",
            command="exports.export",
            argument=export.name,
            enabled=export.enabled,
            separated=export is EXPORTS[0],
        )
        for export in EXPORTS
    ),
    _action(
        "cancel_job",
        "File",
        "Cancel what is running",
        "Stop the export, installation or benchmark that runs; nothing half done is left",
        "Ctrl+.",
        command="jobs.cancel",
        keywords="stop abort export installation benchmark",
    ),
    _action(
        "quit_studio",
        "File",
        "Quit",
        "Close the studio",
        "Ctrl+Q",
        command="frame.close",
        keywords="exit end leave",
        separated=True,
    ),
)
_EDIT = (
    _action("undo", "Edit", "Undo", "Take the last edit back", "Ctrl+Z", command="steps.undo"),
    _action("redo", "Edit", "Redo", "Do it again", "Ctrl+Shift+Z", "Ctrl+Y", command="steps.redo"),
    _action(
        "duplicate_input",
        "Edit",
        "Duplicate input",
        "Add a copy of the selected input",
        "Ctrl+D",
        edit=_of_selected(edits.duplicate_inputs),
        enabled=_has_selected,
        keywords="copy clone actuator",
        separated=True,
    ),
    _action(
        "remove_input",
        "Edit",
        "Remove input",
        "Remove the selected input (Delete, on the hand and in the list)",
        "Ctrl+Backspace",
        edit=_of_selected(edits.remove_inputs),
        enabled=_has_selected,
        keywords="delete actuator",
    ),
    _action(
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
    _action(
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
    _action(
        "shift_input_up",
        "Edit",
        "Move input up in the list",
        "List the selected inputs one place further up (Alt+Up, in the list)",
        edit=_shift_up,
        enabled=_has_selected,
        keywords="reorder order sort before",
        separated=True,
    ),
    _action(
        "shift_input_down",
        "Edit",
        "Move input down in the list",
        "List the selected inputs one place further down (Alt+Down, in the list)",
        edit=_shift_down,
        enabled=_has_selected,
        keywords="reorder order sort after",
    ),
    _action(
        "select_all_inputs",
        "Edit",
        "Select all inputs",
        "Edit, mute, move or remove them together (Ctrl+A, on the hand and in the list)",
        edit=edits.select_all_inputs,
        enabled=_has_inputs,
        keywords="several multiple everything",
        separated=True,
    ),
    _action(
        "clear_inputs",
        "Edit",
        "Remove all inputs",
        "Empty the hand",
        edit=edits.clear_inputs,
        enabled=_has_inputs,
        keywords="delete clear actuators",
    ),
    _action(
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
)
_VIEW = (
    _action(
        "remove_delay",
        "View",
        "Remove 52 ms pre-trigger delay",
        "Shift time axes so that the response starts with the stimulus",
        "Ctrl+T",
        edit=_toggle_delay,
        checked=_delay_removed,
        keywords="time shift latency traces",
    ),
    *(
        ActionSpec(
            name=f"arrange_{arrangement.name}",
            menu="View",
            text=f"Arrange for {arrangement.text}",
            hint=arrangement.hint,
            keys=arrangement.keys,
            keywords="layout panels docks lecture",
            command="arrangements.show",
            argument=arrangement.name,
            separated=arrangement is ARRANGEMENTS[0],
        )
        for arrangement in ARRANGEMENTS
    ),
    _action(
        "next_panel",
        "View",
        "Go to next panel",
        "Give the keyboard to it",
        "F6",
        command="panel_focus.next",
        keywords="focus keyboard",
        separated=True,
    ),
    _action(
        "previous_panel",
        "View",
        "Go to previous panel",
        "Give the keyboard to it",
        "Shift+F6",
        command="panel_focus.previous",
        keywords="focus keyboard",
    ),
    *(
        _action(
            f"use_{name}_theme",
            "View",
            f"{name.capitalize()} theme",
            hint,
            command="appearance.use_theme",
            argument=name,
            keywords="colour color appearance mode",
            group="theme",
            separated=name == "light",
        )
        for name, hint in (
            ("light", "Dark words on a light ground"),
            ("dark", "Light words on a dark ground"),
            ("system", "As the desktop has it"),
        )
    ),
    _action(
        "enlarge_text",
        "View",
        "Larger text",
        "Make all words larger, for a lecture hall or tired eyes",
        "Ctrl++",
        "Ctrl+=",
        command="appearance.enlarge_text",
        keywords="font size zoom big",
        separated=True,
    ),
    _action(
        "shrink_text",
        "View",
        "Smaller text",
        "Make all words smaller",
        "Ctrl+-",
        command="appearance.shrink_text",
        keywords="font size zoom small",
    ),
    _action(
        "reset_text",
        "View",
        "Normal text",
        "Make words as large as the desktop has them",
        "Ctrl+0",
        command="appearance.reset_text",
        keywords="font size zoom reset",
    ),
    _action(
        "toggle_full_screen",
        "View",
        "Full screen",
        "The window over the whole screen",
        "F11",
        command="frame.toggle_full_screen",
        keywords="maximise present",
        separated=True,
    ),
)
_HELP = (
    _action(
        "find_action",
        "Help",
        "Search actions…",
        "Type a few letters of anything the studio can do",
        "Ctrl+K",
        command="pages.search",
        keywords="palette find command",
    ),
    _action(
        "show_accuracy",
        "Help",
        "Accuracy and speed…",
        "What is promised about errors and times, what is measured now, and a benchmark",
        command="pages.show_accuracy",
        keywords="error benchmark precision performance",
    ),
    _action(
        "show_keys",
        "Help",
        "Keys and mouse",
        "Every shortcut on one page",
        "F1",
        command="pages.show_keys",
        keywords="help shortcuts keyboard manual",
    ),
    _action(
        "show_dataset",
        "Help",
        "Get the measured limbs…",
        "Install the measured impulse responses, from a folder or by download",
        command="pages.show_dataset",
        keywords="dataset download install limb data matlab zenodo",
    ),
    _action(
        "show_about",
        "Help",
        "About SkinSource studio",
        "Version, licence, and what to cite",
        command="pages.show_about",
        keywords="version licence cite citation help",
    ),
)
ACTIONS: tuple[ActionSpec, ...] = (*_FILE, *_EDIT, *_VIEW, *_HELP)
