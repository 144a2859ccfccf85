"""What mouse and keys do to the gain curves on the lanes."""

from collections.abc import Callable

from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource.design import edits
from skinsource.design.effects.breakpoints import Points, moved, with_point
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gain.gain_strip import GainStrip, curve_of, gain_words
from skinsource_gui.panels.timeline.gestures.gesture import Gesture, Held, Stage
from skinsource_gui.panels.timeline.gestures.move_gain import MoveGain
from skinsource_gui.panels.timeline.settings import show_gain_curves, toggle_gain_curves
from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.keys import meaning_of

_PLACE = "timeline"
_Key = Qt.Key
#: Steps of the arrow keys, s and gain; with Shift so many times as far.
STEP_S, STEP_GAIN, _LEAP = 0.001, 0.01, 10
_ASIDE = {_Key.Key_Left: -1, _Key.Key_Right: 1}
_UPRIGHT = {_Key.Key_Down: -1, _Key.Key_Up: 1}


class GainPoints(QObject):
    """Adds, moves and removes points of gain curves that are shown, and shows and hides them.

    Parameters
    ----------
    content
        Returns what is shown now.

    Attributes
    ----------
    chosen
        Id of a track and number of the point on its curve that keys are about, or None.
    """

    edited = Signal(object, object)
    looked = Signal(object)
    #: Another point is chosen, or none.
    chose = Signal()

    def __init__(self, content: Callable[[], Content], parent: QObject) -> None:
        super().__init__(parent)
        self._content = content
        self._burst = Burst(self)
        self.chosen: tuple[int, int] | None = None

    def strip_at(self, at: QPointF) -> GainStrip | None:
        """The curve that is edited and passes here."""
        content = self._content()
        if at.y() < content.ruler_px:
            return None
        for one in content.strips:
            inside = one.lane.top_px <= at.y() < one.lane.bottom_px
            if one.shown and inside and (one.point_at(at) is not None or one.is_on_line(at)):
                return one
        return None

    def press(self, stage: Stage, at: QPointF, held: Held) -> Gesture | None:
        """The left button went down; None where no curve is caught."""
        strip = self.strip_at(at)
        if strip is None:
            self.choose(None)
            return None
        self._burst.end()
        track, near = strip.lane.track.id, strip.point_at(at)
        if near is not None:
            self.choose((track, near))
            return MoveGain(stage, strip, at, strip.points, (near,))
        time_s = max(strip.scale.time(at.x()), 0.0)
        if held & Held.ControlModifier:
            points, number = _added(strip, time_s)
            gesture = MoveGain(stage, strip, at, points, (number,), fine=False)
            gesture.put(points)
            self.choose((track, number))
            return gesture
        points = strip.points or ((0.0, 1.0, "straight"),)
        return MoveGain(stage, strip, at, points, strip.around(time_s) or (0,), upright=True)

    def double_click(self, at: QPointF) -> bool:
        """Add a point where the curve is pressed twice; whether one is there."""
        strip = self.strip_at(at)
        if strip is None:
            return False
        if strip.point_at(at) is None:
            self._add(strip, max(strip.scale.time(at.x()), 0.0))
        return True

    def key(self, event: QKeyEvent) -> bool:
        """Do what a key means to a curve; whether it means anything to one."""
        wanted, key = meaning_of(_PLACE, event), Qt.Key(event.key())
        if wanted == "gain_curve":
            content = self._content()
            ids = content.view.selected_inputs
            self.looked.emit(toggle_gain_curves(content.design, content.view, ids).view)
            self.choose(None)
        elif wanted == "gain_point":
            self._walk(-1 if key == _Key.Key_PageUp else 1)
        elif wanted == "gain_add":
            strip = self._selected_strip()
            if strip is not None:
                self._add(strip, self._content().view.playhead_s)
        else:
            return self._key_of_point(wanted, key, event.modifiers())
        return True

    def remove(self, track: int, numbers: tuple[int, ...]) -> None:
        """Remove points of a track's curve."""
        design = self._content().design
        if track not in design.ids:
            return
        curve = design.input(track).gain_curve
        left = tuple(one for k, one in enumerate(curve) if k not in numbers)
        self.choose(None)
        self._tell(track, tuple((x, y, "straight") for x, y in left), None)

    def choose(self, chosen: tuple[int, int] | None) -> None:
        """Let keys be about another point, or about none."""
        if chosen != self.chosen:
            self.chosen = chosen
            self.chose.emit()

    def words(self) -> str:
        """The chosen point in words, or "" where there is none."""
        strip, number = self._chosen_strip()
        if strip is None:
            return ""
        return f"Point {number + 1} of the gain curve: {gain_words(*strip.points[number][:2])}"

    def _key_of_point(self, wanted: str, key: Qt.Key, held: Held) -> bool:
        strip, number = self._chosen_strip()
        if strip is None:
            # Held as for a point, where there is none it is for the clips.
            return False
        if wanted == "give_up":
            self.choose(None)
        elif wanted == "remove":
            self.remove(strip.lane.track.id, (number,))
        elif wanted in ("nudge", "change_track", "gain_far"):
            far = _LEAP if held & Held.ShiftModifier else 1
            by_s, by_gain = (
                far * STEP_S * _ASIDE.get(key, 0),
                far * STEP_GAIN * _UPRIGHT.get(key, 0),
            )
            after = moved(strip.points, (number,), by_s, by_gain)
            self._tell(strip.lane.track.id, after, self._burst.gesture())
        else:
            return False
        return True

    def _walk(self, step: int) -> None:
        strip = self._selected_strip()
        if strip is None or not strip.points:
            return
        track, last = strip.lane.track.id, len(strip.points) - 1
        chosen = self.chosen if self.chosen and self.chosen[0] == track else None
        number = (0 if step > 0 else last) if chosen is None else chosen[1] + step
        self._burst.end()
        self.choose((track, min(max(number, 0), last)))

    def _add(self, strip: GainStrip, time_s: float) -> None:
        points, number = _added(strip, time_s)
        track = strip.lane.track.id
        self._tell(track, points, None)
        self.choose((track, number))

    def _tell(self, track: int, points: Points, gesture: int | None) -> None:
        content = self._content()
        curve = curve_of(points)
        self.edited.emit(edits.set_gain_curve(content.design, content.view, track, curve), gesture)

    def _selected_strip(self) -> GainStrip | None:
        """The curve of the track that was selected last; shown, if it was not."""
        content = self._content()
        track = content.view.selected_input
        if track is None:
            return None
        shown = {one.lane.track.id for one in content.strips if one.shown}
        if track not in shown:
            self.looked.emit(show_gain_curves(content.view, shown | {track}))
        strips = self._content().strips
        return next((one for one in strips if one.lane.track.id == track and one.shown), None)

    def _chosen_strip(self) -> tuple[GainStrip | None, int]:
        track, number = self.chosen or (0, 0)
        for one in self._content().strips:
            if one.lane.track.id == track and one.shown and number < len(one.points):
                return one, number
        return None, 0


def _added(strip: GainStrip, time_s: float) -> tuple[Points, int]:
    """The points with one more on the curve, and its number."""
    points = strip.points
    if not points:
        return ((time_s, 1.0, "straight"),), 0
    return with_point(points, time_s), sum(x <= time_s for x, _, _ in points)
