"""A panel without a studio: what it wishes comes true and is kept."""

from dataclasses import replace
from itertools import compress

import numpy as np

from skinsource.design.design import View
from skinsource.design.edits.edit import Refusal


class PanelHost:
    """Shows a design in a panel, and does what the panel wants of it.

    Attributes
    ----------
    edits
        Label, design and gesture of each edit.
    views
        Views that it was shown, but for those of `show`.
    refusals
        Sentences of edits that cannot be made.
    """

    def __init__(self, panel, design, view=None):
        self.panel, self.design, self.view = panel, design, view or View()
        self.edits, self.views, self.refusals = [], [], []
        panel.edited.connect(self._edit)
        panel.view_changed.connect(self.look)

    @property
    def labels(self):
        return [label for label, _, _ in self.edits]

    @property
    def gestures(self):
        return [gesture for _, _, gesture in self.edits]

    def appear(self, qtbot, width, height):
        """Have it seen."""
        qtbot.addWidget(self.panel)
        self.panel.resize(width, height)
        self.show()
        self.panel.show()
        qtbot.waitExposed(self.panel)

    def activate(self, qtbot):
        """Give it the keyboard."""
        self.panel.activateWindow()
        qtbot.waitUntil(self.panel.isActiveWindow)

    def show(self, design=None, **looking):
        """Show a design, the present one by default, in another view."""
        self.design, self.view = design or self.design, replace(self.view, **looking)
        self.panel.show_state(self.design, self.view)

    def look(self, view):
        self.views.append(view)
        self.view = view
        self.show()

    def _edit(self, outcome, gesture):
        if isinstance(outcome, Refusal):
            self.refusals.append(outcome.sentence)
            return
        if outcome.design is self.design:
            self.look(outcome.view)
            return
        self.edits.append((outcome.label, outcome.design, gesture))
        self.view = outcome.view
        self.show(outcome.design)


def clip_results(design, rate_hz=1300.0):
    """What the engine tells of the clips of a design."""
    waveforms = tuple(
        tuple(clip.waveform.samples(rate_hz) for clip in track.clips) for track in design.inputs
    )
    # One clip behind the other is as loud as they are in their places.
    played = tuple(
        np.concatenate([np.zeros(1), *compress(clips, (not clip.muted for clip in track.clips))])
        for track, clips in zip(design.inputs, waveforms, strict=True)
    )
    return {
        "clip_waveforms": waveforms,
        "input_waveforms": played,
        "inputs": design.inputs,
        "sample_rate_hz": rate_hz,
    }
