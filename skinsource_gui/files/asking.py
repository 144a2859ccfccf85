"""Questions before a file is replaced."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QMessageBox, QWidget

_Answer = QMessageBox.StandardButton
#: Names that a question lists of many files.
_NAMED = 3


def agreed(window: QWidget, title: str, question: str) -> bool:
    """Ask in front of ``window``; whether the user agrees."""
    answer = QMessageBox.question(
        window, title, question, _Answer.Yes | _Answer.Cancel, _Answer.Cancel
    )
    return answer == _Answer.Yes


def may_replace(window: QWidget, there: Sequence[Path]) -> bool:
    """Whether the user lets files go that are there already."""
    if len(there) == 1:
        question = f"{there[0].name} exists already. Replace it?"
        return agreed(window, "Replace the file?", question)
    names = ", ".join(one.name for one in there[:_NAMED])
    more = f" and {len(there) - _NAMED} more" if len(there) > _NAMED else ""
    question = f"{len(there)} files exist already: {names}{more}. Replace them?"
    return agreed(window, "Replace the files?", question)
