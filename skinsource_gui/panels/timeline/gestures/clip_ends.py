"""Ends of a clip that are dragged: trimmed, stretched, faded."""

from PySide6.QtCore import QPointF

from skinsource.design import edits
from skinsource.design.edits.cutting import fades_of
from skinsource_gui.panels.timeline.clip_part import Part
from skinsource_gui.panels.timeline.gestures.gesture import Held, Shown, Stage
from skinsource_gui.panels.timeline.lane import Box
from skinsource_gui.widgets.fields.units import value_text
from skinsource_gui.widgets.time.snapping import Rest, rest_of

# No end comes nearer to the other one than this.
_SHORTEST_S = 0.001


class _OneEnd:
    """An end that follows the pointer."""

    def __init__(self, stage: Stage, box: Box, at: QPointF, part: Part) -> None:
        self._stage, self._clip, self._at, self._part = stage, box.clip, at, part
        self._start_s = box.clip.onset_s
        self._end_s = self._start_s + stage.before.durations_s[box.clip.id]
        self._neighbours = stage.before.neighbours_s(frozenset({box.clip.id}))

    def finish(self) -> None:
        """What is changed stays."""

    def cancel(self) -> None:
        self._stage.take_back()

    def _rest(self, at: QPointF, edge_s: float) -> Rest:
        content = self._stage.content()
        by_s = (at.x() - self._at.x()) / content.scale.px_per_s
        if not content.snaps:
            return Rest(by_s=by_s)
        return rest_of(
            (edge_s,),
            by_s,
            neighbours_s=self._neighbours,
            grid_s=content.grid_s,
            reach_s=content.reach_s,
        )


class MoveEnd(_OneEnd):
    """Drags the start or the end of a clip: trims it; with Alt or Shift held stretches it.

    Some desktops take Alt and a drag for themselves.
    """

    def move(self, at: QPointF, held: Held) -> Shown:
        start_s, end_s = self._start_s, self._end_s
        if self._part is Part.START:
            rest = self._rest(at, start_s)
            start_s = min(max(start_s + rest.by_s, 0.0), end_s - _SHORTEST_S)
        else:
            rest = self._rest(at, end_s)
            end_s = max(end_s + rest.by_s, start_s + _SHORTEST_S)
        stretches = held & (Held.AltModifier | Held.ShiftModifier)
        act = edits.stretch_clip if stretches else edits.trim_clip
        design, view = self._stage.before.design, self._stage.content().view
        self._stage.edit(act(design, view, self._clip.id, start_s, end_s))
        length = value_text(end_s - start_s, "s", digits=5)
        words = f"Stretched to {length}" if stretches else f"{length} · Shift: stretch"
        return Shown(guide_s=rest.guide_s, words=words)


class FadeEnd(_OneEnd):
    """Drags an upper corner of a clip: how long it takes to fade in, or out."""

    def move(self, at: QPointF, held: Held) -> Shown:
        content = self._stage.content()
        by_s = (at.x() - self._at.x()) / content.scale.px_per_s
        in_s, out_s = fades_of(self._clip)
        length_s = self._end_s - self._start_s
        if self._part is Part.FADE_IN:
            changed = in_s = min(max(in_s + by_s, 0.0), length_s - out_s)
        else:
            changed = out_s = min(max(out_s - by_s, 0.0), length_s - in_s)
        design = self._stage.before.design
        self._stage.edit(edits.fade_clip(design, content.view, self._clip.id, in_s, out_s))
        return Shown(words=value_text(changed, "s", digits=4))
