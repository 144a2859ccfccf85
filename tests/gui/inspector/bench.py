"""What the tests of this folder share."""

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from skinsource.design.design import Design, track
from skinsource.design.edits.edit import Refusal
from skinsource.design.view import View
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.inspector.panel import InspectorPanel
from skinsource_gui.plots.preview import WaveformPreview
from skinsource_gui.qt.buttons import Fold


class Bench:
    """A panel and the little of a document that it needs."""

    def __init__(self, qtbot, design, selected=0):
        self.panel = InspectorPanel()
        qtbot.addWidget(self.panel)
        self.design, self.view = design, View(selected_inputs=(selected + 1,))
        self.edits = []
        self.refusals = []
        self.panel.edited.connect(self._edit)
        self.panel.resize(320, 460)
        self.panel.show_state(self.design, self.view)
        self.panel.show()
        qtbot.waitExposed(self.panel)
        self.panel.activateWindow()
        qtbot.waitUntil(self.panel.isActiveWindow)

    @property
    def track(self):
        return self.design.input(self.view.selected_input)

    @property
    def labels(self):
        return [label for label, _, _ in self.edits]

    def number(self, name):
        return self.panel.findChild(NumberField, f"{name}_field")

    def choice(self, name):
        return self.panel.findChild(ChoiceField, f"{name}_field")

    def label(self, name):
        return self.panel.findChild(QLabel, name)

    @property
    def preview(self):
        return self.panel.findChild(WaveformPreview, "waveform_preview")

    def open(self, fold):
        """Unfold a part of the panel."""
        self.panel.findChild(Fold, fold).setChecked(True)

    def show(self, design=None, **looking):
        self.design = design or self.design
        self.view = replace(self.view, **looking)
        self.panel.show_state(self.design, self.view)

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
        waveforms = tuple(
            tuple(clip.waveform.samples(1300.0) for clip in track.clips)
            for track in self.design.inputs
        )
        inputs = self.design.inputs
        return {"clip_waveforms": waveforms, "inputs": inputs, "sample_rate_hz": 1300.0}

    def _edit(self, outcome, gesture):
        if isinstance(outcome, Refusal):
            self.refusals.append(outcome.sentence)
            return
        self.edits.append((outcome.label, outcome.design, gesture))
        self.view = outcome.view
        self.show(outcome.design)


def design_of(*waveforms):
    design = Design(limb="synthetic-1")
    for place, waveform in enumerate(waveforms, start=7):
        design = design.adding(track(location=place, waveform=waveform))
    return design
