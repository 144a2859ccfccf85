"""The entries of the View menu."""

from functools import partial

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.panels.skin.settings import has_colours, use_colours
from skinsource_gui.plots.small_map import COLOURS
from skinsource_gui.qt.keys import KEYS
from skinsource_gui.qt.theme import theme_label
from skinsource_gui.shell.actions.spec import ActionSpec, action
from skinsource_gui.shell.workspaces import WORKSPACES


def _presenting(name: str) -> str:
    return KEYS["presenting"].gestures[name].shown


def _toggle_delay(design: Design, view: View) -> Edit | Refusal:
    return edits.remove_delay(design, view, not view.delay_removed)


def _delay_removed(design: Design, view: View) -> bool:
    return view.delay_removed


VIEW: tuple[ActionSpec, ...] = (
    action(
        "remove_delay",
        "Remove pre-trigger delay",
        "Shift time axes so that the response starts with the stimulus",
        "Ctrl+T",
        edit=_toggle_delay,
        checked=_delay_removed,
        keywords="time shift latency traces",
    ),
    *(
        ActionSpec(
            name=f"arrange_{workspace.name}",
            text=f"{workspace.text} workspace",
            short=workspace.text,
            hint=workspace.hint,
            keys=(workspace.key,),
            keywords="arrange layout panels docks lecture",
            command="workspaces.choose",
            argument=workspace.name,
            group="workspace",
            separated=workspace is WORKSPACES[0],
        )
        for workspace in WORKSPACES
    ),
    action(
        "reset_workspace",
        "Reset arrangement",
        "Restore the first arrangement of this workspace",
        command="workspaces.reset",
        keywords="arrange layout panels docks default",
    ),
    action(
        "float_panel",
        "Float panel",
        "Take the panel out of the window, or put it back",
        "Ctrl+Shift+W",
        command="panel_in_use.turn_floating",
        keywords="dock undock window screen detach",
    ),
    action(
        "close_panel",
        "Close panel",
        "Close the active panel; View > Panels brings it back",
        "Ctrl+W",
        command="panel_in_use.close",
        keywords="hide dock remove",
    ),
    action(
        "next_panel",
        "Go to next panel",
        "Move the keyboard focus there",
        "F6",
        command="panel_focus.next",
        keywords="focus keyboard",
        separated=True,
    ),
    action(
        "previous_panel",
        "Go to previous panel",
        "Move the keyboard focus there",
        "Shift+F6",
        command="panel_focus.previous",
        keywords="focus keyboard",
    ),
    action(
        "next_tab",
        "Show next tab",
        "Show the next of the panels that share a place",
        "Ctrl+Tab",
        "Ctrl+PgDown",
        command="dock_tabs.next",
        keywords="panel front behind keyboard",
    ),
    action(
        "previous_tab",
        "Show previous tab",
        "Show the previous of the panels that share a place",
        "Ctrl+Shift+Tab",
        "Ctrl+PgUp",
        command="dock_tabs.previous",
        keywords="panel front behind keyboard",
    ),
    *(
        action(
            f"use_{name}_theme",
            f"{theme_label(name)} theme",
            hint,
            command="appearance.use_theme",
            argument=name,
            keywords="colour color appearance mode",
            group="theme",
            separated=name == "light",
        )
        for name, hint in (
            ("light", "Dark text on a light background"),
            ("dark", "Light text on a dark background"),
            (
                "contrast",
                "White text on black, for poor projectors and tired eyes",
            ),
            ("system", "Follow the desktop"),
        )
    ),
    *(
        ActionSpec(
            name=f"use_{colours.lower().replace('-', '_')}_colours",
            submenu="Colours of levels",
            text=f"Colours: {title}",
            hint=COLOURS.hint,
            keywords="color map colormap colour scale heatmap perceptually uniform",
            edit=partial(use_colours, colours),
            checked=partial(has_colours, colours),
            group="colours",
        )
        for colours, title in COLOURS.options
    ),
    action(
        "enlarge_text",
        "Larger text",
        "Make all text larger, for a lecture hall or tired eyes",
        "Ctrl++",
        "Ctrl+=",
        command="appearance.enlarge_text",
        keywords="font size zoom big",
        separated=True,
    ),
    action(
        "shrink_text",
        "Smaller text",
        "Make all text smaller",
        "Ctrl+-",
        command="appearance.shrink_text",
        keywords="font size zoom small",
    ),
    action(
        "reset_text",
        "Normal text",
        "Use the text size of the desktop",
        "Ctrl+0",
        command="appearance.reset_text",
        keywords="font size zoom reset",
    ),
    action(
        "present",
        "Start or end presentation",
        f"Show the stage full screen; {_presenting('next')} or a clicker steps through scenes",
        "F9",
        command="presenter.toggle",
        keywords="lecture slides show talk clicker beamer projector full screen scenes",
        separated=True,
    ),
    action(
        "next_scene",
        "Next scene",
        "Open the next design of this folder, or the next scene",
        "Ctrl+Alt+PgDown",
        command="presenter.next_scene",
        keywords="present lecture step clicker page",
    ),
    action(
        "previous_scene",
        "Previous scene",
        "Open the previous design of this folder, or the previous scene",
        "Ctrl+Alt+PgUp",
        command="presenter.previous_scene",
        keywords="present lecture step clicker page back",
    ),
    action(
        "cover_map",
        "Cover or reveal map",
        "Hide the results, so that people guess first",
        "Ctrl+Shift+B",
        command="presenter.cover",
        keywords="present lecture hide reveal guess quiz blank",
    ),
    action(
        "show_notes",
        "Notes of the scene",
        "Show notes and the next scene in a window of their own",
        command="presenter.show_notes",
        keywords="present lecture speaker second screen",
    ),
    action(
        "toggle_full_screen",
        "Full screen",
        "Show the window over the whole screen",
        "F11",
        command="frame.toggle_full_screen",
        keywords="maximise present",
        separated=True,
    ),
)
