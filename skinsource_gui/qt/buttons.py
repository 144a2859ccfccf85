"""Buttons, labels and scroll areas of pages, buttons of panels, and the swatch of an input."""

from collections.abc import Callable
from functools import partial

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QRectF, QSize, Qt, QTimer

from skinsource_gui.qt.keys import key_text
from skinsource_gui.qt.layouts import Policy, named
from skinsource_gui.qt.theme import current_theme, letter_scale, set_tone, tabular


def page_button(name: str, text: str, hint: str = "") -> QtWidgets.QPushButton:
    """Return a button that Enter elsewhere on the page does not press."""
    button = named(QtWidgets.QPushButton(text), name, hint=hint)
    button.setAutoDefault(False)
    return button


def page_label(
    name: str, text: str = "", *, tone: str = "", centred: bool = False
) -> QtWidgets.QLabel:
    """Return a label for sentences, which breaks lines."""
    label = named(QtWidgets.QLabel(text), name)
    label.setWordWrap(True)
    if tone:
        set_tone(label, tone)
    if centred:
        label.setAlignment(Qt.AlignmentFlag.AlignCenter)
    return label


def show_or_hide(part: QtWidgets.QLabel | QtWidgets.QPushButton, text: str) -> None:
    """Show a text; without one, the part takes no room."""
    part.setText(text)
    part.setVisible(bool(text))


def progress_bar(name: str, title: str, *, keeps_room: bool = False) -> QtWidgets.QProgressBar:
    """Return a bar without a text; ``keeps_room``: nothing moves while it is hidden."""
    bar = named(QtWidgets.QProgressBar(), name, title)
    bar.setTextVisible(False)
    policy = bar.sizePolicy()
    policy.setRetainSizeWhenHidden(keeps_room)
    bar.setSizePolicy(policy)
    return bar


Answer = QtWidgets.QDialogButtonBox.StandardButton


def answers(dialog: QtWidgets.QDialog, yes: Answer = Answer.Ok) -> QtWidgets.QDialogButtonBox:
    """Return the button that accepts a dialog, and Cancel."""
    box = QtWidgets.QDialogButtonBox(yes | Answer.Cancel)
    box.accepted.connect(dialog.accept)
    box.rejected.connect(dialog.reject)
    return box


def scrolled(content: QtWidgets.QWidget, name: str) -> QtWidgets.QScrollArea:
    """Return an area without a frame in which ``content`` scrolls up and down."""
    area = named(QtWidgets.QScrollArea(), name)
    area.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(content)
    return area


def tool_button(
    parent: QtWidgets.QWidget | None,
    name: str,
    text: str,
    hint: str = "",
    *,
    checkable: bool = False,
    takes_keyboard: bool = True,
) -> QtWidgets.QToolButton:
    """Return a button as narrow as its text, which the Tab key reaches.

    ``takes_keyboard``: a click gives it the keyboard, too.
    """
    button = named(QtWidgets.QToolButton(parent), name, hint=hint)
    button.setText(text)
    button.setCheckable(checkable)
    policy = Qt.FocusPolicy
    button.setFocusPolicy(policy.StrongFocus if takes_keyboard else policy.TabFocus)
    return button


def menu_of(
    button: QtWidgets.QToolButton, fill: Callable[[QtWidgets.QMenu], object] | None = None
) -> QtWidgets.QMenu:
    """Return a new menu, which a button opens that the Tab key reaches; ``fill`` each time."""
    menu = QtWidgets.QMenu(button)
    if fill is not None:
        menu.aboutToShow.connect(menu.clear)
        menu.aboutToShow.connect(partial(fill, menu))
    button.setMenu(menu)
    button.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.InstantPopup)
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return menu


class Fold(QtWidgets.QToolButton):
    """A title with an arrow, which shows or hides what stands below it; folded at first."""

    def __init__(self, name: str, text: str, content: QtWidgets.QWidget) -> None:
        super().__init__()
        self.setObjectName(name)
        self.setText(text)
        self.setCheckable(True)
        self.setAutoRaise(True)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(Policy.Expanding, Policy.Fixed)
        self._content = content
        self.toggled.connect(self._follow)
        self._follow(False)

    def _follow(self, is_open: bool) -> None:
        arrow = Qt.ArrowType.DownArrow if is_open else Qt.ArrowType.RightArrow
        self.setArrowType(arrow)
        self._content.setVisible(is_open)


def passing_menu(parent: QtWidgets.QWidget, name: str = "") -> QtWidgets.QMenu:
    """Return a menu that is deleted when it is closed."""
    menu = named(QtWidgets.QMenu(parent), name)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    return menu


class FirstLetters(QObject):
    """Lets typed letters find the entry of a menu, or of a menu in it, that begins with them.

    A letter that is typed again goes to the next entry that begins with it, as in any list.
    """

    def __init__(self, menu: QtWidgets.QMenu, *within: QtWidgets.QMenu) -> None:
        super().__init__(menu)
        self._menus, self._typed, self._at = (menu, *within), "", -1
        self._pause = QTimer(self, singleShot=True)
        self._pause.setInterval(QtWidgets.QApplication.keyboardInputInterval())
        for each in self._menus:
            each.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        is_press = event.type() == QEvent.Type.KeyPress
        letter = event.text().casefold() if is_press and isinstance(event, QtGui.QKeyEvent) else ""
        self._typed = typed = (self._typed if self._pause.isActive() else "") + letter
        if not (letter and typed.isprintable() and typed.strip()):
            return False
        self._pause.start()
        again = len(set(typed)) == 1
        entries = [(menu, entry) for menu in self._menus for entry in menu.actions()]
        begin = typed[0] if again else typed
        found = [k for k, (_, at) in enumerate(entries) if at.text().casefold().startswith(begin)]
        if found:
            self._at = next((k for k in found if again and k > self._at), found[0])
            menu, entry = entries[self._at]
            if menu is not self._menus[0]:
                self._menus[0].setActiveAction(menu.menuAction())
            menu.setActiveAction(entry)
        return True


SWATCH_PX = 24
_ROUNDING_PX = 5


def text_colour_on(colour: QtGui.QColor) -> QtGui.QColor:
    """Return black or white, whichever is easier to read on ``colour`` (WCAG 2 contrast)."""
    parts = (colour.redF(), colour.greenF(), colour.blueF())
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    ]
    luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    return QtGui.QColor("black") if luminance > 0.179 else QtGui.QColor("white")


def paint_swatch(
    painter: QtGui.QPainter,
    place: QRectF,
    number: int,
    colour: QtGui.QColor,
    text: QtGui.QColor,
    *,
    silent: bool,
) -> None:
    """Paint a rounded square with a number; that of a silent input is hollow."""
    painter.save()
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    painter.setFont(_number_font(painter.font()))
    if silent:
        painter.setPen(QtGui.QPen(colour, 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
    else:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
    painter.drawRoundedRect(place.adjusted(1, 1, -1, -1), _ROUNDING_PX, _ROUNDING_PX)
    painter.setPen(text if silent else text_colour_on(colour))
    painter.drawText(place, Qt.AlignmentFlag.AlignCenter, str(number))
    painter.restore()


def _number_font(font: QtGui.QFont) -> QtGui.QFont:
    bold = tabular(font)
    bold.setWeight(QtGui.QFont.Weight.DemiBold)
    return bold


class Swatch(QtWidgets.QWidget):
    """The colour of an input with the number of its place."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("swatch")
        self.setSizePolicy(Policy.Fixed, Policy.Fixed)
        self._number = 0
        self._colour_number = 0
        self._silent = False

    def show_input(self, number: int, colour_number: int, *, silent: bool) -> None:
        """Show the number of the place, the colour, and whether the input is silent."""
        if (number, colour_number, silent) != (self._number, self._colour_number, self._silent):
            self._number, self._colour_number, self._silent = number, colour_number, silent
            self.setAccessibleName(f"Place {number}")
            self.updateGeometry()
            self.update()

    def sizeHint(self) -> QSize:
        # The number must fit in letters of any size.
        metrics = QtGui.QFontMetrics(_number_font(self.font()))
        height = max(SWATCH_PX, metrics.height() + _ROUNDING_PX)
        return QSize(
            max(height, metrics.horizontalAdvance(str(self._number)) + _ROUNDING_PX), height
        )

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        paint_swatch(
            QtGui.QPainter(self),
            QRectF(self.rect()),
            self._number,
            current_theme().input_colour(self._colour_number),
            QtGui.QColor(current_theme().text),
            silent=self._silent,
        )


BUTTON_PX = 22
_ARROWS = frozenset({Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right})


class LetterButton(QtWidgets.QToolButton):
    """A small button with one letter, such as mute or solo.

    Parameters
    ----------
    name, letter, hint
        Object name, text, and tooltip.
    title
        Accessible name.
    """

    def __init__(
        self, name: str, letter: str, title: str, hint: str, *, checkable: bool = False
    ) -> None:
        super().__init__()
        named(self, name, title, hint)
        self.setText(letter)
        self.setCheckable(checkable)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def sizeHint(self) -> QSize:
        side = round(BUTTON_PX * letter_scale(self.font()))
        return QSize(side, side)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in _ARROWS:
            # In a list the arrow keys choose another row.
            event.ignore()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)


def mute_button() -> LetterButton:
    """Return the button that silences an input."""
    hint = f"Mute: silence this input ({key_text('inputs', 'mute')})"
    return LetterButton("mute_button", "M", "Mute", hint, checkable=True)


def solo_button() -> LetterButton:
    """Return the button that silences all other inputs."""
    hint = f"Solo: play only solo inputs ({key_text('inputs', 'solo')})"
    return LetterButton("solo_button", "S", "Solo", hint, checkable=True)


def remove_button() -> LetterButton:
    """Return the button that removes an input."""
    hint = f"Remove this input ({key_text('inputs', 'remove')})"
    return LetterButton("remove_button", "×", "Remove", hint)
