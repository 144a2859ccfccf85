"""The base of the pages that a menu opens."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QWidget


class Page(QDialog):
    """A window of its own, which is deleted when it is closed."""

    def __init__(
        self, parent: QWidget | None, name: str, title: str, size_px: tuple[int, int] | None = None
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName(name)
        self.setWindowTitle(title)
        if size_px is not None:
            self.resize(*size_px)
