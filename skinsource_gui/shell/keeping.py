"""Copies of unsaved work, and the page that lists the copies that earlier sessions left."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QSize, Qt

from skinsource.base.assets import user_folder
from skinsource.base.crash_log import MOST_BYTES, crashed_logs, note_offered
from skinsource.base.errors import SkinSourceError
from skinsource.base.files import path_text, read_bytes, write_bytes
from skinsource.design.recovery import Found, UnsavedWork, discard
from skinsource_gui.pages.files.autosave import Autosave, Recovery, WorkPicture
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.qt.layouts import in_column, named
from skinsource_gui.qt.questions import ask_save, ask_yes
from skinsource_gui.shell.notices import Choice, Notice, Reports
from skinsource_gui.shell.workspaces import Workspaces
from skinsource_gui.state.conductor import Conductor
from skinsource_gui.state.engine import Outcome
from skinsource_gui.state.services import Services

_ICON = QSize(60, 90)
_ROLE = QtWidgets.QDialogButtonBox.ButtonRole


def picture_of(left: UnsavedWork) -> QtGui.QPixmap:
    """Return the picture of the work; empty without one."""
    picture = QtGui.QPixmap()
    # The stubs of PySide ask for bytes, which it does not take.
    loaded: Any = picture
    loaded.loadFromData(left.picture(), "PNG")
    if picture.isNull():
        return picture
    keep, smooth = Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation
    return picture.scaled(_ICON, keep, smooth)


def work_description(left: UnsavedWork) -> str:
    """Return name, time and file of the work, in two lines."""
    where = path_text(left.file) if left.file else "never saved under a name"
    return f"{left.name}, copied at {left.clock()}\n{where}"


class UnsavedWorkPage(ToolPage):
    """Lists unsaved work with its picture and time, to be opened or discarded.

    Parameters
    ----------
    look
        Returns the unsaved work there is.
    open_it, discard
        Open or discard an entry.
    parent
        In front of which the page opens.
    """

    def __init__(
        self,
        look: Callable[[], tuple[UnsavedWork, ...]],
        open_it: Callable[[UnsavedWork], None],
        discard: Callable[[UnsavedWork], None],
        parent: QtWidgets.QWidget,
    ) -> None:
        super().__init__(parent, "unsaved_work_page", "Recover unsaved work", (560, 420))
        self._look, self._open_it, self._discard = look, open_it, discard
        self._left: tuple[UnsavedWork, ...] = ()
        self.rows = named(QtWidgets.QListWidget(), "left_over_rows", "Unsaved work")
        self.rows.setIconSize(_ICON)
        self.rows.itemActivated.connect(self._open)
        self.rows.currentRowChanged.connect(self._follow)
        buttons = QtWidgets.QDialogButtonBox()
        self.open_button = buttons.addButton("Open it", _ROLE.ActionRole)
        self.discard_button = buttons.addButton("Discard it", _ROLE.DestructiveRole)
        buttons.addButton(QtWidgets.QDialogButtonBox.StandardButton.Close)
        self.open_button.clicked.connect(self._open)
        self.discard_button.clicked.connect(self._give_up)
        buttons.rejected.connect(self.reject)
        in_column(self.message, self.rows, buttons, of=self)
        self._fill()

    def _fill(self) -> None:
        self._left = self._look()
        self.say(
            "The studio ended before this work was saved. A copy of each is stored."
            if self._left
            else "No earlier session left unsaved work."
        )
        self.rows.clear()
        for left in self._left:
            item = QtWidgets.QListWidgetItem(QtGui.QIcon(picture_of(left)), work_description(left))
            item.setSizeHint(_ICON + QSize(0, 12))
            self.rows.addItem(item)
        self.rows.setCurrentRow(0 if self._left else -1)
        self._follow()

    def _follow(self) -> None:
        chosen = 0 <= self.rows.currentRow() < len(self._left)
        self.open_button.setEnabled(chosen)
        self.discard_button.setEnabled(chosen)

    def _open(self) -> None:
        left = self._left[self.rows.currentRow()]
        self.accept()
        self._open_it(left)

    def _give_up(self) -> None:
        self._discard(self._left[self.rows.currentRow()])
        self._fill()


_LOGS = "Logs (*.log)"


class AutosaveAndRecovery(QObject):
    """Saves copies of unsaved work, and offers those that earlier sessions left.

    Parameters
    ----------
    document, engine, runner
        The work, its predictions, and the long jobs, before which a copy is saved.
    files, workspaces
        Before files are opened a copy is saved, with the layout of the docks.
    interval_s
        See `Autosave`.
    window
        The parent.
    """

    def __init__(self, services: Services, files: FileActions, workspaces: Workspaces) -> None:
        super().__init__(services.window)
        document, interval_s = services.document, services.preferences.autosave_s
        self._files, self._window = files, services.window
        self._folder = user_folder()
        self._picture = WorkPicture()
        self.autosave = Autosave(
            document, self._folder, interval_s, workspaces.content, self._picture.image, self
        )
        self.recovery = Recovery(
            document,
            services.engine,
            self._folder,
            files.may_lose_changes,
            self.autosave.keep_now,
            self,
        )
        self.recovery.opened.connect(workspaces.put)
        self.recovery.belonged.connect(self._suggest)
        files.risk_ahead.connect(self.autosave.keep_now)
        services.runner.starting.connect(self.autosave.keep_now)

    def connect_to(self, conductor: Conductor, reports: Reports) -> None:
        """Draw the picture of the work from its results, and report what happens."""
        conductor.delivered.connect(self._note_results)
        self.autosave.failed.connect(reports.complain)
        self.recovery.failed.connect(reports.complain)
        self.recovery.done.connect(reports.report)

    def offer(self, notice: Notice) -> None:
        """Offer the unsaved work and the log of a session that crashed, if there are any."""
        leftover, logs = self.recovery.look(), crashed_logs(self._folder)
        sentences, picture = _offers(leftover), None
        choices: list[Choice] = []
        if len(leftover.left) == 1:
            (left,) = leftover.left
            picture = picture_of(left)
            choices = [
                ("Open it", partial(self.recovery.open, left)),
                ("Discard it", partial(self._discard, left, notice)),
            ]
        elif leftover.left:
            choices = [("Show them…", self.show)]
        if logs:
            no_copy = "" if leftover.left else " No copy of unsaved work is left."
            sentences.append(f"The studio crashed; a log says where.{no_copy}")
            # The others stay at the right, where they are without it.
            choices.insert(0, ("Save the log…", partial(self._save_log, logs[0])))
            for log in logs:
                note_offered(log)
        if sentences:
            if notice.text:
                # As of a file that could not be opened at the start.
                sentences.insert(0, f"{notice.text.rstrip('.')}.")
            notice.say(" ".join(sentences), "warning", choices, picture)

    def show(self) -> None:
        """Open the page on unsaved work of earlier sessions."""
        UnsavedWorkPage(
            lambda: self.recovery.look().left, self.recovery.open, self._discard, self._window
        ).open()

    def end(self) -> None:
        """End as the window closes, after the user was asked about unsaved work."""
        self.recovery.end()
        self.autosave.end()
        self._files.held.keep_only(None)

    def end_unasked(self) -> bool:
        """End without a question; save a copy of unsaved work, and return whether that worked."""
        is_saved = self.autosave.keep_now()
        self.recovery.end()
        self.autosave.end(forget=False)
        return is_saved

    def _suggest(self, file: Path | None) -> None:
        self._files.leave_file()
        self._files.suggested = file

    def _note_results(self, outcome: Outcome) -> None:
        if outcome.values is not None:
            self._picture.show_results(outcome.values)

    def _discard(self, left: UnsavedWork, notice: Notice | None = None) -> None:
        """Discard the work if the user agrees; else a notice offers it again."""
        question = f"The copy of {left.name} from {left.clock()} is deleted for good. Discard it?"
        if ask_yes(self._window, "Discard unsaved work?", question):
            discard(left)
        elif notice is not None:
            self.offer(notice)

    def _save_log(self, log: Path) -> None:
        path = ask_save(self._window, "Save the log", Path.home() / log.name, _LOGS)
        if path is None:
            return
        try:
            write_bytes(path, read_bytes(log, most=2 * MOST_BYTES))
        except SkinSourceError as error:
            self._files.failed.emit(str(error))
        else:
            self._files.note_written(path)


def _offers(leftover: Found) -> list[str]:
    sentences = [
        f"{copy.name} stopped the studio when it was opened; it was set aside: {path_text(copy)}."
        for copy in leftover.set_aside
    ]
    if len(leftover.left) == 1:
        left: UnsavedWork = leftover.left[0]
        sentences.append(
            f"The studio ended before your work on {left.name} was saved. Its copy is from "
            f"{left.clock()}; it may lack your last edits."
        )
    elif leftover.left:
        sentences.append(
            "The studio ended before your work was saved. Copies were stored of "
            f"{len(leftover.left)} designs."
        )
    return sentences
