"""The canvas of the lanes, as its mouse, keys and menus use it."""

from collections.abc import Callable
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QPointF, Signal

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource_gui.panels.timeline.clipboard import copy_clips, cut_clips, paste_clips
from skinsource_gui.panels.timeline.content import ClipLengths, TimelineContent, toggle_gain_curves
from skinsource_gui.plots.plot import Canvas
from skinsource_gui.qt.frames import DropPlace


class LanesCanvas(Canvas):
    """Shows the lanes, and emits edits of what is on them.

    Attributes
    ----------
    content
        What is shown.
    elsewhere
        Returns where in another panel something would be dropped that is held over a place, px;
        None ends that.
    """

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    view_changed = Signal(object)
    playhead_requested = Signal(float)
    #: Id of a clip.
    opened = Signal(int)

    def __init__(self, parent: QtWidgets.QWidget | None) -> None:
        super().__init__(parent)
        design = Design(limb="")
        self.content = TimelineContent(design=design, view=View(), lengths=ClipLengths(design))
        self.elsewhere: Callable[[QPointF | None], DropPlace | None] = lambda at: None
        # New clips play what the one plays that was selected last.
        self._last: Waveform = Clip().waveform

    def change(self, **changes: Any) -> None:
        """Show content in which these fields are other ones."""
        raise NotImplementedError

    def edit(self, edit: Callable[..., Edit | Refusal], *more: object) -> None:
        """Emit what an edit makes of the present design."""
        self.edited.emit(edit(self.content.design, self.content.view, *more), None)

    def look(self, edit: Edit) -> None:
        """Emit the view of an edit that changes nothing else."""
        self.view_changed.emit(edit.view)

    def select(self, *clips: int) -> None:
        """Select these clips and no others."""
        self.look(edits.select_clips(self.content.design, self.content.view, clips))

    def add_clip(self, track: int, at_s: float) -> None:
        """Add a clip of the last used kind to a track."""
        self.edit(edits.add_clip, track, at_s, self._last)

    def add_marker(self, at_s: float) -> None:
        """Add a marker with a number for a name."""
        self.edit(edits.add_marker, at_s, str(len(self.content.design.markers) + 1))

    def toggle_gain(self, *tracks: int) -> None:
        """Show the gain curves of tracks, or hide them."""
        self.look(toggle_gain_curves(self.content.design, self.content.view, tracks))

    def copy(self) -> None:
        """Put the selected clips on the clipboard."""
        refusal = copy_clips(self.content.design, self.content.view)
        if refusal is not None:
            self.edited.emit(refusal, None)

    def cut(self) -> None:
        """Move the selected clips to the clipboard."""
        self.edit(cut_clips)

    def paste(self) -> None:
        """Put the clips of the clipboard at the playhead."""
        self.edit(paste_clips)
