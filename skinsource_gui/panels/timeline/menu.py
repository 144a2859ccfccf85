"""The menu of what lies under the pointer on the lanes."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from PySide6 import QtWidgets
from PySide6.QtCore import QPoint, QPointF

from skinsource.design import edits
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.edits.motions import motion_of
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panels.timeline.content import (
    Box,
    GainStrip,
    TimelineContent,
    clip_text,
)
from skinsource_gui.panels.timeline.gain import GainPoints
from skinsource_gui.qt.buttons import passing_menu
from skinsource_gui.qt.keys import key_text, shortcut_text

if TYPE_CHECKING:
    from skinsource_gui.panels.timeline.lanes import LanesView

AnyEdit = Callable[..., Edit | Refusal]
_PLACE = "timeline"


class LanesMenu:
    """Opens the menu of what lies under the pointer."""

    def __init__(self, lanes: "LanesView", gain: GainPoints) -> None:
        self._lanes, self._gain = lanes, gain

    def open(self, at: QPoint, place: QPointF) -> None:
        """Open the menu of a place, at a place of the screen."""
        content = self._lanes.content
        box = content.box_at(place)
        menu = passing_menu(self._lanes, "lanes_menu")
        time_s = max(content.scale.time(place.x()), 0.0)
        if place.y() < content.ruler_px:
            self._fill_ruler(menu, content, place, time_s)
        elif (strip := self._gain.strip_at(place)) is not None:
            self._fill_curve(menu, strip, place)
        elif box is not None:
            if box.clip.id not in content.view.selected_clips:
                self._lanes.select(box.clip.id)
            self._fill_clips_here(menu, content.boxes_at(place))
            self._fill_clip(menu, box.clip.id)
        else:
            self._fill_ground(menu, content, place, time_s)
        menu.popup(at)

    def _fill_clips_here(self, menu: QtWidgets.QMenu, boxes: Sequence[Box]) -> None:
        """Offer to select each of several clips that lie over each other."""
        if len(boxes) < 2:
            return
        here = menu.addMenu("Clips here")
        here.setObjectName("clips_here")
        for box in boxes:
            line = here.addAction(clip_text(box.clip))
            line.setCheckable(True)
            line.setChecked(box.clip.id in self._lanes.content.view.selected_clips)
            line.triggered.connect(lambda _=False, clip=box.clip.id: self._lanes.select(clip))
        menu.addSeparator()

    def _fill_clip(self, menu: QtWidgets.QMenu, clip: int) -> None:
        view = self._lanes.content.view
        several = len(view.selected_clips) > 1
        what = f"{len(view.selected_clips)} clips" if several else "clip"
        self._line(menu, "Edit clip", "open", lambda: self._lanes.opened.emit(clip))
        if motion_of(self._lanes.content.design, clip) is not None:
            menu.addAction("Edit motion…").triggered.connect(
                partial(self._lanes.action_requested.emit, "make_motion")
            )
        menu.addSeparator()
        self._act(menu, "Split at playhead", "split", edits.split_clips, view.playhead_s)
        if several:
            self._act(menu, "Join clip parts", "", edits.join_clips)
            self._act(menu, "Group into one clip", "", edits.group_clips)
        else:
            self._act(menu, "Ungroup layers", "", edits.ungroup_clips)
        self._act(menu, f"Repeat {what}", "repeat", edits.repeat_clips, 2)
        self._act(menu, f"Duplicate {what}", "duplicate", edits.duplicate_clips)
        self._act(menu, f"Mute {what}", "mute", edits.toggle_mute_clips)
        menu.addSeparator()
        self._fill_places(menu, f"Move {what} to")
        self._action(menu, "Copy", "copy_clips")
        self._action(menu, "Cut", "cut_clips")
        self._act(menu, f"Remove {what}", "remove", edits.remove_clips)

    def _fill_places(self, menu: QtWidgets.QMenu, label: str) -> None:
        places = menu.addMenu(label)
        places.setObjectName("lanes_places")
        design = self._lanes.content.design
        occupied = {track.location for track in design.inputs}
        for number in range(1, facts_of(design.limb).n_inputs + 1):
            track = "" if number in occupied else " (new track)"
            title = f"{number} · {input_name(number, design.limb).name}{track}"
            self._act(places, title, "", edits.move_clips_to_place, number)

    def _fill_ground(
        self, menu: QtWidgets.QMenu, content: TimelineContent, place: QPointF, time_s: float
    ) -> None:
        lane = content.lane_at(place.y())
        if lane is not None:
            track = lane.track.id
            self._line(menu, "Add clip here", "", lambda: self._lanes.add_clip(track, time_s))
            text = "Hide gain curve" if track in content.gain_shown else "Show gain curve"
            self._line(menu, text, "gain_curve", lambda: self._lanes.toggle_gain(track))
        self._action(menu, "Paste at playhead", "paste_clips")
        menu.addSeparator()
        self._fill_time(menu, content)

    def _fill_curve(self, menu: QtWidgets.QMenu, strip: GainStrip, place: QPointF) -> None:
        track, near = strip.lane.track.id, strip.point_at(place)
        if near is not None:
            self._gain.choose((track, near))
            self._line(menu, "Remove point", "remove", lambda: self._gain.remove(track, (near,)))
        else:
            self._line(menu, "Add point here", "", lambda: self._gain.double_click(place))
        everything = tuple(range(len(strip.points)))
        self._line(menu, "Remove gain curve", "", lambda: self._gain.remove(track, everything))
        self._line(menu, "Hide gain curve", "gain_curve", lambda: self._lanes.toggle_gain(track))

    def _fill_ruler(
        self, menu: QtWidgets.QMenu, content: TimelineContent, place: QPointF, time_s: float
    ) -> None:
        marker = content.marker_at(place)
        if marker is None:
            self._line(menu, "Add marker here", "", lambda: self._lanes.add_marker(time_s))
        else:
            index = content.design.markers.index(marker)
            self._line(menu, "Rename marker…", "", lambda: self._rename(index))
            self._edit_line(menu, "Remove marker", edits.remove_marker, index)
        menu.addSeparator()
        ends = _ends_of_chosen(content)
        if ends is not None:
            self._edit_line(menu, "Loop the selected clips", edits.set_loop, ends)
        if content.design.loop_s is not None:
            self._edit_line(menu, "Remove loop", edits.set_loop, None)
        self._fill_time(menu, content)

    def _fill_time(self, menu: QtWidgets.QMenu, content: TimelineContent) -> None:
        if content.design.loop_s is None:
            return
        start_s, end_s = content.design.loop_s
        menu.addSeparator()
        insert = edits.insert_time
        self._edit_line(menu, "Insert loop time before", insert, start_s, end_s - start_s)
        self._edit_line(menu, "Remove loop time", edits.remove_time, start_s, end_s)

    def _act(
        self, menu: QtWidgets.QMenu, text: str, key: str, edit: AnyEdit, *more: object
    ) -> None:
        """Add a line that edits the clips which are selected when it is chosen."""
        lanes = self._lanes
        self._line(
            menu, text, key, lambda: lanes.edit(edit, lanes.content.view.selected_clips, *more)
        )

    def _action(self, menu: QtWidgets.QMenu, text: str, name: str) -> None:
        """Add a line that does what an action of the window does."""
        line = menu.addAction(f"{text}\t{shortcut_text(name)}")
        line.triggered.connect(partial(self._lanes.action_requested.emit, name))

    def _edit_line(self, menu: QtWidgets.QMenu, text: str, edit: AnyEdit, *more: object) -> None:
        self._line(menu, text, "", lambda: self._lanes.edit(edit, *more))

    def _line(self, menu: QtWidgets.QMenu, text: str, key: str, act: Callable[[], object]) -> None:
        # A tab puts the key at the right; the menu has no shortcuts, keys belong to the lanes.
        shown = f"{text}\t{key_text(_PLACE, key)}" if key else text
        menu.addAction(shown).triggered.connect(lambda _=False: act())

    def _rename(self, index: int) -> None:
        before = self._lanes.content.design.markers[index].name
        name, sure = QtWidgets.QInputDialog.getText(
            self._lanes, "Rename marker", "Name", text=before
        )
        if sure:
            self._lanes.edit(edits.rename_marker, index, name)


def _ends_of_chosen(content: TimelineContent) -> tuple[float, float] | None:
    clips = [clip for clip in content.design.clips if clip.id in content.view.selected_clips]
    if not clips:
        return None
    return (min(clip.onset_s for clip in clips), max(clip.end_s for clip in clips))
