"""What each action of the table does."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog

from skinsource.errors import SkinSourceError
from skinsource.export import export_traces
from skinsource_gui import pages
from skinsource_gui.actions import ACTIONS
from skinsource_gui.arrangements import arrange_analysis, arrange_design, arrange_presentation
from skinsource_gui.palette import Palette
from skinsource_gui.pictures import save_picture

if TYPE_CHECKING:
    from skinsource_gui.window import MainWindow


class Commands(QObject):
    """One method for each entry of `skinsource_gui.actions.ACTIONS`."""

    def __init__(self, window: "MainWindow"):
        super().__init__(window)
        self._window = window

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
        document = self._window.document
        if not document.view.outputs:
            self._window.complain("No output is selected: select some on the skin map first.")
            return
        path = self._ask_where("Export traces", "traces.csv", "CSV (*.csv)")
        if path:
            self._exported(path, lambda: export_traces(path, document.design, document.view))

    def quit_studio(self) -> None:
        self._window.close()

    def undo(self) -> None:
        self._window.document.undo_stack.undo()

    def redo(self) -> None:
        self._window.document.undo_stack.redo()

    def duplicate_input(self) -> None:
        document = self._window.document
        index = document.view.selected_input
        if index is not None:
            one = document.design.inputs[index]
            document.edit(f"Duplicate input {one.location}", document.design.adding(one))
            last = len(document.design.inputs) - 1
            document.look(replace(document.view, selected_input=last))

    def remove_input(self) -> None:
        document = self._window.document
        index = document.view.selected_input
        if index is not None:
            place = document.design.inputs[index].location
            document.edit(f"Remove input {place}", document.design.without_input(index))

    def clear_inputs(self) -> None:
        document = self._window.document
        document.edit("Remove all inputs", replace(document.design, inputs=()))

    def select_no_outputs(self) -> None:
        document = self._window.document
        document.look(replace(document.view, outputs=()))

    def remove_delay(self, on: bool) -> None:
        document = self._window.document
        document.look(replace(document.view, delay_removed=on, time_range_s=None))

    def arrange_design(self) -> None:
        arrange_design(self._window, self._window.docks)

    def arrange_analysis(self) -> None:
        arrange_analysis(self._window, self._window.docks)

    def arrange_presentation(self) -> None:
        arrange_presentation(self._window, self._window.docks)

    def use_light_theme(self) -> None:
        self._window.use_theme("light")

    def use_dark_theme(self) -> None:
        self._window.use_theme("dark")

    def use_system_theme(self) -> None:
        self._window.use_theme("system")

    def toggle_full_screen(self) -> None:
        if self._window.isFullScreen():
            self._window.showNormal()
        else:
            self._window.showFullScreen()

    def find_action(self) -> None:
        others = [
            action
            for action in self._window.actions_by_name.values()
            if action.objectName() != "find_action"
        ]
        others += [dock.toggleViewAction() for dock in self._window.docks.values()]
        Palette(others, self._window).open()

    def show_keys(self) -> None:
        pages.keys_page(ACTIONS, self._window).open()

    def show_dataset_help(self) -> None:
        pages.dataset_page(self._window).open()

    def show_about(self) -> None:
        pages.about_page(self._window).open()

    def _ask_where(self, title: str, name: str, kind: str) -> Path | None:
        folder = self._window.document.path.parent if self._window.document.path else Path.home()
        chosen, _ = QFileDialog.getSaveFileName(self._window, title, str(folder / name), kind)
        return Path(chosen) if chosen else None

    def _exported(self, path: Path, save: Callable[[], None]) -> None:
        try:
            save()
        except SkinSourceError as error:
            self._window.complain(str(error))
        else:
            self._window.notice.say(f"Saved {path}", "info")
