"""The table of actions: menus, shortcuts, what edits they make, and when they can be done.

Menus and their words stand in ``resources/actions.toml``.
"""

import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import NUMBERS, Design, Input, View
from skinsource.design.edits.clips import copy_behind, of_each
from skinsource.design.edits.cutting import faded_ends
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.edits.inputs import is_plain_sum
from skinsource.design.panel_settings import brush_of
from skinsource_gui.fields.inputs import of_selected, remove_selected
from skinsource_gui.pages.files.exports import EXPORTS
from skinsource_gui.panels.skin.settings import has_colours, use_colours
from skinsource_gui.panels.timeline.clipboard import (
    copy_clips,
    copy_effects,
    cut_clips,
    paste_clips,
    paste_effects,
)
from skinsource_gui.plots.small_map import COLOURS
from skinsource_gui.qt.keys import KEYS, SHORTCUTS, key_text
from skinsource_gui.qt.resources import read_text
from skinsource_gui.state.job_runner import selected_trains

#: Whether something can be done, or is on, now.
Condition = Callable[[Design, View], bool]
#: Makes the edit from the design and the view.
MakeEdit = Callable[[Design, View], Edit | Refusal]


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionSpec:
    """One thing that can be done.

    It is either a ``command`` or an ``edit``.

    Attributes
    ----------
    name
        Name of the action, the same for ever.
    text
        What the menu says.
    menu
        Menu it stands in, which the table of menus says; "" for the palette alone.
    submenu
        The one in that menu it stands in; in the menu itself where there is none.
    of_clips
        What the menu says while clips are selected, on which it acts then.
    short
        What its button says in the bar, where that is less.
    hint
        What it does, in a sentence.
    keys
        Shortcuts, first the one that is shown.
    key_elsewhere
        The key that does it where that belongs to a panel: said beside it in the menu.
    keywords
        Other words by which the palette finds it.
    missing
        What to do first where it cannot be done.
    command
        ``"capability.method"``: who does it, and what it is called there.
    argument
        What the command is told, if anything.
    edit
        Makes the edit from the design and the view.
    enabled
        Whether it can be done now; always when not given.
    checked
        Whether it is on now; no switch when not given.
    separated
        Whether a line stands before it.
    group
        Of the switches with the same group, one is on.
    """

    name: str
    text: str
    hint: str
    keys: tuple[str, ...] = ()
    key_elsewhere: str = ""
    menu: str = ""
    submenu: str = ""
    of_clips: str = ""
    short: str = ""
    keywords: str = ""
    missing: str = ""
    command: str = ""
    argument: str = ""
    edit: MakeEdit | None = None
    enabled: Condition | None = None
    checked: Condition | None = None
    separated: bool = False
    group: str = ""


def _clips(design: Design, view: View) -> list[Clip]:
    return [design.clip(id) for id in view.selected_clips]


def _inputs(design: Design, view: View) -> list[Input]:
    return [track for track in design.inputs if track.id in view.selected_inputs]


def _are(of: Callable[[Design, View], Sequence[Any]], hold: Callable[[Any], object]) -> Condition:
    """Return whether there are some of them, and something holds for all."""

    def are(design: Design, view: View) -> bool:
        chosen = of(design, view)
        return bool(chosen) and all(map(hold, chosen))

    return are


def _on(
    chosen: Callable[[Design, View], Sequence[int]],
    edit: Callable[..., Edit | Refusal],
    *more: object,
) -> MakeEdit:
    """Return an edit of what is chosen."""
    return lambda design, view: edit(design, view, chosen(design, view), *more)


def _on_tracks(design: Design, view: View) -> list[int]:
    """Return how many clips are selected on each track that has selected ones."""
    ids = set(view.selected_clips)
    counts = (sum(clip.id in ids for clip in track.clips) for track in design.inputs)
    return [count for count in counts if count]


def _are_on_one_track(design: Design, view: View) -> bool:
    counts = _on_tracks(design, view)
    return len(counts) == 1 and counts[0] > 1


_of_clips = partial(_on, lambda _, view: view.selected_clips)
_of_inputs = partial(_on, lambda _, view: view.selected_inputs)


# Length of a fade that a menu adds, s.
_FADE_S = 0.02


def _fades(clip: Clip) -> list[float]:
    return [end.length_s if end else 0.0 for end in faded_ends(clip)]


def _fade(end: int, design: Design, view: View) -> Edit | Refusal:
    """Fade the beginning (0) or the end (1) of those selected clips that do not fade there."""

    def fade(design: Design, view: View, id: int) -> Edit | Refusal:
        lengths_s = _fades(design.clip(id))
        lengths_s[end] = min(_FADE_S, design.clip(id).duration_s / 2)
        return edits.fade_clip(design, view, id, *lengths_s)

    ids = [clip.id for clip in _clips(design, view) if not _fades(clip)[end]]
    if view.selected_clips and not ids:
        way = ("in", "out")[end]
        return Refusal(sentence=f"It fades {way} already; drag the upper corner to change that.")
    return of_each(fade, design, view, ids)


# Names of colours, by what they are called in names of actions.
_COLOURS = {name.lower().replace("-", "_"): name for name, _ in COLOURS.options}
#: By name of an action, the edit that it makes.
EDITS: dict[str, MakeEdit] = {
    "cut_clips": cut_clips,
    "copy_clips": copy_clips,
    "paste_clips": paste_clips,
    "copy_effects": copy_effects,
    "paste_effects": paste_effects,
    "add_input": edits.add_input,
    "duplicate_input": of_selected(partial(copy_behind, verb="Duplicate"), edits.duplicate_inputs),
    "remove_input": remove_selected,
    "mute_input": _of_inputs(edits.toggle_mute),
    "solo_input": _of_inputs(edits.toggle_solo),
    "shift_input_up": _of_inputs(partial(edits.shift_inputs, down=False)),
    "shift_input_down": _of_inputs(partial(edits.shift_inputs, down=True)),
    "select_all_inputs": edits.select_all_inputs,
    "clear_inputs": edits.clear_inputs,
    "select_no_inputs": lambda design, view: edits.select_inputs(design, view, ()),
    "select_no_outputs": lambda design, view: edits.select_outputs(design, view, ()),
    "match_levels": lambda design, view: edits.match_levels(design, view, not view.levels_matched),
    "keep_match_gain": edits.keep_match_gain,
    "split_clips": lambda design, view: edits.split_clips(
        design, view, view.selected_clips, view.playhead_s
    ),
    "fade_in": partial(_fade, 0),
    "fade_out": partial(_fade, 1),
    "repeat_clips": _of_clips(copy_behind, "Repeat"),
    "duplicate_clips": _of_clips(copy_behind, "Duplicate"),
    "join_clips": _of_clips(edits.join_clips),
    "group_clips": _of_clips(edits.group_clips),
    "ungroup_clips": _of_clips(edits.ungroup_clips),
    "mute_clips": _of_clips(edits.toggle_mute_clips),
    "remove_clips": _of_clips(edits.remove_clips),
    "limit_to_band": _of_clips(edits.limit_to_band),
    "remove_delay": lambda design, view: edits.remove_delay(design, view, not view.delay_removed),
    "play_automatic": partial(edits.play_slower, slow_motion=0.0),
    **{f"use_{word}_colours": partial(use_colours, name) for word, name in _COLOURS.items()},
}


def _when(condition: Condition, *names: str) -> dict[str, Condition]:
    return dict.fromkeys(names, condition)


def _has_snapshot(number: int) -> Condition:
    return lambda _, view: any(snapshot.number == number for snapshot in view.snapshots)


_OF_INPUTS = "duplicate_input", "remove_input", "mute_input", "solo_input", "select_no_inputs"
#: Actions on clips: each acts on those that are selected.
OF_CLIPS = (
    *("split_clips", "fade_in", "fade_out", "repeat_clips", "duplicate_clips", "mute_clips"),
    *("remove_clips", "cut_clips", "copy_effects", "paste_effects", "limit_to_band"),
    *("draw_clip", "shape_envelope", "stretch_clip"),
)
#: By name of an action, whether it can be done now; others always can.
ENABLED: dict[str, Condition] = {
    **_when(lambda design, _: bool(design.clips), "copy_clips", "save_to_library"),
    **_when(lambda _, view: bool(view.selected_inputs), *_OF_INPUTS),
    **_when(lambda _, view: bool(view.selected_inputs), "shift_input_up", "shift_input_down"),
    **_when(lambda design, _: bool(design.inputs), "select_all_inputs", "clear_inputs"),
    "select_no_outputs": lambda _, view: bool(view.outputs),
    **{f"show_snapshot_{number}": _has_snapshot(number) for number in NUMBERS},
    **{f"rename_snapshot_{number}": _has_snapshot(number) for number in NUMBERS},
    "toggle_snapshots": lambda _, view: bool(view.snapshots),
    "keep_match_gain": lambda design, view: view.match_gain(design) != 1.0,
    **_when(lambda _, view: bool(view.selected_clips), *OF_CLIPS),
    "join_clips": lambda design, view: max(_on_tracks(design, view), default=0) > 1,
    "group_clips": _are_on_one_track,
    "ungroup_clips": lambda design, view: any(map(is_plain_sum, _clips(design, view))),
    "equalise_on_skin": lambda design, view: bool(selected_trains(design, view)),
    "match_tracks": lambda design, view: len(set(view.selected_inputs) & set(design.ids)) > 1,
}
#: By name of a switch, whether it is on now.
CHECKED: dict[str, Condition] = {
    "mute_input": _are(_inputs, lambda track: track.muted),
    "solo_input": _are(_inputs, lambda track: track.solo),
    "match_levels": lambda _, view: view.levels_matched,
    "mute_clips": _are(_clips, lambda clip: clip.muted),
    "aim": lambda _, view: bool(brush_of(view)),
    "remove_delay": lambda _, view: view.delay_removed,
    "play_automatic": lambda _, view: not view.slow_motion,
    **{f"use_{word}_colours": partial(has_colours, name) for word, name in _COLOURS.items()},
}
# What an entry of the file stands there for, once for each.
_EACH: dict[str, list[dict[str, str]]] = {
    "": [{}],
    "snapshot": [{"number": str(number)} for number in NUMBERS],
    "colours": [
        {"name": word, "title": title, "hint": COLOURS.hint}
        for word, (_, title) in zip(_COLOURS, COLOURS.options, strict=True)
    ],
}


class _KeyTexts:
    """Texts of keys by ``place.name``, for the hints of the file."""

    def __init__(self, text: Callable[[str, str], str]) -> None:
        self._text = text

    def __getitem__(self, path: str) -> str:
        return self._text(*path.split("."))


_TEXTS = {
    "key": _KeyTexts(key_text),
    "shown": _KeyTexts(lambda place, name: KEYS[place].gestures[name].shown),
}


def _read(menu: str, entries: Mapping[str, Mapping[str, Any]]) -> Iterator[ActionSpec]:
    """Yield the actions of a menu."""
    for pattern, entry in entries.items():
        for rank, each in enumerate(_EACH[entry.get("each", "")]):
            row = {
                name: text.format(**each, **_TEXTS) if isinstance(text, str) else text
                for name, text in entry.items()
            }
            name = pattern.format(**each)
            command, _, argument = row.get("command", "").partition(" ")
            yield ActionSpec(
                name=name,
                text=row["text"],
                hint=row["hint"],
                keys=tuple(row.get("keys", "").split()),
                key_elsewhere=_TEXTS["key"][row["key_of"]] if "key_of" in row else "",
                menu=menu,
                submenu=row.get("submenu", ""),
                of_clips=row.get("of_clips", ""),
                short=row.get("short", ""),
                keywords=row.get("words", ""),
                missing=row.get("missing", ""),
                command=command,
                argument=argument,
                edit=EDITS.get(name),
                enabled=ENABLED.get(name),
                checked=CHECKED.get(name),
                separated="separated" in row and rank == 0,
                group=row.get("group", ""),
            )


_TABLE: dict[str, dict[str, dict[str, Any]]] = tomllib.loads(read_text("actions.toml"))
#: The menus, in their order.
MENUS = tuple(_TABLE)
#: All actions, in the order of the menus; what the palette alone has comes last.
ACTIONS: tuple[ActionSpec, ...] = (
    *(spec for menu, entries in _TABLE.items() for spec in _read(menu, entries)),
    *(
        ActionSpec(
            name=f"export_{export.name}",
            text=export.text,
            hint=export.hint,
            keys=tuple(export.keys.split()),
            keywords=f"save write {export.words}",
            command="exports.show",
            argument=export.name,
        )
        for export in EXPORTS
    ),
)
SHORTCUTS.update({spec.name: spec.keys for spec in ACTIONS})
