"""The button that copies the numbers of a panel."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QToolButton, QWidget


class CopyButton(QToolButton):
    """Copies a table as text, while there is one and it is that of the present design.

    Parameters
    ----------
    panel
        Name of the panel whose numbers they are.
    table
        Gives them, with tabs between the columns.

    Attributes
    ----------
    lines
        Gives what follows the numbers: what is to be known of them.
    as_stored
        While this lasts the numbers are those of no matched levels.
    """

    def __init__(self, panel: str, table: Callable[[], str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._table = table
        self.lines: Callable[[], Sequence[str]] = tuple
        self.as_stored: Callable[[], AbstractContextManager[None]] = nullcontext
        self.setObjectName(f"{panel}_copy")
        self.setText("Copy")
        self.setToolTip(
            "Copy the numbers as a table, with tabs between the columns; lines that begin with # "
            "say what to know of them"
        )
        self.setAccessibleName("Copy numbers")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._there, self._late = True, False
        self.clicked.connect(self._copy)

    def offer(self, there: bool) -> None:
        """Say whether there is a table."""
        self._there = there
        self.setEnabled(there and not self._late)

    def show_late(self, late: bool) -> None:
        """Say whether the table is that of an older design."""
        self._late = late
        self.setEnabled(self._there and not late)

    def _copy(self) -> None:
        # Who judges the present design lets its numbers be there first: they are taken then.
        with self.as_stored():
            lines = self.lines()
            table = self._table()
        below = [f"# {line}\n" for line in lines] if table else []
        QGuiApplication.clipboard().setText(f"{table}{''.join(below)}")
