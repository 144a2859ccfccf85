"""Questions before an own limb is lost."""

from PySide6.QtWidgets import QMessageBox, QWidget

from skinsource.own_limbs import facts_of

_Answer = QMessageBox.StandardButton
_LOST = "Its responses cannot be had back from here"


def may_replace(parent: QWidget, name: str) -> bool:
    """Whether the user gives up the limb of this name for the one that is imported."""
    return _agreed(
        parent,
        "Replace a limb",
        f"Replace {_words(name)}? {_LOST}, and its designs open read-only unless the new one has "
        "the same numbers.",
    )


def may_remove(parent: QWidget, name: str) -> bool:
    """Whether the user gives up the limb of this name."""
    return _agreed(
        parent,
        "Remove a limb",
        f"Remove {_words(name)}? {_LOST}, and its designs open read-only.",
    )


def _words(name: str) -> str:
    title = facts_of(name).title
    return f"“{name}”" if title == name else f"“{title}” ({name})"


def _agreed(parent: QWidget, title: str, question: str) -> bool:
    answer = QMessageBox.question(parent, title, question, _Answer.Yes | _Answer.No, _Answer.No)
    return answer == _Answer.Yes
