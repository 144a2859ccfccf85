"""Questions before something is lost."""

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtWidgets import QMessageBox, QWidget

_Answer = QMessageBox.StandardButton
#: Names that a question lists of many files.
_NAMED = 3


def agreed(
    parent: QWidget, title: str, question: str, *, otherwise: _Answer = _Answer.Cancel
) -> bool:
    """Ask in front of ``parent``; whether the user says Yes, and not ``otherwise``, as is usual."""
    answer = QMessageBox.question(parent, title, question, _Answer.Yes | otherwise, otherwise)
    return answer == _Answer.Yes


def may_replace(parent: QWidget, there: Sequence[Path]) -> bool:
    """Whether the user lets files go that are there already."""
    if len(there) == 1:
        question = f"{there[0].name} exists already. Replace it?"
        return agreed(parent, "Replace the file?", question)
    names = ", ".join(one.name for one in there[:_NAMED])
    more = f" and {len(there) - _NAMED} more" if len(there) > _NAMED else ""
    question = f"{len(there)} files exist already: {names}{more}. Replace them?"
    return agreed(parent, "Replace the files?", question)


def saved_or_given_up(parent: QWidget, title: str, question: str, save: Callable[[], bool]) -> bool:
    """Whether changes may go: ``save`` has saved them now, or the user gives them up."""
    buttons = _Answer.Save | _Answer.Discard | _Answer.Cancel
    answer = QMessageBox.question(parent, title, question, buttons, _Answer.Save)
    return save() if answer == _Answer.Save else answer == _Answer.Discard
