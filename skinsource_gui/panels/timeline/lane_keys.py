"""What keys mean on the lanes."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent

from skinsource.design import edits
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gain.gain_points import GainPoints
from skinsource_gui.panels.timeline.overlaps import after, overlapping
from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.time.playhead_moves import PLAYHEAD, moved_playhead
from skinsource_gui.widgets.time.time_scale import panned

_PLACE = "timeline"
_Key = Qt.Key
#: How far an arrow moves clips; with Shift ten times as far.
STEP_S, _LEAP = 0.001, 10
_STEPS = {_Key.Key_Left: -1, _Key.Key_Right: 1, _Key.Key_Up: -1, _Key.Key_Down: 1}
_ZOOM = 1.5


class LaneKeys(QObject):
    """Turns key presses into edits of the selected clips."""

    edited = Signal(object, object)
    looked = Signal(object)
    playhead_wanted = Signal(float)
    copied = Signal()
    cut = Signal()
    pasted = Signal()
    zoomed = Signal(float)
    everything_wanted = Signal()
    opened = Signal(int)
    clip_wanted = Signal(int, float)
    marker_wanted = Signal(float)

    def __init__(self, content: Callable[[], Content], gain: GainPoints, parent: QObject) -> None:
        super().__init__(parent)
        self._content, self._gain = content, gain
        self._burst = Burst(self)
        self._nudged: object = None

    def claims(self, event: QKeyEvent) -> bool:
        """Whether the lanes want this key for themselves, before any shortcut of the window."""
        return bool(meaning_of(_PLACE, event) or meaning_of(PLAYHEAD, event))

    def press(self, event: QKeyEvent) -> bool:
        """Do what a key means; whether it means anything."""
        if self._gain.key(event):
            return True
        content = self._content()
        playhead_s = moved_playhead(event, content.design, content.view.playhead_s)
        if playhead_s is not None:
            self._put_playhead(playhead_s)
            return True
        wanted = meaning_of(_PLACE, event)
        if wanted in ("nudge", "change_track"):
            leap = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
            self._nudge(wanted, _STEPS[_Key(event.key())] * (_LEAP if leap else 1))
        elif wanted == "go":
            self._go(_STEPS[_Key(event.key())])
        elif wanted == "below":
            self._go_below()
        elif wanted == "gain_far":
            self._reach(_STEPS[_Key(event.key())])
        elif wanted == "playhead":
            ends = (clip.end_s for clip in content.design.clips)
            at_start = event.key() == _Key.Key_Home
            self._put_playhead(0.0 if at_start else max(ends, default=0.0))
        else:
            return self._show(wanted) or self._edit(wanted)
        return True

    def _show(self, wanted: str) -> bool:
        """Do what leaves the design as it is; whether that is wanted."""
        content = self._content()
        design, view = content.design, content.view
        if wanted in ("zoom_in", "zoom_out"):
            self.zoomed.emit(_ZOOM if wanted == "zoom_in" else 1 / _ZOOM)
        elif wanted == "whole":
            self.everything_wanted.emit()
        elif wanted == "select_all":
            self.looked.emit(edits.select_all_clips(design, view).view)
        elif wanted == "open":
            for clip in content.chosen[-1:]:
                self.opened.emit(clip)
        else:
            return False
        return True

    def _edit(self, wanted: str) -> bool:
        """Do what changes the design; whether that is wanted."""
        content = self._content()
        design, view = content.design, content.view
        chosen, at_s = content.chosen, view.playhead_s
        if wanted == "copy":
            self.copied.emit()
        elif wanted == "cut":
            self.cut.emit()
        elif wanted == "paste":
            self.pasted.emit()
        elif wanted == "marker":
            self.marker_wanted.emit(at_s)
        elif wanted == "add" and view.selected_input is not None:
            self.clip_wanted.emit(view.selected_input, at_s)
        outcome = {
            "split": lambda: edits.split_clips(design, view, chosen, at_s),
            "repeat": lambda: edits.repeat_clips(design, view, chosen, 2),
            "mute": lambda: edits.toggle_mute_clips(design, view, chosen),
            "duplicate": lambda: edits.duplicate_clips(design, view, chosen),
            "remove": lambda: edits.remove_clips(design, view, chosen),
        }.get(wanted)
        if outcome is not None:
            self.edited.emit(outcome(), None)
        return bool(wanted)

    def _put_playhead(self, time_s: float) -> None:
        content = self._content()
        low, high = content.scale.shown_s
        self.playhead_wanted.emit(time_s)
        if not low <= time_s <= high:
            # What is seen follows, so that the time is in sight again, beside its nearest edge.
            by_s = time_s - (low if time_s < low else high)
            shown_s = panned((low, high), by_s, content.whole_s)
            self.looked.emit(replace(self._content().view, time_range_s=shown_s))

    def _go(self, step: int) -> None:
        """Select the next clip, or the one before, through all tracks."""
        content = self._content()
        design, view = content.design, content.view
        ids = [
            clip.id
            for track in design.inputs
            for clip in sorted(track.clips, key=lambda one: one.onset_s)
        ]
        if not ids:
            return
        chosen = view.selected_clips
        here = ids.index(chosen[-1]) if chosen and chosen[-1] in ids else (-1 if step > 0 else 0)
        self.looked.emit(edits.select_clips(design, view, (ids[(here + step) % len(ids)],)).view)

    def _reach(self, step: int) -> None:
        """Select besides the nearest clip of the next track that has any."""
        content = self._content()
        design, view = content.design, content.view
        for last in content.chosen[-1:]:
            here, onset_s = design.index_of(design.track_of(last).id), design.clip(last).onset_s
            ahead = design.inputs[here + 1 :] if step > 0 else design.inputs[:here][::-1]
            clips = next((track.clips for track in ahead if track.clips), ())
            near = min(clips, key=lambda one: abs(one.onset_s - onset_s), default=None)
            if near is not None:
                kept = (one for one in content.chosen if one != near.id)
                self.looked.emit(edits.select_clips(design, view, (*kept, near.id)).view)

    def _go_below(self) -> None:
        """Select the next of the clips that overlap."""
        content = self._content()
        for clip in content.chosen[-1:]:
            track = content.design.track_of(clip)
            following = after(overlapping(track, content.design.clip(clip)), clip)
            chosen = (clip if following is None else following,)
            self.looked.emit(edits.select_clips(content.design, content.view, chosen).view)

    def _nudge(self, wanted: str, steps: int) -> None:
        content = self._content()
        design, view = content.design, content.view
        aside = wanted == "nudge"
        by_s, by_tracks = (steps * STEP_S, 0) if aside else (0.0, steps)
        outcome = edits.move_clips(design, view, content.chosen, by_s, by_tracks)
        # One burst of nudges is one step of the history; other clips, or upright, are another.
        nudged = (aside, content.chosen)
        if nudged != self._nudged:
            self._burst.end()
            self._nudged = nudged
        self.edited.emit(outcome, self._burst.gesture())
