"""The one table of what can be done: menus, shortcuts, the palette and the help page use it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionSpec:
    """One thing that can be done.

    Attributes
    ----------
    name
        Name of the action and of the window's method that does it.
    text, hint
        What the menu says; what it does, in a sentence.
    menu
        Menu it stands in.
    keys
        Shortcuts, first the one that is shown.
    checkable
        Whether it switches something on and off.
    separated
        Whether a line stands before it.
    group
        Of the checkable actions with the same group, one is on.
    """

    name: str
    text: str
    menu: str
    hint: str
    keys: tuple[str, ...] = ()
    checkable: bool = False
    separated: bool = False
    group: str = ""


def _action(
    name: str, menu: str, text: str, hint: str, *keys: str, **more: bool | str
) -> ActionSpec:
    return ActionSpec(name=name, menu=menu, text=text, hint=hint, keys=keys, **more)


MENUS = ("File", "Edit", "View", "Help")

ACTIONS: tuple[ActionSpec, ...] = (
    _action("new_design", "File", "New", "Start over with an empty design", "Ctrl+N"),
    _action("open_design", "File", "Open…", "Open a design file", "Ctrl+O"),
    _action("save_design", "File", "Save", "Save the design", "Ctrl+S", separated=True),
    _action("save_design_as", "File", "Save as…", "Save under another name", "Ctrl+Shift+S"),
    _action(
        "export_picture",
        "File",
        "Export picture of the skin map…",
        "Save the skin map as PNG, with its colour bar",
        "Ctrl+Shift+E",
        separated=True,
    ),
    _action(
        "export_traces",
        "File",
        "Export traces as CSV…",
        "Save the traces of the selected outputs, with times and units",
        "Ctrl+E",
    ),
    _action(
        "export_levels",
        "File",
        "Export RMS levels as CSV…",
        "Save the RMS of all 72 outputs, in m/s² and dB",
    ),
    _action(
        "export_field",
        "File",
        "Export whole field as NPZ…",
        "Save the acceleration of all 72 outputs on three axes, for NumPy",
    ),
    _action(
        "cancel_export",
        "File",
        "Cancel export",
        "Stop the export that runs; no file is left",
        "Ctrl+.",
    ),
    _action("quit_studio", "File", "Quit", "Close the studio", "Ctrl+Q", separated=True),
    _action("undo", "Edit", "Undo", "Take the last edit back", "Ctrl+Z"),
    _action("redo", "Edit", "Redo", "Do it again", "Ctrl+Shift+Z", "Ctrl+Y"),
    _action(
        "duplicate_input",
        "Edit",
        "Duplicate input",
        "Add a copy of the selected input",
        "Ctrl+D",
        separated=True,
    ),
    _action(
        "remove_input",
        "Edit",
        "Remove input",
        "Remove the selected input (Delete, on the hand and in the list)",
        "Ctrl+Backspace",
    ),
    _action(
        "mute_input",
        "Edit",
        "Mute input",
        "Silence the selected input",
        "Ctrl+M",
        checkable=True,
    ),
    _action(
        "solo_input",
        "Edit",
        "Solo input",
        "Hear only the solo inputs",
        "Ctrl+Shift+M",
        checkable=True,
    ),
    _action("clear_inputs", "Edit", "Remove all inputs", "Empty the hand"),
    _action(
        "select_no_outputs",
        "Edit",
        "Select no outputs",
        "Empty the selection of outputs",
        "Ctrl+Shift+A",
        separated=True,
    ),
    _action(
        "remove_delay",
        "View",
        "Remove 52 ms pre-trigger delay",
        "Shift time axes so that the response starts with the stimulus",
        "Ctrl+T",
        checkable=True,
    ),
    _action(
        "arrange_design",
        "View",
        "Arrange for designing",
        "All panels, the hand and the skin in front",
        "Ctrl+1",
        separated=True,
    ),
    _action(
        "arrange_analysis",
        "View",
        "Arrange for analysis",
        "The skin, traces and spectra, large",
        "Ctrl+2",
    ),
    _action(
        "arrange_presentation",
        "View",
        "Arrange for presenting",
        "The hand and the skin alone, large",
        "Ctrl+3",
    ),
    _action(
        "next_panel", "View", "Go to next panel", "Give the keyboard to it", "F6", separated=True
    ),
    _action(
        "previous_panel", "View", "Go to previous panel", "Give the keyboard to it", "Shift+F6"
    ),
    _action(
        "use_light_theme",
        "View",
        "Light theme",
        "Dark words on a light ground",
        checkable=True,
        group="theme",
        separated=True,
    ),
    _action(
        "use_dark_theme",
        "View",
        "Dark theme",
        "Light words on a dark ground",
        checkable=True,
        group="theme",
    ),
    _action(
        "use_system_theme",
        "View",
        "System theme",
        "As the desktop has it",
        checkable=True,
        group="theme",
    ),
    _action(
        "toggle_full_screen",
        "View",
        "Full screen",
        "The window over the whole screen",
        "F11",
        separated=True,
    ),
    _action(
        "find_action",
        "Help",
        "Search actions…",
        "Type a few letters of anything the studio can do",
        "Ctrl+K",
    ),
    _action(
        "show_accuracy",
        "Help",
        "Accuracy and speed…",
        "What is promised about errors and times, what is measured now, and a benchmark",
    ),
    _action("show_keys", "Help", "Keys and mouse", "Every shortcut on one page", "F1"),
    _action(
        "show_dataset_help",
        "Help",
        "Get the measured limbs…",
        "How to install the measured impulse responses",
    ),
    _action("show_about", "Help", "About SkinSource studio", "Version, licence, and what to cite"),
)
