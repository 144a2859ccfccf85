"""What the glide tool does to the clip in the editor."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.effects.breakpoints import Points
from skinsource.design.view import View
from skinsource.design.waveforms import Glide
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.synthesis import Column, Curve, bends_of, curve_of
from skinsource_gui.panels.clip_editor.drag_start import DragStart
from skinsource_gui.panels.clip_editor.tools.adding import add_point
from skinsource_gui.panels.clip_editor.tools.glide import GlideTool
from skinsource_gui.widgets.fields.burst import Burst

_LEAP = 10
_Key = Qt.Key
_TIMES = {_Key.Key_Left: -0.001, _Key.Key_Right: 0.001}
_VALUES = {_Key.Key_Up: 1.0, _Key.Key_Down: -1.0}
#: One step of an arrow key up; with Shift ten.
STEPS: dict[Column, float] = {"frequency": 1.0, "amplitude": 0.01}


class Gliding(QObject):
    """Turns what the tool does to the curves into edits of the glide that a clip plays.

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
        self._rate_hz = facts_of("").sample_rate_hz
        # What was drawn: points that bend nothing yet are not part of a glide.
        self._drawn: dict[Column, Points] = {}
        self._burst = Burst(self)
        self.tool = GlideTool(self._points, self)
        self._start = DragStart()
        self.tool.changed.connect(self._change)
        self.tool.given_up.connect(self._give_up)

    def show_state(self, design: Design, view: View, clip: Clip | None, rate_hz: float) -> None:
        """Take over what there is to shape."""
        if clip is None or self._clip is None or clip.id != self._clip.id:
            self.tool.forget()
            self._drawn = {}
        self._design, self._view, self._clip, self._rate_hz = design, view, clip, rate_hz

    def can_edit(self, clip: Clip | None) -> bool:
        """Whether a clip plays a glide."""
        return clip is not None and isinstance(clip.waveform, Glide)

    def press(self, wanted: str, event: QKeyEvent) -> bool:
        """Do what a key means to the points; whether it means anything."""
        tool = self.tool.tools[self.tool.active]
        if wanted == "remove":
            tool.remove_chosen()
        elif wanted == "add" and self._clip is not None:
            end_s = self._clip.waveform.duration_s
            add_point(tool, self._points(self.tool.active), end_s)
        elif wanted == "flip":
            self.tool.flip()
        elif wanted in ("next_point", "point_before"):
            tool.choose_next(1 if wanted == "next_point" else -1)
        elif wanted == "nudge":
            far = _LEAP if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1
            key = _Key(event.key())
            by_value = far * STEPS[self.tool.active] * _VALUES.get(key, 0.0)
            tool.nudge(far * _TIMES.get(key, 0.0), by_value, self._burst.gesture())
        else:
            return False
        return True

    def _points(self, column: Column) -> Points:
        waveform = None if self._clip is None else self._clip.waveform
        if not isinstance(waveform, Glide):
            return ((0.0, 0.0, "straight"),)
        curve, drawn = curve_of(waveform.points, column), self._drawn.get(column, ())
        if drawn and bends_of(_curve(drawn)) == curve:
            return drawn
        return tuple((x, y, "straight") for x, y in curve)

    def _change(self, column: Column, points: Points, gesture: int | None) -> None:
        if self._clip is None:
            return
        self._start.note(gesture, self._design, self._view)
        # Half the sample rate itself cannot be played.
        most = 1.0 if column == "amplitude" else 0.4999 * self._rate_hz
        kept: Points = tuple((round(x, 12), round(min(y, most), 12), kind) for x, y, kind in points)
        self._drawn[column] = kept
        outcome = edits.set_glide_curve(
            self._design, self._view, self._clip.id, column, _curve(kept)
        )
        self.edited.emit(outcome, gesture)

    def _give_up(self, gesture: int) -> None:
        back = self._start.way_back(gesture)
        if back is not None:
            self._drawn = {}
            self.edited.emit(back, gesture)


def _curve(points: Points) -> Curve:
    return tuple((x, y) for x, y, _ in points)
