"""A point that a key adds to a curve."""

from skinsource.design.effects.breakpoints import Points, with_point_after
from skinsource_gui.panels.clip_editor.tools.envelope import EnvelopeTool


def add_point(tool: EnvelopeTool, points: Points, end_s: float) -> None:
    """Add a point on the curve, halfway from the chosen one to the next, or to ``end_s``.

    It is chosen then, so that the arrow keys move it.
    """
    chosen = tool.chosen[-1] if tool.chosen else 0
    added, number = with_point_after(points, chosen, end_s)
    tool.chosen = (number,)
    tool.changed.emit(added, None)
