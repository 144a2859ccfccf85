"""What is said of the part of a clip under the pointer."""

from PySide6.QtCore import QPointF

from skinsource_gui.panels.timeline.clip_part import Part, part_at
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.widgets.keys import MOUSE, key_text
from skinsource_gui.widgets.tooltips import tooltip

_NEXT = key_text("timeline", "below")
_END = ("trim", "stretch")
_CORNER = ("fade",)
_GESTURES = {
    Part.START: _END,
    Part.END: _END,
    Part.FADE_IN: _CORNER,
    Part.FADE_OUT: _CORNER,
}


def hover_words(content: Content, at: QPointF) -> str:
    """Why the clip here cannot be played, what can be dragged, how many clips lie here; or ""."""
    box = content.box_at(at)
    if box is None:
        return ""
    count = len(content.boxes_at(at))
    several = f"{count} clips here: click again, or {_NEXT}, for the next" if count > 1 else ""
    names = _GESTURES.get(part_at(box.rect, at, box.fades_px), ())
    return tooltip(box.lane.problem, several, *MOUSE["clips"].sentences(*names))
