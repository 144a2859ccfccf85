"""A number field for a level."""

from PySide6.QtCore import QLocale, Qt, Signal
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QWidget

from skinsource_gui.widgets.level_range import HIGHEST_DB, LOWEST_DB
from skinsource_gui.widgets.level_text import minus


class LevelField(QDoubleSpinBox):
    """A level in dB, typed or stepped with the arrow keys or the wheel."""

    #: A level the user entered.
    level_chosen = Signal(float)

    def __init__(self, name: str, words: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.setAccessibleName(words)
        self.setToolTip(words)
        self.setLocale(QLocale.c())
        self.setRange(LOWEST_DB, HIGHEST_DB)
        self.setDecimals(1)
        self.setSuffix(" dB")
        self.setButtonSymbols(QAbstractSpinBox.ButtonSymbols.NoButtons)
        self.setKeyboardTracking(False)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.valueChanged.connect(self.level_chosen)

    def show_level(self, level_db: float) -> None:
        """Show a level without telling that it was chosen; what is being typed stays."""
        if self.value() != level_db:
            self.blockSignals(True)
            self.setValue(level_db)
            self.blockSignals(False)

    def textFromValue(self, value: float) -> str:
        return minus(f"{value:.1f}".removesuffix(".0"))

    def valueFromText(self, text: str) -> float:
        return super().valueFromText(text.replace("−", "-"))

    def validate(self, text: str, position: int) -> object:
        state, _, position = super().validate(text.replace("−", "-"), position)
        return state, minus(text), position

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()
