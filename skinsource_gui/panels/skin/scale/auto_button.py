"""The switch that lets a range of colours follow the design."""

from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget


class AutoButton(QToolButton):
    """Is down while the range follows the design.

    Parameters
    ----------
    name, words, hint
        Its name, what it switches, and what is followed.
    """

    def __init__(self, name: str, words: str, hint: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.setText("Auto")
        self.setAccessibleName(words)
        self.setToolTip(hint)
        self.setCheckable(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
