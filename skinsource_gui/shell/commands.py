"""What each action of the table does."""

import importlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow

from skinsource import edits
from skinsource.errors import SkinSourceError
from skinsource_gui.files.export_actions import ExportActions
from skinsource_gui.files.pictures import save_picture
from skinsource_gui.shell import pages
from skinsource_gui.shell.actions import ACTIONS
from skinsource_gui.shell.arrangements import arrange_analysis, arrange_design, arrange_presentation
from skinsource_gui.shell.focus_order import tab_stops
from skinsource_gui.shell.palette import Palette

if TYPE_CHECKING:
    from skinsource_gui.accuracy_page.page import AccuracyPage
    from skinsource_gui.shell.window import MainWindow


class Commands(QObject):
    """One method for each entry of `skinsource_gui.shell.actions.ACTIONS`."""

    def __init__(self, window: "MainWindow"):
        super().__init__(window)
        self._window = window
        self._accuracy_page: AccuracyPage | None = None
        self.exports = ExportActions(window)

    def new_design(self) -> None:
        self._window.files.new()

    def open_design(self) -> None:
        self._window.files.ask_and_open()

    def open_recent(self, entry: QAction) -> None:
        if entry.data():
            self._window.files.open(Path(entry.data()))

    def save_design(self) -> None:
        self._window.files.save()

    def save_design_as(self) -> None:
        self._window.files.ask_and_save()

    def export_picture(self) -> None:
        path = self._ask_where("Export picture of the skin map", "skin-map.png", "PNG (*.png)")
        if path:
            self._window.catch_up()
            self._exported(path, lambda: save_picture(path, self._window.skin.picture(1200, 1800)))

    def export_traces(self) -> None:
        self.exports.traces()

    def export_levels(self) -> None:
        self.exports.levels()

    def export_field(self) -> None:
        self.exports.field()

    def cancel_export(self) -> None:
        self.exports.jobs.cancel()

    def quit_studio(self) -> None:
        self._window.close()

    def undo(self) -> None:
        self._window.document.undo_stack.undo()

    def redo(self) -> None:
        self._window.document.undo_stack.redo()

    def duplicate_input(self) -> None:
        document = self._window.document
        ids = document.view.selected_inputs
        document.apply(edits.duplicate_inputs(document.design, document.view, ids))

    def remove_input(self) -> None:
        document = self._window.document
        ids = document.view.selected_inputs
        document.apply(edits.remove_inputs(document.design, document.view, ids))

    def mute_input(self, on: bool) -> None:
        document = self._window.document
        ids = document.view.selected_inputs
        document.apply(edits.mute_inputs(document.design, document.view, ids, on))

    def solo_input(self, on: bool) -> None:
        document = self._window.document
        ids = document.view.selected_inputs
        document.apply(edits.solo_inputs(document.design, document.view, ids, on))

    def clear_inputs(self) -> None:
        document = self._window.document
        document.apply(edits.clear_inputs(document.design, document.view))

    def select_no_outputs(self) -> None:
        document = self._window.document
        document.look(replace(document.view, outputs=()))

    def remove_delay(self, on: bool) -> None:
        self._window.traces.remove_delay(on)

    def arrange_design(self) -> None:
        self._arrange(arrange_design)

    def arrange_analysis(self) -> None:
        self._arrange(arrange_analysis)

    def arrange_presentation(self) -> None:
        self._arrange(arrange_presentation)

    def next_panel(self) -> None:
        self._go_to_panel(1)

    def previous_panel(self) -> None:
        self._go_to_panel(-1)

    def use_light_theme(self) -> None:
        self._window.use_theme("light")

    def use_dark_theme(self) -> None:
        self._window.use_theme("dark")

    def use_system_theme(self) -> None:
        self._window.use_theme("system")

    def toggle_full_screen(self) -> None:
        # Not showNormal: a maximised window shall be one afterwards.
        self._window.setWindowState(self._window.windowState() ^ Qt.WindowState.WindowFullScreen)

    def find_action(self) -> None:
        window = self._window
        found = [action for name, action in window.actions_by_name.items() if name != "find_action"]
        for dock in window.docks.values():
            verb = "Show" if dock.isHidden() else "Hide"
            action = QAction(f"{verb} panel: {dock.windowTitle()}", window)
            action.triggered.connect(partial(dock.setVisible, dock.isHidden()))
            found.append(action)
        Palette([*found, *window.setup_bar.choices(window)], window).open()

    def show_accuracy(self) -> None:
        window = self._window
        if self._accuracy_page is None:
            # Few open it; the start of the studio shall not wait for it.
            module = importlib.import_module("skinsource_gui.accuracy_page.page")
            self._accuracy_page = module.AccuracyPage(
                window.status_line, lambda: window.theme, window.preferences, window
            )
        self._accuracy_page.show()
        self._accuracy_page.raise_()
        self._accuracy_page.activateWindow()

    def show_keys(self) -> None:
        pages.keys_page(ACTIONS, self._window).open()

    def show_dataset_help(self) -> None:
        pages.dataset_page(self._window).open()

    def show_about(self) -> None:
        pages.about_page(self._window).open()

    def end(self) -> None:
        """Close what stands beside the window, and stop what runs."""
        self.exports.end()
        if self._accuracy_page is not None:
            self._accuracy_page.end()

    def _arrange(self, arrange: Callable[[QMainWindow, Mapping[str, QDockWidget]], None]) -> None:
        arrange(self._window, self._window.docks)
        # A panel that was a window of its own may have had the keyboard.
        if QApplication.activeWindow() is not self._window:
            self._window.activateWindow()

    def _ask_where(self, title: str, name: str, kind: str) -> Path | None:
        return self._window.files.ask_where(title, self._window.preferences.folder / name, kind)

    def _go_to_panel(self, step: int) -> None:
        # A panel that only says what to do has nothing for the keyboard.
        panels = [panel for panel in self._window.panels if tab_stops(panel, ())]
        focused = QApplication.focusWidget()
        here = [k for k, panel in enumerate(panels) if focused and panel.isAncestorOf(focused)]
        if panels:
            start = here[0] if here else -min(step, 0) - 1
            panel = panels[(start + step) % len(panels)]
            panel.activateWindow()
            stops = tab_stops(panel, ())
            first = panel.focusProxy()
            (first if first in stops else stops[0]).setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _exported(self, path: Path, save: Callable[[], None]) -> None:
        try:
            save()
        except SkinSourceError as error:
            self._window.complain(str(error))
        else:
            self._window.files.note_written(path)
