"""What is dragged on the ruler: playhead, loop, markers; and the ground, which pans."""

from dataclasses import replace

from PySide6.QtCore import QPointF

from skinsource.design import edits
from skinsource.design.clips import Marker
from skinsource_gui.panels.timeline.gestures.gesture import Held, Shown, Stage
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.time.snapping import rest_of
from skinsource_gui.widgets.time.time_scale import panned


def snapped_time(
    stage: Stage, at: QPointF, without: float | None = None
) -> tuple[float, float | None]:
    """Time at a place, not before 0, and what it snapped to; never to the time ``without``."""
    content = stage.content()
    time_s = max(content.scale.time(at.x()), 0.0)
    if not content.snaps:
        return time_s, None
    near = [one for one in stage.before.neighbours_s() if one != without]
    rest = rest_of(
        (0.0,), time_s, neighbours_s=near, grid_s=content.grid_s, reach_s=content.reach_s
    )
    return max(rest.by_s, 0.0), rest.guide_s


class MovePlayhead:
    """Puts the playhead under the pointer."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    def move(self, at: QPointF, held: Held) -> Shown:
        time_s, guide_s = snapped_time(self._stage, at, self._stage.before.view.playhead_s)
        self._stage.put_playhead(time_s)
        return Shown(guide_s=guide_s, words=value_text(time_s, "s", digits=5))

    def finish(self) -> None:
        """It stays there."""

    def cancel(self) -> None:
        self._stage.put_playhead(self._stage.before.view.playhead_s)


class MoveLoop:
    """Draws the loop region, or moves one of its ends: ``fixed_s`` is the other one."""

    def __init__(self, stage: Stage, fixed_s: float) -> None:
        self._stage, self._fixed_s = stage, fixed_s

    def move(self, at: QPointF, held: Held) -> Shown:
        time_s, guide_s = snapped_time(self._stage, at)
        ends = (min(time_s, self._fixed_s), max(time_s, self._fixed_s))
        design, view = self._stage.before.design, self._stage.content().view
        self._stage.edit(edits.set_loop(design, view, ends if ends[0] < ends[1] else None))
        return Shown(guide_s=guide_s, words=value_text(ends[1] - ends[0], "s", digits=4))

    def finish(self) -> None:
        """It stays there."""

    def cancel(self) -> None:
        self._stage.take_back()


class MoveMarker:
    """Drags a marker."""

    def __init__(self, stage: Stage, marker: Marker) -> None:
        self._stage, self._marker = stage, marker

    def move(self, at: QPointF, held: Held) -> Shown:
        time_s, guide_s = snapped_time(self._stage, at, self._marker.time_s)
        design, view = self._stage.before.design, self._stage.content().view
        index = self._stage.before.design.markers.index(self._marker)
        self._stage.edit(edits.move_marker(design, view, index, time_s))
        return Shown(guide_s=guide_s, words=value_text(time_s, "s", digits=5))

    def finish(self) -> None:
        """It stays there."""

    def cancel(self) -> None:
        self._stage.take_back()


class Pan:
    """Moves the visible part of the time with the pointer."""

    def __init__(self, stage: Stage, at: QPointF) -> None:
        self._stage, self._at = stage, at

    def move(self, at: QPointF, held: Held) -> Shown:
        before = self._stage.before
        by_s = (self._at.x() - at.x()) / before.scale.px_per_s
        shown = panned(before.scale.shown_s, by_s, before.whole_s)
        self._stage.look(replace(self._stage.content().view, time_range_s=shown))
        return Shown()

    def finish(self) -> None:
        """It stays there."""

    def cancel(self) -> None:
        view = self._stage.content().view
        self._stage.look(replace(view, time_range_s=self._stage.before.view.time_range_s))
