"""What the envelope tool does to the clip in the editor."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.effects import Envelope
from skinsource.design.effects.breakpoints import Points
from skinsource.design.effects.level import UNCHANGED
from skinsource.design.view import View
from skinsource_gui.panels.clip_editor.drag_start import DragStart
from skinsource_gui.panels.clip_editor.tools.adding import add_point
from skinsource_gui.panels.clip_editor.tools.envelope import EnvelopeTool
from skinsource_gui.widgets.fields.burst import Burst

#: One step of an arrow key; with Shift ten.
STEP_S, STEP = 0.001, 0.01
_LEAP = 10
_Key = Qt.Key
_STEPS = {
    _Key.Key_Left: (-STEP_S, 0.0),
    _Key.Key_Right: (STEP_S, 0.0),
    _Key.Key_Up: (0.0, STEP),
    _Key.Key_Down: (0.0, -STEP),
}


class Shaping(QObject):
    """Turns what the tool does to the points into edits of the clip's envelope.

    Attributes
    ----------
    tool
        The tool.
    """

    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._clip: Clip | None = None
        self._burst = Burst(self)
        self.tool = EnvelopeTool(self._points, self)
        self._start = DragStart()
        self.tool.changed.connect(self._change)
        self.tool.given_up.connect(self._give_up)

    def show_state(self, design: Design, view: View, clip: Clip | None) -> None:
        """Take over what there is to shape."""
        if clip is None or self._clip is None or clip.id != self._clip.id:
            self.tool.chosen = ()
        self._design, self._view, self._clip = design, view, clip

    def press(self, wanted: str, event: QKeyEvent) -> bool:
        """Do what a key means to the points; whether it means anything."""
        if wanted == "remove":
            self.tool.remove_chosen()
        elif wanted == "add" and self._clip is not None:
            add_point(self.tool, self._points(), self._clip.duration_s)
        elif wanted in ("next_point", "point_before"):
            self.tool.choose_next(1 if wanted == "next_point" else -1)
        elif wanted == "nudge":
            by_s, by_value = _STEPS[_Key(event.key())]
            leap = _LEAP if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1
            self.tool.nudge(by_s * leap, by_value * leap, self._burst.gesture())
        else:
            return False
        return True

    def _points(self) -> Points:
        effects = () if self._clip is None else self._clip.effects
        envelopes = [one for one in effects if isinstance(one, Envelope)]
        return envelopes[-1].points if envelopes else UNCHANGED

    def _change(self, points: Points, gesture: int | None) -> None:
        if self._clip is not None:
            self._start.note(gesture, self._design, self._view)
            outcome = edits.set_envelope(self._design, self._view, self._clip.id, points)
            self.edited.emit(outcome, gesture)

    def _give_up(self, gesture: int) -> None:
        back = self._start.way_back(gesture)
        if back is not None:
            self.edited.emit(back, gesture)
