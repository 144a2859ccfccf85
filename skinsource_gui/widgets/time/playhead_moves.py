"""What keys do to the playhead, wherever there is one."""

from bisect import bisect_left, bisect_right

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from skinsource.design.design import Design
from skinsource_gui.widgets.keys import meaning_of

#: Where these keys stand in the table of keys.
PLAYHEAD = "playhead"
#: How far a key moves it, s; with Shift so many times as far.
STEP_S, _LEAP = 0.001, 10
_BACK = (Qt.Key.Key_Left, Qt.Key.Key_PageUp)


def moved_playhead(event: QKeyEvent, design: Design, playhead_s: float) -> float | None:
    """Where a key puts the playhead, s; None where it means nothing to it."""
    wanted, back = meaning_of(PLAYHEAD, event), Qt.Key(event.key()) in _BACK
    if wanted == "step":
        leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        by_s = STEP_S * (_LEAP if leap else 1)
        # Sums of decimal steps shall be short to read.
        return max(round(playhead_s + (-by_s if back else by_s), 9), 0.0)
    if wanted != "stop":
        return None
    stops = stops_of(design)
    if back:
        return stops[max(bisect_left(stops, playhead_s) - 1, 0)]
    return stops[min(bisect_right(stops, playhead_s), len(stops) - 1)]


def stops_of(design: Design) -> tuple[float, ...]:
    """Rising times at which something is: the start, ends of clips and of the loop, markers, s."""
    found = {0.0, *(one.time_s for one in design.markers), *(design.loop_s or ())}
    for clip in design.clips:
        found.update((clip.onset_s, clip.end_s))
    return tuple(sorted(found))
