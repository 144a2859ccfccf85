"""What the tests of this folder share."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from skinsource import Design, View, track
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.inspector.panel import InspectorPanel
from skinsource_gui.qt.buttons import Fold
from tests.gui.panel_host import PanelHost, clip_results


class Bench(PanelHost):
    """The inspector, with the keyboard."""

    def __init__(self, qtbot, design):
        super().__init__(InspectorPanel(), design, View(selected_inputs=(1,)))
        self.appear(qtbot, 320, 460)
        self.activate(qtbot)

    @property
    def track(self):
        return self.design.input(self.view.selected_input)

    def number(self, name):
        return self.panel.findChild(NumberField, f"{name}_field")

    def choice(self, name):
        return self.panel.findChild(ChoiceField, f"{name}_field")

    def label(self, name):
        return self.panel.findChild(QLabel, name)

    def open(self, fold):
        """Unfold a part of the panel."""
        self.panel.findChild(Fold, fold).setChecked(True)

    def type(self, name, text):
        field = self.number(name)
        field.setFocus()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)

    def choose(self, name, text):
        box = self.choice(name)
        box.setFocus()
        QTest.keyClicks(box, text)

    def results(self):
        return clip_results(self.design)


def design_of(*waveforms):
    design = Design(limb="synthetic-1")
    for place, waveform in enumerate(waveforms, start=7):
        design = design.adding(track(location=place, waveform=waveform))
    return design
