"""A rectangle that selects."""

from dataclasses import replace

from PySide6.QtCore import QPointF, QRectF

from skinsource.design import edits
from skinsource_gui.panels.timeline.gestures.gesture import Held, Shown, Stage


class Marquee:
    """Selects the clips that a rectangle touches, over all lanes; with Ctrl held adds them."""

    def __init__(self, stage: Stage, at: QPointF) -> None:
        self._stage = stage
        scale = stage.before.scale
        # It stays at its time while the view pans.
        self._from = (scale.time(at.x()), at.y())

    def move(self, at: QPointF, held: Held) -> Shown:
        content = self._stage.content()
        down = QPointF(content.scale.x(self._from[0]), self._from[1])
        covered = QRectF(down, at).normalized()
        # One that is drawn straight along a lane has no height, and would touch nothing.
        touching = covered.adjusted(-0.5, -0.5, 0.5, 0.5)
        found = [box.clip.id for box in content.boxes if box.rect.intersects(touching)]
        kept = self._stage.before.view.selected_clips if held & Held.ControlModifier else ()
        chosen = (*(one for one in kept if one not in found), *found)
        self._stage.look(edits.select_clips(content.design, content.view, chosen).view)
        return Shown(covered=covered)

    def finish(self) -> None:
        """What is selected stays."""

    def cancel(self) -> None:
        view = self._stage.before.view
        self._stage.look(
            replace(
                self._stage.content().view,
                selected_clips=view.selected_clips,
                selected_inputs=view.selected_inputs,
            )
        )
