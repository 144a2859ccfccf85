"""The hand panel, driven by real mouse and key events."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction, QContextMenuEvent
from PySide6.QtTest import QTest

from skinsource import Design, Input, View
from skinsource.limbs.locations import INPUTS
from skinsource_gui.panels.hand.panel import HandPanel
from tests.gui.menus import MOUSE, lines_at
from tests.gui.panel_host import PanelHost

KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton


NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


CONTROL = Qt.KeyboardModifier.ControlModifier


class Studio(PanelHost):
    """The hand on a design without inputs."""

    def __init__(self, qtbot, width=260, height=330, limb="synthetic-1") -> None:
        super().__init__(HandPanel(), Design(limb=limb), View(selected_inputs=()))
        self.diagram = self.panel.diagram
        self.appear(qtbot, width, height)

    def put(self, *inputs: Input, selected: int | None = None) -> None:
        """Show these inputs alone."""
        design = Design(limb="synthetic-1")
        for track in inputs:
            design = design.adding(track)
        self.show(design, selected_inputs=() if selected is None else (selected + 1,))

    @property
    def sites(self) -> list[int]:
        return [track.location for track in self.design.inputs]

    def click(self, site: int, modifier: Qt.KeyboardModifier = NONE) -> None:
        QTest.mouseClick(self.diagram, LEFT, modifier, self.diagram.site_centre(site))

    def press(self, site: int) -> None:
        QTest.mousePress(self.diagram, LEFT, NONE, self.diagram.site_centre(site))

    def drag_to(self, point: QPoint) -> None:
        QTest.mouseMove(self.diagram, point)

    def release(self, point: QPoint) -> None:
        QTest.mouseRelease(self.diagram, LEFT, NONE, point)

    def keys(self, *keys: Qt.Key, modifier: Qt.KeyboardModifier = NONE) -> None:
        for key in keys:
            QTest.keyClick(self.diagram, key, modifier)

    def menu(self, site: int, reason: QContextMenuEvent.Reason = MOUSE) -> dict[str, QAction]:
        return lines_at(
            self.panel, "hand_menu", self.diagram, self.diagram.site_centre(site), reason
        )


def short(site: int) -> str:
    return INPUTS[site - 1].short_name


def contrast(colour, other):
    """Contrast ratio of two colours, 1 to 21 (WCAG 2.1)."""
    darker, lighter = sorted((_luminance(colour), _luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour):
    def linear(share):
        return share / 12.92 if share <= 0.03928 else ((share + 0.055) / 1.055) ** 2.4

    red, green, blue = (linear(s) for s in (colour.redF(), colour.greenF(), colour.blueF()))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
