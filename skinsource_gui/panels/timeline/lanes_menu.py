"""What the right button offers on clips, on the ground and on the ruler."""

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QObject, QPoint, QPointF, Qt, Signal
from PySide6.QtWidgets import QInputDialog, QMenu, QWidget

from skinsource.design import edits
from skinsource.design.edits import Edit, Refusal
from skinsource.limbs.locations import input_words
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panels.timeline.content import Content
from skinsource_gui.panels.timeline.gain.gain_points import GainPoints
from skinsource_gui.panels.timeline.gain.gain_strip import GainStrip
from skinsource_gui.panels.timeline.lane import Box
from skinsource_gui.panels.timeline.lane_mouse import marker_at
from skinsource_gui.panels.timeline.overlaps import clip_words
from skinsource_gui.panels.timeline.settings import toggle_gain_curves
from skinsource_gui.panels.timeline.timeline_edits import TimelineEdits
from skinsource_gui.widgets.keys import key_text

AnyEdit = Callable[..., Edit | Refusal]
_PLACE = "timeline"


class LanesMenu(QObject):
    """Opens the menu of what lies under the pointer.

    Parameters
    ----------
    content
        Returns what is shown now.
    clips, gain
        Do what the keys do too.
    parent
        Over which it opens.
    """

    edited = Signal(object, object)
    looked = Signal(object)
    opened = Signal(int)

    def __init__(
        self,
        content: Callable[[], Content],
        clips: TimelineEdits,
        gain: GainPoints,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._content, self._clips, self._gain, self._parent = content, clips, gain, parent

    def open(self, at: QPoint, place: QPointF) -> None:
        """Open the menu of a place, at a place of the screen."""
        content = self._content()
        box = content.box_at(place)
        menu = QMenu(self._parent)
        menu.setObjectName("lanes_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        time_s = max(content.scale.time(place.x()), 0.0)
        if place.y() < content.ruler_px:
            self._fill_ruler(menu, content, place, time_s)
        elif (strip := self._gain.strip_at(place)) is not None:
            self._fill_curve(menu, strip, place)
        elif box is not None:
            if box.clip.id not in content.view.selected_clips:
                self.looked.emit(
                    edits.select_clips(content.design, content.view, (box.clip.id,)).view
                )
            self._fill_clips_here(menu, content.boxes_at(place))
            self._fill_clip(menu, box.clip.id)
        else:
            self._fill_ground(menu, content, place, time_s)
        menu.popup(at)

    def _fill_clips_here(self, menu: QMenu, boxes: Sequence[Box]) -> None:
        """Where clips lie over each other, offer to select each of them."""
        if len(boxes) < 2:
            return
        here = menu.addMenu("Clips here")
        here.setObjectName("clips_here")
        for box in boxes:
            line = here.addAction(clip_words(box.clip))
            line.setCheckable(True)
            line.setChecked(box.clip.id in self._content().view.selected_clips)
            line.triggered.connect(partial(self._select, box.clip.id))
        menu.addSeparator()

    def _select(self, clip: int, _checked: bool = False) -> None:
        content = self._content()
        self.looked.emit(edits.select_clips(content.design, content.view, (clip,)).view)

    def _fill_clip(self, menu: QMenu, clip: int) -> None:
        content = self._content()
        chosen = content.view.selected_clips
        several = len(chosen) > 1
        what = f"{len(chosen)} clips" if several else "clip"
        self._line(menu, "Edit clip", "open", lambda: self.opened.emit(clip))
        menu.addSeparator()
        self._act(menu, "Split at playhead", "split", edits.split_clips, content.view.playhead_s)
        if several:
            self._act(menu, "Join parts of a clip", "", edits.join_clips)
            self._act(menu, "Make one clip of them", "", edits.group_clips)
        else:
            self._act(menu, "Take layers apart", "", edits.ungroup_clips)
        self._act(menu, f"Repeat {what}", "repeat", edits.repeat_clips, 2)
        self._act(menu, f"Duplicate {what}", "duplicate", edits.duplicate_clips)
        self._act(menu, f"Mute {what}", "mute", edits.toggle_mute_clips)
        menu.addSeparator()
        self._fill_places(menu, f"Move {what} to")
        self._line(menu, "Copy", "copy", self._clips.copy)
        self._line(menu, "Cut", "cut", self._clips.cut)
        self._act(menu, f"Remove {what}", "remove", edits.remove_clips)

    def _fill_places(self, menu: QMenu, words: str) -> None:
        places = menu.addMenu(words)
        places.setObjectName("lanes_places")
        design = self._content().design
        taken = {one.location for one in design.inputs}
        for number in range(1, facts_of(design.limb).n_inputs + 1):
            track = "" if number in taken else " (new track)"
            title = f"{number} · {input_words(number, design.limb).name}{track}"
            self._act(places, title, "", edits.move_clips_to_place, number)

    def _fill_ground(self, menu: QMenu, content: Content, place: QPointF, time_s: float) -> None:
        lane = content.lane_at(place.y())
        if lane is not None:
            track = lane.track.id
            self._line(menu, "Add clip here", "", lambda: self._clips.add(track, time_s))
            shown = track in content.gain_shown
            words = "Hide gain curve" if shown else "Show gain curve"
            self._line(menu, words, "gain_curve", lambda: self._toggle_gain(track))
        self._line(menu, "Paste at playhead", "paste", self._clips.paste)
        menu.addSeparator()
        self._fill_time(menu, content)

    def _fill_curve(self, menu: QMenu, strip: GainStrip, place: QPointF) -> None:
        track, near = strip.lane.track.id, strip.point_at(place)
        if near is not None:
            self._gain.choose((track, near))
            self._line(menu, "Remove point", "remove", lambda: self._gain.remove(track, (near,)))
        else:
            self._line(menu, "Add point here", "", lambda: self._gain.double_click(place))
        everything = tuple(range(len(strip.points)))
        self._line(menu, "Remove gain curve", "", lambda: self._gain.remove(track, everything))
        self._line(menu, "Hide gain curve", "gain_curve", lambda: self._toggle_gain(track))

    def _toggle_gain(self, track: int) -> None:
        content = self._content()
        self.looked.emit(toggle_gain_curves(content.design, content.view, (track,)).view)

    def _fill_ruler(self, menu: QMenu, content: Content, place: QPointF, time_s: float) -> None:
        marker = marker_at(content, place)
        if marker is None:
            self._line(menu, "Add marker here", "", lambda: self._clips.add_marker(time_s))
        else:
            index = content.design.markers.index(marker)
            self._line(menu, "Rename marker…", "", lambda: self._rename(index))
            self._edit_line(menu, "Remove marker", edits.remove_marker, index)
        menu.addSeparator()
        ends = _ends_of_chosen(content)
        if ends is not None:
            self._edit_line(menu, "Loop the selected clips", edits.set_loop, ends)
        if content.design.loop_s is not None:
            self._edit_line(menu, "No loop", edits.set_loop, None)
        self._fill_time(menu, content)

    def _fill_time(self, menu: QMenu, content: Content) -> None:
        if content.design.loop_s is None:
            return
        start_s, end_s = content.design.loop_s
        menu.addSeparator()
        insert = edits.insert_time
        self._edit_line(menu, "Insert the loop's time before it", insert, start_s, end_s - start_s)
        self._edit_line(menu, "Remove the loop's time", edits.remove_time, start_s, end_s)

    def _act(self, menu: QMenu, words: str, key: str, edit: AnyEdit, *more: object) -> None:
        """Add a line that edits the clips which are selected when it is chosen."""

        def act() -> None:
            content = self._content()
            chosen = content.view.selected_clips
            self.edited.emit(edit(content.design, content.view, chosen, *more), None)

        self._line(menu, words, key, act)

    def _edit_line(self, menu: QMenu, words: str, edit: AnyEdit, *more: object) -> None:
        def act() -> None:
            content = self._content()
            outcome: Edit | Refusal = edit(content.design, content.view, *more)
            self.edited.emit(outcome, None)

        self._line(menu, words, "", act)

    def _line(self, menu: QMenu, words: str, key: str, act: Callable[[], object]) -> None:
        # A tab makes the key stand at the right; it is the widget's, no shortcut of the menu.
        shown = f"{words}\t{key_text(_PLACE, key)}" if key else words
        menu.addAction(shown).triggered.connect(lambda _=False: act())

    def _rename(self, index: int) -> None:
        content = self._content()
        name, sure = QInputDialog.getText(
            self._parent, "Rename marker", "Name", text=content.design.markers[index].name
        )
        if sure:
            outcome = edits.rename_marker(content.design, content.view, index, name)
            self.edited.emit(outcome, None)


def _ends_of_chosen(content: Content) -> tuple[float, float] | None:
    clips = [one for one in content.design.clips if one.id in content.view.selected_clips]
    if not clips:
        return None
    return (min(one.onset_s for one in clips), max(one.end_s for one in clips))
