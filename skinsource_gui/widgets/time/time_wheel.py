"""What the wheel does to the part of the time that is seen."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent

from skinsource_gui.widgets.time.time_scale import Range, TimeScale, panned, zoomed
from skinsource_gui.widgets.wheel import NOTCH, PAN_PER_NOTCH, ZOOM_PER_NOTCH


def range_by_wheel(event: QWheelEvent, scale: TimeScale, whole_s: Range) -> Range | None:
    """The range that a turn leads to; None where it is the whole.

    With Shift, or sideways, it goes along the time; otherwise, and with Ctrl, it zooms around the
    pointer.
    """
    turns, held = event.angleDelta(), event.modifiers()
    along = held & Qt.KeyboardModifier.ShiftModifier or turns.x()
    if along and not held & Qt.KeyboardModifier.ControlModifier:
        low, high = scale.shown_s
        notches = (turns.x() or turns.y()) / NOTCH
        return panned(scale.shown_s, -notches * PAN_PER_NOTCH * (high - low), whole_s)
    anchor_s = scale.time(event.position().x())
    factor = ZOOM_PER_NOTCH ** ((turns.y() or turns.x()) / NOTCH)
    return zoomed(scale.shown_s, anchor_s, factor, whole_s)
