"""Selected clips on the clipboard: copied, cut and pasted."""

from PySide6 import QtWidgets
from PySide6.QtCore import QMimeData

from skinsource.base.errors import SkinSourceError, counted, sentence
from skinsource.design import edits
from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.design import Design, View
from skinsource.design.edits.clips import chosen_clips, clips_text
from skinsource.design.edits.edit import Edit, Refusal, change_clips, refusing
from skinsource.design.edits.effects import changes_time
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.time import Trim
from skinsource.design.waveforms.pulses import Impulse

_MIME = "application/x-skinsource-{}"
# A text with clips has this sign within so many characters.
_SIGN, _BEGINNING = "skinsource clips", 2000
#: What keys and menus that act on clips say where none is selected.
NO_CLIPS = Refusal(sentence="No clip is selected; click one in the timeline.")
_NOTHING = "The clipboard holds no {}; copy some first."


@refusing
def copy_clips(design: Design, view: View) -> Edit | Refusal:
    """Put the selected clips on the clipboard; the design stays."""
    fragment = edits.fragment_of(design, view.selected_clips)
    if fragment is None:
        return NO_CLIPS
    text, data = edits.fragment_text(fragment), QMimeData()
    data.setData(_MIME.format("clips"), text.encode())
    data.setText(text)
    QtWidgets.QApplication.clipboard().setMimeData(data)
    count = sum(len(lane.clips) for lane in fragment.lanes)
    return Edit(label="Copy", design=design, view=view, said=f"{counted(count, 'clip')} copied")


def cut_clips(design: Design, view: View) -> Edit | Refusal:
    """Move the selected clips to the clipboard; what cannot be there stays."""
    copied = copy_clips(design, view)
    if isinstance(copied, Refusal):
        return copied
    return edits.cut_clips(design, view, view.selected_clips)


def paste_clips(design: Design, view: View) -> Edit | Refusal:
    """Put the clips of the clipboard at the playhead."""
    fragment = _pasted("clips")
    if isinstance(fragment, Refusal):
        return fragment
    return edits.paste_fragment(design, view, fragment, view.playhead_s)


def copy_effects(design: Design, view: View) -> Edit | Refusal:
    """Put the effects of the clip that was selected last on the clipboard; the design stays.

    What cuts its part belongs to that clip, as after a split.
    """
    if view.selected_clip is None:
        return NO_CLIPS
    _, effects = _parted(design.clip(view.selected_clip))
    # The shortest waveform: with any, effects that repeat must not become too long.
    holder = Lane(location=1, clips=(Clip(waveform=Impulse(), effects=effects),))
    data = QMimeData()
    data.setData(_MIME.format("effects"), edits.fragment_text(Fragment(lanes=(holder,))).encode())
    QtWidgets.QApplication.clipboard().setMimeData(data)
    said = f"{counted(len(effects), 'effect')} copied"
    return Edit(label="Copy effects", design=design, view=view, said=said)


@refusing
def paste_effects(design: Design, view: View) -> Edit | Refusal:
    """Replace the effects of the selected clips by those copied; what cuts a part stays."""
    fragment = _pasted("effects")
    if isinstance(fragment, Refusal):
        return fragment
    chosen = chosen_clips(design, view.selected_clips)
    new = fragment.lanes[0].clips[0].effects
    changes = {clip.id: {"effects": (*_parted(clip)[0], *new)} for clip in chosen}
    after = change_clips(design, changes)
    of_whom = f"effects of {clips_text(design, chosen)}"
    said = f"The {of_whom} were replaced; Undo brings them back"
    return Edit(label=f"Replace {of_whom}", design=after, view=view, said=said)


def _parted(clip: Clip) -> tuple[tuple[Effect, ...], tuple[Effect, ...]]:
    """Return the effects that cut a part, with those that move time before that; and the others."""
    trims = [k for k, e in enumerate(clip.effects, 1) if isinstance(e, Trim) and e.on]
    end = max(trims, default=0)
    before = clip.effects[:end]
    kept = (effect for effect in before if not changes_time(effect))
    return tuple(filter(changes_time, before)), (*kept, *clip.effects[end:])


def _pasted(what: str) -> Fragment | Refusal:
    """Return what is on the clipboard, clips also where they came as text; or why not."""
    data = QtWidgets.QApplication.clipboard().mimeData() or QMimeData()
    text = bytes(data.data(_MIME.format(what)).data()).decode(errors="replace")
    if what == "clips" and _SIGN in data.text()[:_BEGINNING]:
        text = text or data.text()
    try:
        return edits.fragment_from(text) if text else Refusal(sentence=_NOTHING.format(what))
    except SkinSourceError as error:
        return Refusal(sentence=sentence(str(error)))
