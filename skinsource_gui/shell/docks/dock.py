"""A dock: what holds a panel in the window."""

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QHideEvent, QMoveEvent, QShowEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QDockWidget,
    QFrame,
    QStyleOptionDockWidget,
    QWidget,
)

from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.shell.docks.dock_icons import close_icon, float_icon
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.room.steady_area import SteadyArea

_BUTTONS = {
    "qt_dockwidget_closebutton": (
        "Hide this panel; View > Panels brings it back",
        close_icon,
    ),
    "qt_dockwidget_floatbutton": (
        "Take this panel out of the window, or back into it",
        float_icon,
    ),
}
_OTHER_LOOK = (QEvent.Type.StyleChange, QEvent.Type.PaletteChange)


class Dock(QDockWidget):
    """Holds a panel, which scrolls where there is too little room.

    The panel is made when the dock first comes into sight.  A panel behind another one, as a tab,
    is hidden, so that nothing is computed for it: Qt only moves its dock to where nobody looks.

    Parameters
    ----------
    name, title
        Those of the panel that it holds.
    panels
        Where it has its panel from.
    window
        Its parent.
    """

    #: The panel is about to be hidden, because another one is in front of it.
    goes_behind = Signal()
    #: The panel came into sight, or left it.
    sight_changed = Signal()

    def __init__(self, name: str, title: str, panels: MadePanels, window: QWidget) -> None:
        super().__init__(title, window)
        self._panels = panels
        self._tabbed = self._behind = False
        self.setObjectName(name)
        self._area = area = SteadyArea()
        area.setObjectName(f"{name}_area")
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setWidget(area)
        _draw_buttons(self)
        self.topLevelChanged.connect(self._follow)
        # The menu of Qt, with the right button on a title, would leave it behind others.
        self.toggleViewAction().triggered.connect(self._raise_shown)

    @property
    def panel(self) -> Panel:
        """What it holds; made now, if nobody has looked at it before."""
        return self._panels[self.objectName()]

    @property
    def is_empty(self) -> bool:
        """Whether its panel was not made yet."""
        return self.objectName() not in self._panels

    @property
    def in_sight(self) -> bool:
        """Whether it is shown, and nothing is in front of it."""
        return not (self.isHidden() or self._behind)

    def hold(self, panel: Panel) -> None:
        """Take its panel, which was just made and knows all that panels are told."""
        self._area.setWidget(panel)
        panel.setVisible(not self._behind)
        self.sight_changed.emit()

    @contextmanager
    def lent(self) -> Iterator[Panel]:
        """Its panel without a place in the window, to be shown elsewhere; it is taken back."""
        panel = self.panel
        self._area.takeWidget()
        try:
            yield panel
        finally:
            self.hold(panel)

    def bring_forward(self) -> None:
        """Show it, in front of those that share its place."""
        self.show()
        self.raise_()

    def show_tabbed(self, tabbed: bool) -> None:
        """Say whether a tab names it, so that its title need not say the same below the tab."""
        if tabbed != self._tabbed:
            self._tabbed = tabbed
            self.update()

    def initStyleOption(self, option: QStyleOptionDockWidget) -> None:
        super().initStyleOption(option)
        if self._tabbed and not self.isFloating():
            option.title = ""

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in _OTHER_LOOK:
            _draw_buttons(self)

    def moveEvent(self, event: QMoveEvent) -> None:
        super().moveEvent(event)
        self._follow()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._follow()

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self.sight_changed.emit()

    def _follow(self) -> None:
        # Qt puts its own icons there, now and then.
        _draw_buttons(self)
        # Qt says whether a dock is behind another one for some of the ways to get there; where it
        # puts those behind is the same for all of them.
        behind = not self.isFloating() and self.geometry().right() < 0
        turned = self._behind != behind
        self._behind = behind
        if turned and behind:
            self.goes_behind.emit()
        if not self.is_empty:
            self.panel.setVisible(not behind)
        elif self.in_sight and self.isVisible():
            # To make it is to have it held.
            self._panels[self.objectName()]
        self.sight_changed.emit()

    def _raise_shown(self) -> None:
        if not self.isHidden():
            self.raise_()


def _draw_buttons(dock: QDockWidget) -> None:
    """Say what the buttons of the title do; those of the style are grey, whatever is behind."""
    direct = Qt.FindChildOption.FindDirectChildrenOnly  # a panel has hundreds of widgets
    for name, (hint, icon) in _BUTTONS.items():
        for button in dock.findChildren(QAbstractButton, name, direct):
            button.setToolTip(hint)
            drawn = icon(current_theme())
            if button.icon().cacheKey() != drawn.cacheKey():
                button.setIcon(drawn)
