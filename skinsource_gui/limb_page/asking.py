"""Questions before an own limb is lost."""

from PySide6.QtWidgets import QMessageBox, QWidget

from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.widgets.asking import agreed

_NO = QMessageBox.StandardButton.No
_LOST = "Its responses cannot be had back from here"


def may_replace(parent: QWidget, name: str) -> bool:
    """Whether the user gives up the limb of this name for the one that is imported."""
    return agreed(
        parent,
        "Replace a limb",
        f"Replace {_words(name)}? {_LOST}, and its designs open read-only unless the new one has "
        "the same numbers.",
        otherwise=_NO,
    )


def may_remove(parent: QWidget, name: str) -> bool:
    """Whether the user gives up the limb of this name."""
    return agreed(
        parent,
        "Remove a limb",
        f"Remove {_words(name)}? {_LOST}, and its designs open read-only.",
        otherwise=_NO,
    )


def _words(name: str) -> str:
    title = facts_of(name).title
    return f"“{name}”" if title == name else f"“{title}” ({name})"
