"""The entries of the Clip menu: what is done to the selected clips, or to the one in sight.

Their single letters belong to the timeline, where they are said beside them.
"""

from collections.abc import Callable
from functools import partial

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.edits.cutting import last_fade
from skinsource.design.edits.edit import Edit, Refusal, leading_clip
from skinsource.design.view import View
from skinsource_gui.panels.timeline.content import chosen_clips
from skinsource_gui.qt.keys import key_text
from skinsource_gui.shell.actions.spec import ActionSpec, action
from skinsource_gui.state.job_runner import selected_train

# A fade from the menu; its corner in the timeline makes it longer.
_FADE_S = 0.02


def _has_clip(design: Design, view: View) -> bool:
    return bool(chosen_clips(design, view))


def _has_leading_clip(design: Design, view: View) -> bool:
    return leading_clip(design, view) is not None


def _has_train(design: Design, view: View) -> bool:
    return selected_train(design, view) is not None


def _has_tracks(design: Design, view: View) -> bool:
    return len(set(view.selected_inputs) & set(design.ids)) > 1


def _all_muted(design: Design, view: View) -> bool:
    chosen = chosen_clips(design, view)
    return bool(chosen) and all(design.clip(id).muted for id in chosen)


def _split(design: Design, view: View) -> Edit | Refusal:
    return edits.split_clips(design, view, chosen_clips(design, view), view.playhead_s)


def _repeat(design: Design, view: View) -> Edit | Refusal:
    return edits.repeat_clips(design, view, chosen_clips(design, view), 2)


def _of_chosen(edit: Callable[..., Edit | Refusal]) -> Callable[[Design, View], Edit | Refusal]:
    """Return an edit of the clips that are selected."""

    def of_chosen(design: Design, view: View) -> Edit | Refusal:
        return edit(design, view, chosen_clips(design, view))

    return of_chosen


def _fades(clip: Clip) -> tuple[float, float]:
    fade = last_fade(clip.effects)
    return (0.0, 0.0) if fade is None else (fade.in_s, fade.out_s)


def _faded(end: int, design: Design, view: View) -> bool:
    chosen = chosen_clips(design, view)
    return bool(chosen) and all(_fades(design.clip(id))[end] for id in chosen)


def _fade(end: int, design: Design, view: View) -> Edit | Refusal:
    """Fade the selected clips in (0) or out (1), or end that."""
    to_s = 0.0 if _faded(end, design, view) else _FADE_S
    before, label = design, ""
    for id in chosen_clips(design, view):
        lengths_s = list(_fades(design.clip(id)))
        lengths_s[end] = min(to_s, design.clip(id).duration_s / 2)
        outcome = edits.fade_clip(design, view, id, *lengths_s)
        if isinstance(outcome, Refusal):
            return outcome
        design, label = outcome.design, "Fade clips" if label else outcome.label
    if design is before:
        return Refusal(sentence="No clip is selected; click one in the timeline.")
    return Edit(label=label, design=design, view=view)


def _on_timeline(name: str, text: str, hint: str, key: str, **more: object) -> ActionSpec:
    """Return an entry whose key belongs to the timeline."""
    return action(
        name, text, hint, key_elsewhere=key_text("timeline", key), enabled=_has_clip, **more
    )


CLIP: tuple[ActionSpec, ...] = (
    action(
        "show_clip_editor",
        "Edit clip",
        "Open the selected clip in the clip editor, or close it",
        "F4",
        command="panel_focus.show",
        argument="clip_editor",
        keywords="draw waveform envelope pen freehand",
    ),
    action(
        "draw_clip",
        "Draw clip",
        "Draw the selected clip with the pen",
        command="clip_drawing.begin",
        argument="pen",
        enabled=_has_leading_clip,
        keywords="drawn waveform pen freehand samples",
    ),
    action(
        "shape_envelope",
        "Shape envelope",
        "Edit the envelope of the selected clip",
        command="clip_drawing.begin",
        argument="envelope",
        enabled=_has_leading_clip,
        keywords="level breakpoints curve attack decay",
    ),
    _on_timeline(
        "split_clips",
        "Split at playhead",
        "Cut the selected clips in two",
        "split",
        edit=_split,
        keywords="cut divide",
        separated=True,
    ),
    action(
        "stretch_clip",
        "Stretch…",
        "Play the selected clip slower or faster",
        command="clip_stretching.ask",
        enabled=_has_leading_clip,
        keywords="time length duration slower faster",
    ),
    action(
        "fade_in",
        "Fade in",
        "Fade the selected clips in",
        edit=partial(_fade, 0),
        enabled=_has_clip,
        checked=partial(_faded, 0),
        keywords="ramp attack soft",
    ),
    action(
        "fade_out",
        "Fade out",
        "Fade the selected clips out",
        edit=partial(_fade, 1),
        enabled=_has_clip,
        checked=partial(_faded, 1),
        keywords="ramp decay soft",
    ),
    _on_timeline(
        "repeat_clips",
        "Repeat",
        "Play the selected clips once more, as a group",
        "repeat",
        edit=_repeat,
        keywords="again loop copy",
    ),
    _on_timeline(
        "duplicate_clips",
        "Duplicate",
        "Put copies of the selected clips behind them",
        "duplicate",
        edit=_of_chosen(edits.duplicate_clips),
        keywords="copy clone",
    ),
    _on_timeline(
        "mute_clips",
        "Mute",
        "Silence the selected clips",
        "mute",
        edit=_of_chosen(edits.toggle_mute_clips),
        checked=_all_muted,
        keywords="silence off",
    ),
    _on_timeline(
        "remove_clips",
        "Remove clips",
        "Remove the selected clips from their tracks",
        "remove",
        edit=_of_chosen(edits.remove_clips),
        keywords="delete",
    ),
    action(
        "limit_to_band",
        "Limit to band",
        "Add the effect Band limit, with the measured band",
        edit=_of_chosen(edits.limit_to_band),
        enabled=_has_clip,
        keywords="filter bound frequencies outside measured",
        separated=True,
    ),
    action(
        "equalise_on_skin",
        "Balance wavelets",
        "Make the wavelets of a train equally strong on the skin",
        command="levelling.equalise",
        enabled=_has_train,
        keywords="wavelet train gains level loudness equalise normalise equal on the skin",
    ),
    action(
        "match_tracks",
        "Match track levels",
        "Make selected tracks as strong on the skin as the last one",
        command="levelling.match_tracks",
        enabled=_has_tracks,
        keywords="level of selected tracks on the skin balance loudness equal amplitude normalise",
    ),
    action(
        "make_motion",
        "Motion…",
        "Make a motion along a path, or change the selected one",
        command="pages.show_motion",
        keywords="path sweep apparent phantom alternate rabbit travelling wave preset group",
        separated=True,
    ),
)
