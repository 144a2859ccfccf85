"""What the tests of this folder share."""

from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Design, track
from skinsource.design.edits.edit import Refusal
from skinsource.design.view import View
from skinsource_gui.panels.timeline.heads import InputRows
from skinsource_gui.panels.timeline.panel import TimelinePanel

PLACES = (7, 2, 15)


class Bench:
    """A panel and the little of a document and a window that it needs."""

    def __init__(self, qtbot, design, selected=0):
        self.panel = TimelinePanel()
        qtbot.addWidget(self.panel)
        self.design, self.view = (
            design,
            View(selected_inputs=() if selected < 0 else (selected + 1,)),
        )
        self.edits = []
        self.refusals = []
        self.requests = []
        self.panel.edited.connect(self._edit)
        self.panel.view_changed.connect(self._look)
        self.panel.playhead_requested.connect(self._put_playhead)
        self.panel.resize(760, 300)
        self.panel.show_state(self.design, self.view)
        self.panel.show()
        qtbot.waitExposed(self.panel)
        self.panel.activateWindow()
        self.rows.setFocus()
        qtbot.waitUntil(self.rows.hasFocus)

    @property
    def rows(self):
        return self.panel.findChild(InputRows, "input_rows")

    def row(self, index):
        return self.rows.rows[index]

    @property
    def labels(self):
        return [label for label, _, _ in self.edits]

    @property
    def places(self):
        return [track.location for track in self.design.inputs]

    def show(self, design):
        self.design = design
        self.panel.show_state(self.design, self.view)

    def key(self, key, modifiers=Qt.KeyboardModifier.NoModifier):
        QTest.keyClick(QApplication.focusWidget(), key, modifiers)

    def _edit(self, outcome, gesture):
        if isinstance(outcome, Refusal):
            self.refusals.append(outcome.sentence)
            return
        if outcome.design is self.design:
            self._look(outcome.view)
            return
        self.edits.append((outcome.label, outcome.design, gesture))
        self.requests.append("edit")
        self.view = outcome.view
        self.show(outcome.design)

    def _put_playhead(self, time_s):
        self.view = replace(self.view, playhead_s=time_s)
        self.panel.show_playhead(self.view)

    def _look(self, view):
        self.requests.append("view")
        self.view = view
        self.panel.show_state(self.design, self.view)


def design_of(*places, **changes):
    design = Design(limb="synthetic-1")
    for place in places:
        design = design.adding(track(location=place, **changes))
    return design


def click(widget, at=None):
    QTest.mouseClick(widget, Qt.MouseButton.LeftButton, pos=at or widget.rect().center())


def results_of(design):
    """What the engine would tell of a design, so far as the panel needs it."""
    waveforms = tuple(
        tuple(clip.waveform.samples(1300.0) for clip in track.clips) for track in design.inputs
    )
    return {"clip_waveforms": waveforms, "inputs": design.inputs, "sample_rate_hz": 1300.0}
