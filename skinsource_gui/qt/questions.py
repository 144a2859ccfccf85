"""Questions before something is lost, and copying of tables."""

import math
import re
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import Qt, QTimer

from skinsource.base.decibels import levels_for_tables
from skinsource.base.files import path_exists
from skinsource_gui.qt.layouts import named

_Answer = QtWidgets.QMessageBox.StandardButton
#: A question lists so many names of files.
_NAMED = 3


def ask_yes(
    parent: QtWidgets.QWidget, title: str, question: str, *, otherwise: _Answer = _Answer.Cancel
) -> bool:
    """Ask in front of ``parent``; return whether the user says Yes instead of ``otherwise``."""
    answer = QtWidgets.QMessageBox.question(
        parent, title, question, _Answer.Yes | otherwise, otherwise
    )
    return answer == _Answer.Yes


def ask_to_replace(parent: QtWidgets.QWidget, existing: Sequence[Path]) -> bool:
    """Ask whether existing files may be replaced."""
    if len(existing) == 1:
        question = f"{existing[0].name} exists already. Replace it?"
        return ask_yes(parent, "Replace the file?", question)
    names = ", ".join(path.name for path in existing[:_NAMED])
    more = f" and {len(existing) - _NAMED} more" if len(existing) > _NAMED else ""
    question = f"{len(existing)} files exist already: {names}{more}. Replace them?"
    return ask_yes(parent, "Replace the files?", question)


def ask_to_save(
    parent: QtWidgets.QWidget, title: str, question: str, save: Callable[[], bool]
) -> bool:
    """Ask whether to save changes; return whether they are saved or discarded."""
    buttons = _Answer.Save | _Answer.Discard | _Answer.Cancel
    QTimer.singleShot(0, parent, _give_discard_a_key)
    answer = QtWidgets.QMessageBox.question(parent, title, question, buttons, _Answer.Save)
    return save() if answer == _Answer.Save else answer == _Answer.Discard


def _give_discard_a_key() -> None:
    """Have Alt+D discard in the question that is open: Qt gives this button no key."""
    box = QtWidgets.QApplication.activeModalWidget()
    discard = box.button(_Answer.Discard) if isinstance(box, QtWidgets.QMessageBox) else None
    if discard is not None:
        discard.setText("&Discard")


def show_title(parent: QtWidgets.QWidget) -> None:
    """Make the dialog that opens next wide enough for its title: Qt heeds the content alone."""

    def widen() -> None:
        if (box := QtWidgets.QApplication.activeModalWidget()) is not None:
            # Beside it are the icon and the buttons of the frame, and its letters may be bold.
            text = f"{box.windowTitle()}{'m' * 16}"
            box.setMinimumWidth(box.fontMetrics().horizontalAdvance(text))

    QTimer.singleShot(0, parent, widen)


def ask_name(parent: QtWidgets.QWidget, title: str, name: str, longest: int) -> str | None:
    """Ask for another name until it is short enough; None: the user has given up."""
    label, sure = "Name", True
    while sure:
        show_title(parent)
        name, sure = QtWidgets.QInputDialog.getText(parent, title, label, text=name)
        if sure and len(name) <= longest:
            return name
        label = f"Use at most {longest} letters; these are {len(name)}."
    return None


_ENDINGS = re.compile(r"\*([^\s)]+)")


def ask_save(parent: QtWidgets.QWidget, title: str, start: Path, kinds: str) -> Path | None:
    """Ask for a file to write; return None if the user cancels.

    A name without the ending of any of the ``kinds``, as in ``"PNG (*.png);;SVG (*.svg)"``, gets
    that of the chosen one, which may be longer than a suffix, as ``_stim.tsv.gz``.
    """
    name, kind = QtWidgets.QFileDialog.getSaveFileName(parent, title, str(start), kinds)
    endings = _ENDINGS.findall(kind) + _ENDINGS.findall(kinds)
    known = {Path(f"x{ending}").suffix for ending in endings}
    if not name or not endings or Path(name).suffix.lower() in known:
        return Path(name) if name else None
    # The dialog asked about the name as it was typed.
    for part in Path(f"x{endings[0]}").suffixes:
        name = name.removesuffix(part)
    path = Path(f"{name}{endings[0]}")
    free = not path_exists(path) or ask_to_replace(parent, [path])
    return path if free else None


def ask_open(
    parent: QtWidgets.QWidget, title: str, kinds: str, start: Path | None = None
) -> Path | None:
    """Ask for a file to read; None where the user has chosen none."""
    name, _ = QtWidgets.QFileDialog.getOpenFileName(parent, title, str(start or ""), kinds)
    return Path(name) if name else None


def copied_number(value: float) -> str:
    """Return digits that read back as the same number; "" for no number."""
    return repr(float(value)) if math.isfinite(value) else ""


def copied_level(level_db: float) -> str:
    """Return the digits of a level in dB; "" for silence."""
    return copied_number(float(levels_for_tables(level_db)))


def tab_separated(lines: Iterable[Iterable[str | float]]) -> str:
    """Return lines of cells with tabs between them, as spreadsheets read them."""
    return "".join(
        "\t".join(cell if isinstance(cell, str) else copied_number(cell) for cell in line) + "\n"
        for line in lines
    )


class CopyButton(QtWidgets.QToolButton):
    """Copies the numbers of a panel as text, while there are some of the present design.

    Parameters
    ----------
    panel
        Name of the panel.
    table
        Returns the numbers, with tabs between the columns.

    Attributes
    ----------
    lines
        Returns remarks that follow the numbers.
    as_stored
        Returns a context in which the numbers have no matched levels.
    """

    def __init__(
        self, panel: str, table: Callable[[], str], parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._table = table
        self.lines: Callable[[], Sequence[str]] = tuple
        self.as_stored: Callable[[], AbstractContextManager[None]] = nullcontext
        hint = "Copy the numbers as a tab-separated table; # lines explain them"
        named(self, f"{panel}_copy", "Copy numbers", hint).setText("Copy")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._exists, self._stale = True, False
        self.clicked.connect(self._copy)

    def offer(self, exists: bool) -> None:
        """Say whether there is a table."""
        self._exists = exists
        self.setEnabled(exists and not self._stale)

    def show_staleness(self, stale: bool) -> None:
        """Say whether the table belongs to an older design."""
        self._stale = stale
        self.setEnabled(self._exists and not stale)

    def _copy(self) -> None:
        # The context may compute the present numbers: they are read inside.
        with self.as_stored():
            lines = self.lines()
            table = self._table()
        below = [f"# {line}\n" for line in lines] if table else []
        QtGui.QGuiApplication.clipboard().setText(f"{table}{''.join(below)}")
