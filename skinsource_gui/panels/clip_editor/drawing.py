"""What the pen does to the clip in the editor."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QMessageBox, QWidget

from skinsource.base.arrays import Floats
from skinsource.base.quoting import sentence
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits import Refusal
from skinsource.design.view import View
from skinsource.design.waveforms import Drawn, Waveform
from skinsource_gui.panels.clip_editor.drag_start import DragStart
from skinsource_gui.panels.clip_editor.tools.pen import Pen
from skinsource_gui.widgets.inputs.input_words import figure_text


class Drawing(QWidget):
    """Turns strokes into edits; a clip that is not drawn asks once whether it may become samples.

    Attributes
    ----------
    pen
        The tool.
    """

    edited = Signal(object, object)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.hide()
        self.pen = Pen(self)
        self._design, self._view = Design(limb=""), View()
        self._clip: Clip | None = None
        self._rate_hz = 1.0
        # By identity: another design has clips of the same numbers.
        self._allowed: Waveform | None = None
        self._start = DragStart()
        self.pen.drawn.connect(self._draw)
        self.pen.given_up.connect(self._give_up)
        self.pen.refused.connect(self._refuse)

    def show_state(self, design: Design, view: View, clip: Clip | None, rate_hz: float) -> None:
        """Take over what there is to draw on."""
        self._design, self._view, self._clip, self._rate_hz = design, view, clip, rate_hz

    def may_draw(self, clip: Clip) -> bool:
        """Whether nothing need be asked before a clip is drawn on."""
        return isinstance(clip.waveform, Drawn) or self._allowed is clip.waveform

    def is_allowed(self, clip: Clip) -> bool:
        """Whether a clip may become samples; asks, unless it is drawn or was asked before."""
        if self.may_draw(clip):
            return True
        answer = QMessageBox.question(
            self.parentWidget(),
            "Draw over the waveform?",
            f"The clip plays {figure_text(clip.waveform)}. What you draw turns it into samples: "
            "its numbers can then no longer be changed. Undo brings them back.",
            QMessageBox.StandardButton.Ok | QMessageBox.StandardButton.Cancel,
        )
        if answer == QMessageBox.StandardButton.Ok:
            self._allowed = clip.waveform
        return self._allowed is clip.waveform

    def bound(self) -> None:
        """Take away what lies outside the measured band."""
        if self._clip is not None:
            outcome = edits.bound_clip(self._design, self._view, self._clip.id, self._rate_hz)
            self.edited.emit(outcome, None)

    def _draw(self, samples: Floats, stroke: int) -> None:
        if self._clip is None:
            return
        self._start.note(stroke, self._design, self._view)
        id = self._clip.id
        outcome = edits.draw_clip(self._design, self._view, id, samples, self._rate_hz)
        self.edited.emit(outcome, stroke)

    def _give_up(self, stroke: int) -> None:
        back = self._start.way_back(stroke)
        if back is not None:
            self.edited.emit(back, stroke)

    def _refuse(self, why: str) -> None:
        self.edited.emit(Refusal(sentence=sentence(why)), None)
