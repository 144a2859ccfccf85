"""The button that copies the numbers of a panel."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QToolButton, QWidget


class CopyButton(QToolButton):
    """Copies a table as text.

    Parameters
    ----------
    panel
        Name of the panel whose numbers they are.
    table
        Gives them, with tabs between the columns.
    """

    def __init__(self, panel: str, table: Callable[[], str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(f"{panel}_copy")
        self.setText("Copy")
        self.setToolTip("Copy the numbers as a table, with tabs between the columns")
        self.setAccessibleName("Copy numbers")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.clicked.connect(lambda: QGuiApplication.clipboard().setText(table()))
