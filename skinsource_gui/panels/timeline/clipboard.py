"""Selected clips on the clipboard: copied, cut and pasted."""

from PySide6 import QtWidgets
from PySide6.QtCore import QMimeData

from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import sentence
from skinsource.base.work import counted
from skinsource.design import edits
from skinsource.design.clips import Fragment
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.panels.timeline.content import chosen_clips

_MIME = "application/x-skinsource-clips"
# A text with clips has this sign within so many characters.
_SIGN, _BEGINNING = "skinsource clips", 2000
_NO_CLIPS = Refusal(sentence="No clip is selected; click one in the timeline.")
_NOTHING_TO_PASTE = Refusal(sentence="The clipboard holds no clips; copy some first.")


def copy_clips(design: Design, view: View) -> Edit | Refusal:
    """Put the selected clips on the clipboard; the design stays."""
    fragment = edits.fragment_of(design, chosen_clips(design, view))
    if fragment is None:
        return _NO_CLIPS
    try:
        text = edits.fragment_text(fragment)
    except SkinSourceError as error:
        return Refusal(sentence=sentence(str(error)))
    data = QMimeData()
    data.setData(_MIME, text.encode())
    data.setText(text)
    QtWidgets.QApplication.clipboard().setMimeData(data)
    count = sum(len(lane.clips) for lane in fragment.lanes)
    return Edit(label="Copy", design=design, view=view, said=f"{counted(count, 'clip')} copied")


def cut_clips(design: Design, view: View) -> Edit | Refusal:
    """Move the selected clips to the clipboard; what cannot be there stays."""
    copied = copy_clips(design, view)
    if isinstance(copied, Refusal):
        return copied
    return edits.cut_clips(design, view, chosen_clips(design, view))


def paste_clips(design: Design, view: View) -> Edit | Refusal:
    """Put the clips of the clipboard at the playhead."""
    try:
        fragment = _pasted_fragment()
    except SkinSourceError as error:
        return Refusal(sentence=sentence(str(error)))
    if fragment is None:
        return _NOTHING_TO_PASTE
    return edits.paste_fragment(design, view, fragment, view.playhead_s)


def _pasted_fragment() -> Fragment | None:
    """Return the clips on the clipboard, also those that came as text; None: there are none."""
    data = QtWidgets.QApplication.clipboard().mimeData()
    if data is None:
        return None
    if data.hasFormat(_MIME):
        return edits.fragment_from(bytes(data.data(_MIME).data()).decode(errors="replace"))
    text = data.text() if data.hasText() else ""
    return edits.fragment_from(text) if _SIGN in text[:_BEGINNING] else None
