"""Points of a gain curve that are dragged."""

from PySide6.QtCore import QPointF

from skinsource.design import edits
from skinsource.design.effects.breakpoints import Points, moved
from skinsource_gui.panels.timeline.gain.gain_strip import GainStrip, curve_of, gain_words
from skinsource_gui.panels.timeline.gestures.gesture import Held, Shown, Stage
from skinsource_gui.widgets.time.snapping import rest_of

_FINE = 0.1
# From how far away a point comes to rest on a gain of 1, px.
_REACH_PX = 2.5


class MoveGain:
    """Drags points of a gain curve: one of them, or both ends of a line up and down.

    Shift: along time or gain only.  Ctrl: finely.  Alt: without snapping.

    Parameters
    ----------
    points, chosen
        The points as they are when the button goes down, and numbers of those that move.
    upright
        Whether they only go up and down.
    fine
        Whether Ctrl makes it fine; not where Ctrl has just made the point.
    """

    def __init__(
        self,
        stage: Stage,
        strip: GainStrip,
        at: QPointF,
        points: Points,
        chosen: tuple[int, ...],
        *,
        upright: bool = False,
        fine: bool = True,
    ) -> None:
        self._stage, self._strip, self._at = stage, strip, at
        self._points, self._chosen = points, chosen
        self.upright, self._fine = upright, fine

    def move(self, at: QPointF, held: Held) -> Shown:
        strip, scale = self._strip, self._stage.content().scale
        way = at - self._at
        by_s, by_gain = way.x() / scale.px_per_s, -way.y() * strip.top / strip.height_px
        if self._fine and held & Held.ControlModifier:
            by_s, by_gain = by_s * _FINE, by_gain * _FINE
        upright = self.upright
        if held & Held.ShiftModifier:
            upright = upright or abs(way.y()) > abs(way.x())
            by_gain = by_gain if upright else 0.0
        if upright:
            by_s = 0.0
        time_s, gain, _ = self._points[self._chosen[0]]
        free = bool(held & Held.AltModifier)
        guide_s = None
        if by_s and not free:
            by_s, guide_s = self._rest(time_s, by_s)
        if not free and abs(strip.y(gain + by_gain) - strip.y(1.0)) <= _REACH_PX and by_gain:
            by_gain = 1.0 - gain
        after = moved(self._points, self._chosen, by_s, by_gain)
        self.put(after)
        x, y, _ = after[self._chosen[0]]
        return Shown(guide_s=guide_s, words=gain_words(x, y))

    def put(self, points: Points) -> None:
        """Give the track these points."""
        before, view = self._stage.before, self._stage.content().view
        track = self._strip.lane.track.id
        self._stage.edit(edits.set_gain_curve(before.design, view, track, curve_of(points)))

    def finish(self) -> None:
        """They stay there."""

    def cancel(self) -> None:
        self._stage.take_back()

    def _rest(self, time_s: float, by_s: float) -> tuple[float, float | None]:
        content = self._stage.content()
        if not content.snaps:
            return by_s, None
        rest = rest_of(
            (time_s,),
            by_s,
            neighbours_s=self._stage.before.neighbours_s(),
            grid_s=content.grid_s,
            reach_s=content.reach_s,
        )
        return rest.by_s, rest.guide_s
