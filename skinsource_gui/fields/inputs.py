"""Texts, edits and menu of inputs: edits of several inputs at once, labels of clips, and a menu."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any
from weakref import finalize

import numpy as np
from PySide6 import QtWidgets

from skinsource.base.conventions import Floats
from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.describing import DURATION_FIELD, duration_text, effects_hz, figure_text
from skinsource.design.design import Design, Input, View
from skinsource.design.display_units import number_text
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.effects.time import Trim, stretched_by
from skinsource.design.waveform import Waveform
from skinsource.signals.generators import sample_count
from skinsource.signals.resampling import peaks_between
from skinsource.specs.models import specs_of
from skinsource_gui.qt.keys import KEYS, key_text


class FieldChanges:
    """Makes edits of one field of several inputs: typing sets all, a drag moves all by the same.

    It remembers the design at the start of a drag.
    """

    def __init__(self) -> None:
        self._gesture: int | None = None
        self._start: Design | None = None

    def change(
        self,
        design: Design,
        view: View,
        ids: tuple[int, ...],
        name: str,
        value: Any,
        *,
        lead: int,
        gesture: int | None,
    ) -> Edit | Refusal:
        """Set field ``name`` of input ``lead`` to ``value``; the other ``ids`` follow."""
        # Half a typed list of frequencies has lost gains, which the whole one has at the start.
        if gesture is None or (len(ids) == 1 and name != "frequencies_hz"):
            return edits.change_field(design, view, ids, name, value)
        if gesture != self._gesture or self._start is None:
            self._gesture, self._start = gesture, design
        return edits.drag_field(design, view, ids, name, value, lead=lead, start=self._start)


#: Text of an input without clips.
EMPTY = "nothing yet"
# Shorter differences are rounding errors, s.
_LEAST_S = 1e-9


def clip_text(clip: Clip) -> str:
    """Return `figure_text` of a clip, and how effects change it: ``", trimmed, stretched ×2"``."""
    trimmed = any(isinstance(effect, Trim) and effect.on for effect in clip.effects)
    factor = stretched_by(clip.effects, clip.waveform.duration_s)
    stretched = "" if factor == 1.0 else f", stretched ×{factor:.3g}"
    return f"{figure_text(clip.waveform)}{', trimmed' if trimmed else ''}{stretched}"


def clips_text(count: int) -> str:
    """Return the end of the text of one of ``count`` clips: ``" · 1 of 3 clips"``."""
    return f" · 1 of {count} clips" if count > 1 else ""


def played_length_text(clip: Clip) -> str:
    """Return the text of the duration of a clip whose effects change it; else ""."""
    if abs(clip.duration_s - clip.waveform.duration_s) < _LEAST_S:
        return ""
    return duration_text(clip.duration_s)


def played_hz_text(clip: Clip) -> str:
    """Return the text of the frequencies of a clip whose effects change them; else ""."""
    played_hz = effects_hz(clip.effects, clip.waveform)
    if played_hz in ((), effects_hz((), clip.waveform)):
        return ""
    return f"{'–'.join(number_text(hz, 'Hz', digits=4) for hz in played_hz)} Hz"


def fixed_length_text(waveform: Waveform) -> str:
    """Return the text of the duration of a waveform without a field for it; else ""."""
    if DURATION_FIELD in specs_of(waveform):
        return ""
    count = sample_count(waveform.duration_s)
    samples = "" if count == 1 else f" ({count} samples)"
    fixed = "" if specs_of(waveform) else ", fixed"
    return f"{duration_text(waveform.duration_s)}{samples}{fixed}"


def waveforms_of(results: Mapping[str, Any]) -> dict[int, Floats]:
    """Return the samples of each clip, (n_times,), by its id; ``results`` have clip_waveforms."""
    return {
        clip.id: samples
        for track, waveforms in zip(results["inputs"], results["clip_waveforms"], strict=True)
        for clip, samples in zip(track.clips, waveforms, strict=True)
        if samples is not None
    }


def played_of(results: Mapping[str, Any]) -> dict[int, Floats]:
    """Return what tracks play before their amplitude, by their ids, with input_waveforms."""
    played = zip(results["inputs"], results["input_waveforms"], strict=True)
    return {track.id: samples for track, samples in played if samples is not None}


# Kept as long as the arrays: what an edit leaves alone stays the same array.
_PEAKS: dict[int, float] = {}


def peak_of(played: Floats) -> float:
    """Return the peak of what a track plays, between its samples too."""
    key = id(played)
    if key not in _PEAKS:
        finalize(played, _PEAKS.pop, key, None)
        _PEAKS[key] = float(peaks_between(played[np.newaxis])[0])
    return _PEAKS[key]


#: Makes an edit of the inputs with these ids.
InputEdit = Callable[[Design, View, Iterable[int]], Edit | Refusal]


def of_selected(
    of_clips: InputEdit, of_inputs: InputEdit
) -> Callable[[Design, View], Edit | Refusal]:
    """Return an edit of the selected clips; where there are none, of the selected inputs."""

    def edit(design: Design, view: View) -> Edit | Refusal:
        if view.selected_clips:
            return of_clips(design, view, view.selected_clips)
        return of_inputs(design, view, view.selected_inputs)

    return edit


#: Removes the selected clips; where there are none, the selected inputs.
remove_selected = of_selected(edits.remove_clips, edits.remove_inputs)


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """An entry of the menu of inputs.

    Attributes
    ----------
    text
        Its text; braces are replaced by the number of inputs if there are several.
    key
        Name of the key in the table of keys.
    on
        Returns whether an input is checked; None: the entry is not checkable.
    separated
        Whether there is a separator before it.
    """

    text: str
    key: str
    edit: InputEdit
    on: Callable[[Input], bool] | None = None
    separated: bool = False


#: Entries for inputs everywhere.
ENTRIES = (
    Entry(text="Mute{}", key="mute", edit=edits.toggle_mute, on=lambda track: track.muted),
    Entry(text="Solo{}", key="solo", edit=edits.toggle_solo, on=lambda track: track.solo),
    Entry(text="Duplicate{}", key="duplicate", edit=edits.duplicate_inputs, separated=True),
    Entry(text="Remove{}", key="remove", edit=edits.remove_inputs),
)
#: Further entries for inputs in a list.
ORDER = (
    Entry(
        text="Move{} up",
        key="shift_up",
        edit=partial(edits.shift_inputs, down=False),
        separated=True,
    ),
    Entry(text="Move{} down", key="shift_down", edit=partial(edits.shift_inputs, down=True)),
)


def fill_inputs_menu(
    menu: QtWidgets.QMenu,
    chosen: Sequence[Input],
    act: Callable[[InputEdit], None],
    *,
    place: str,
    entries: Iterable[Entry] = ENTRIES,
) -> None:
    """Fill the menu of some inputs.

    Parameters
    ----------
    menu
        Gets the entries.
    chosen
        The inputs; without any, all entries are disabled.
    act
        Applies the chosen edit to them.
    place
        Place in the table of keys.
    entries
        The entries.
    """
    several = f" {len(chosen)} inputs" if len(chosen) > 1 else ""
    for entry in entries:
        if entry.separated:
            menu.addSeparator()
        text = entry.text.format(several)
        key = key_text(place, entry.key) if entry.key in KEYS[place].gestures else ""
        action = menu.addAction(f"{text}\t{key}" if key else text)
        action.setEnabled(bool(chosen))
        action.setCheckable(entry.on is not None)
        action.setChecked(bool(chosen) and entry.on is not None and all(map(entry.on, chosen)))
        action.triggered.connect(lambda _=False, edit=entry.edit: act(edit))
