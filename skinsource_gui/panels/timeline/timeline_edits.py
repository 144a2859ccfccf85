"""What the timeline does to clips by menu, keys and clipboard."""

from PySide6.QtCore import QObject, Signal

from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import sentence
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource.design.waveforms import Waveform
from skinsource_gui.panels.timeline import clipboard
from skinsource_gui.panels.timeline.content import chosen_clips
from skinsource_gui.widgets.keys import key_text

_NO_CLIPS = Refusal(sentence="No clip is selected; click one in the timeline.")
_NOTHING_TO_PASTE = Refusal(
    sentence=f"The clipboard holds no clips; copy some first, with {key_text('timeline', 'copy')}."
)


class TimelineEdits(QObject):
    """Edits of the selected clips; new ones are of the kind that was selected last."""

    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._last: Waveform = Clip().waveform

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view
        chosen = view.selected_clips[-1:]
        for track in design.inputs:
            for clip in track.clips:
                if (clip.id,) == chosen:
                    self._last = clip.waveform

    def add(self, track: int, at_s: float) -> None:
        """Add a clip of the last used kind to a track."""
        self._emit(edits.add_clip(self._design, self._view, track, at_s, self._last))

    def add_marker(self, at_s: float) -> None:
        """Add a marker with a number for a name."""
        name = str(len(self._design.markers) + 1)
        self._emit(edits.add_marker(self._design, self._view, at_s, name))

    def copy(self) -> bool:
        """Put the selected clips on the clipboard; whether they are there."""
        fragment = edits.fragment_of(self._design, chosen_clips(self._design, self._view))
        if fragment is None:
            self._emit(_NO_CLIPS)
            return False
        try:
            clipboard.copy(fragment)
        except SkinSourceError as error:
            self._emit(Refusal(sentence=sentence(str(error))))
            return False
        return True

    def cut(self) -> None:
        """Move the selected clips to the clipboard; what cannot be there stays."""
        if self.copy():
            chosen = chosen_clips(self._design, self._view)
            self._emit(edits.cut_clips(self._design, self._view, chosen))

    def paste(self) -> None:
        """Put the clips of the clipboard at the playhead."""
        try:
            fragment = clipboard.pasted()
        except SkinSourceError as error:
            self._emit(Refusal(sentence=sentence(str(error))))
            return
        if fragment is None:
            self._emit(_NOTHING_TO_PASTE)
        else:
            at_s = self._view.playhead_s
            self._emit(edits.paste_fragment(self._design, self._view, fragment, at_s))

    def _emit(self, outcome: Edit | Refusal) -> None:
        self.edited.emit(outcome, None)
