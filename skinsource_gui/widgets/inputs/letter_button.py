"""A small button with one letter on it."""

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy, QWidget

from skinsource_gui.theme import current_theme, letter_scale
from skinsource_gui.widgets.inputs.swatch import words_on
from skinsource_gui.widgets.keys import key_text

BUTTON_PX = 22
# Of one that cannot be pressed now.
_FAINT = 0.35
_ARROWS = frozenset({Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right})


class LetterButton(QAbstractButton):
    """Mute, solo, remove: pressed in, it is filled with a colour that says what it does.

    Parameters
    ----------
    letter, name
        What stands on it, and what it is called.
    colour_name
        Field of the theme that fills it while it is checked; "" for a plain button.
    """

    def __init__(
        self, letter: str, name: str, colour_name: str = "", parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._colour_name = colour_name
        self.setText(letter)
        self.setAccessibleName(name)
        self.setCheckable(bool(colour_name))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)

    def sizeHint(self) -> QSize:
        side = round(BUTTON_PX * letter_scale(self.font()))
        return QSize(side, side)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in _ARROWS:
            # In a list these choose another row.
            event.ignore()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setOpacity(1.0 if self.isEnabled() else _FAINT)
        place = QRectF(self.rect()).adjusted(1.5, 1.5, -1.5, -1.5)
        lit = self.isChecked()
        fill = QColor(getattr(current_theme(), self._colour_name)) if lit else None
        if fill is None and self.isEnabled() and (self.underMouse() or self.isDown()):
            fill = QColor(current_theme().grid)
        if fill is not None:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(fill)
            painter.drawRoundedRect(place, 4, 4)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self.hasFocus():
            painter.setPen(QPen(QColor(current_theme().accent), 2))
            painter.drawRoundedRect(place, 4, 4)
        elif self.isCheckable() and not lit:
            painter.setPen(QPen(QColor(current_theme().border), 1))
            painter.drawRoundedRect(place, 4, 4)
        font = QFont(painter.font())
        font.setWeight(QFont.Weight.DemiBold)
        painter.setFont(font)
        painter.setPen(words_on(fill) if fill is not None and lit else QColor(current_theme().dim))
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, self.text())


def mute_button(parent: QWidget | None = None) -> LetterButton:
    """Button that silences an input."""
    button = LetterButton("M", "Mute", "warning", parent)
    button.setObjectName("mute_button")
    button.setToolTip(f"Mute: silence this input ({key_text('inputs', 'mute')})")
    return button


def solo_button(parent: QWidget | None = None) -> LetterButton:
    """Button that silences all others."""
    button = LetterButton("S", "Solo", "accent", parent)
    button.setObjectName("solo_button")
    button.setToolTip(f"Solo: only inputs with S are driven ({key_text('inputs', 'solo')})")
    return button


def remove_button(parent: QWidget | None = None) -> LetterButton:
    """Button that removes an input."""
    button = LetterButton("×", "Remove", parent=parent)
    button.setObjectName("remove_button")
    button.setToolTip(f"Remove this input ({key_text('inputs', 'remove')})")
    return button
