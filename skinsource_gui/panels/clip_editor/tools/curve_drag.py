"""A drag of breakpoints in the clip editor."""

from dataclasses import dataclass

from PySide6.QtCore import QPointF

from skinsource.design.effects.breakpoints import Points
from skinsource_gui.panels.clip_editor.tools.points_box import Handle


@dataclass(slots=True)
class Drag:
    """Points as they were when the button went down, and which of them move."""

    points: Points
    chosen: tuple[int, ...]
    start: tuple[float, float]
    number: int
    upright: bool = False
    added: bool = False
    box: QPointF | None = None
    handle: Handle | None = None
    moved: bool = False
    # The points without the one that the press added.
    before: Points = ()
