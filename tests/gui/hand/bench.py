"""The hand panel, driven by real mouse and key events."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction, QContextMenuEvent
from PySide6.QtTest import QTest

from skinsource.design.design import Design, Input
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource.limbs.locations import INPUTS
from skinsource_gui.panels.hand.panel import HandPanel
from tests.gui.menus import MOUSE, lines_at

KEY, LEFT = Qt.Key, Qt.MouseButton.LeftButton


NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


CONTROL = Qt.KeyboardModifier.ControlModifier


class Studio:
    """A panel whose wishes come true, and what it wished."""

    def __init__(self, panel: HandPanel) -> None:
        self.panel = panel
        self.diagram = panel.diagram
        self.design = Design(limb="synthetic-1")
        self.view = View(selected_inputs=())
        self.edits: list[tuple[str, Design, int | None]] = []
        self.refusals: list[str] = []
        self.order: list[str] = []
        panel.edited.connect(self._edit)
        panel.view_changed.connect(self._look)

    def show(self, *inputs: Input, selected: int | None = None) -> None:
        self.design = Design(limb="synthetic-1")
        for track in inputs:
            self.design = self.design.adding(track)
        self.view = View(selected_inputs=() if selected is None else (selected + 1,))
        self.panel.show_state(self.design, self.view)

    def _edit(self, outcome: Edit | Refusal, gesture: int | None) -> None:
        if isinstance(outcome, Refusal):
            self.refusals.append(outcome.sentence)
            return
        if outcome.design is self.design:
            self._look(outcome.view)
            return
        self.edits.append((outcome.label, outcome.design, gesture))
        self.order.append("design")
        self.design, self.view = outcome.design, outcome.view
        self.panel.show_state(self.design, self.view)

    def _look(self, view: View) -> None:
        self.order.append("view")
        self.view = view
        self.panel.show_state(self.design, view)

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
