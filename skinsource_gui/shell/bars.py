"""The bar above the panels."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QMainWindow,
    QMenu,
    QToolBar,
    QToolButton,
    QWidget,
)

from skinsource_gui.shell.setup_bar import SetupBar
from skinsource_gui.widgets.tooltips import show_tooltip

#: Of the room that the choices want, so much is theirs before buttons stand beside them.
_CHOICES_SHARE = 0.8
_REFITTED = (QEvent.Type.LayoutRequest, QEvent.Type.FontChange, QEvent.Type.StyleChange)


class FoldedActions(QWidget):
    """Buttons of actions; where there is no room for them, one button with a menu of all.

    Attributes
    ----------
    more
        The button with the menu.
    """

    def __init__(self, groups: Sequence[Sequence[QAction]], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons, row = QWidget(self), QHBoxLayout(self)
        beside = QHBoxLayout(self._buttons)
        for layout in (row, beside):
            layout.setContentsMargins(0, 0, 0, 0)
            layout.setSpacing(6)
        self.more = QToolButton(self)
        self.more.setObjectName("more_actions")
        self.more.setText("»")
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.more.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        menu = QMenu(self.more)
        for group in groups:
            line = QFrame(self._buttons)
            line.setObjectName("bar_line")
            line.setFixedWidth(1)
            beside.addWidget(line)
            menu.addSeparator()
            for action in group:
                button = QToolButton(self._buttons)
                button.setDefaultAction(action)
                button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
                beside.addWidget(button)
                menu.addAction(action)
        self.more.setMenu(menu)
        words = ", ".join(action.iconText() for group in groups for action in group)
        self.more.setAccessibleName(words)
        show_tooltip(self.more, words)
        row.addWidget(self._buttons)
        row.addWidget(self.more)
        self.fold(folded=False)

    @property
    def wanted_px(self) -> int:
        """Width in which all buttons stand beside each other."""
        return self._buttons.sizeHint().width()

    def fold(self, *, folded: bool) -> None:
        """Show the one button, or all of them."""
        self._buttons.setVisible(not folded)
        self.more.setVisible(folded)
        self.setFixedWidth((self.more if folded else self._buttons).sizeHint().width())


class StudioBar(QToolBar):
    """Choices, transport and a few actions; the actions fold before the choices are cut short.

    Parameters
    ----------
    choices, transport
        What stands in it.
    groups
        Actions, with a line before each group.
    window
        Its parent.

    Attributes
    ----------
    actions_at_end
        The buttons of the actions.
    """

    def __init__(
        self,
        choices: SetupBar,
        transport: QWidget,
        groups: Sequence[Sequence[QAction]],
        window: QMainWindow,
    ) -> None:
        super().__init__("Setup", window)
        self._choices, self._transport = choices, transport
        self.actions_at_end = FoldedActions(groups)
        self.setObjectName("setup")
        self.setMovable(False)
        self.toggleViewAction().setVisible(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        for part in (choices, transport, self.actions_at_end):
            self.addWidget(part)
        window.addToolBar(self)

    def event(self, event: QEvent) -> bool:
        if event.type() in _REFITTED:
            self._fit()
        return super().event(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        layout = self.layout()
        if layout is None:
            return
        room = layout.contentsRect().width() - 2 * layout.spacing()
        room -= self._transport.sizeHint().width() + self.actions_at_end.wanted_px
        self.actions_at_end.fold(folded=room < _CHOICES_SHARE * self._choices.wanted_px)
