"""The chain of effects of a clip."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from skinsource.clips import Clip
from skinsource.clips.clip import MAX_EFFECTS
from skinsource.design import Design
from skinsource.edits.clips import NO_CLIP, clips_words, present_clips
from skinsource.edits.edit import Edit, Refusal, refused, with_clips
from skinsource.effects import Effect, Envelope, Fade, Trim, effect_kinds
from skinsource.errors import InvalidInputError
from skinsource.fields import Breakpoint, specs_of
from skinsource.quoting import quoted
from skinsource.view import View

_GONE = Refusal(sentence="That effect is no longer there; choose another one.")
_FADE_S = 0.02


def add_effect(
    design: Design, view: View, ids: Iterable[int], kind: str, index: int | None = None
) -> Edit | Refusal:
    """Put a new effect into the chains of clips, before the ``index``-th there; None: last."""
    wanted = next((one for one in effect_kinds() if one.__name__ == kind), None)
    if wanted is None:
        known = ", ".join(one.__name__ for one in effect_kinds())
        return Refusal(sentence=f"No effect is called {quoted(kind)}; there are {known}.")
    chosen = present_clips(design, ids)
    if not chosen:
        return NO_CLIP
    if any(len(one.effects) >= MAX_EFFECTS for one in chosen):
        return Refusal(sentence=f"A clip has at most {MAX_EFFECTS} effects; remove one first.")
    chains = {}
    for one in chosen:
        chain = list(one.effects)
        chain.insert(len(chain) if index is None else max(index, 0), fitted(wanted, one))
        chains[one.id] = tuple(chain)
    return _changed(design, view, f"Add {_words(wanted)} to", chosen, chains)


def remove_effect(design: Design, view: View, id: int, index: int) -> Edit | Refusal:
    """Take an effect out of the chain of a clip."""
    one = _with_effect(design, id, index)
    if one is None:
        return _GONE
    chain = (*one.effects[:index], *one.effects[index + 1 :])
    verb = f"Remove {_words(one.effects[index])} from"
    return _changed(design, view, verb, (one,), {id: chain})


def move_effect(design: Design, view: View, id: int, index: int, to: int) -> Edit | Refusal:
    """Let an effect stand at another place of the chain, from 0; as far as there is room."""
    one = _with_effect(design, id, index)
    if one is None:
        return _GONE
    chain = list(one.effects)
    moved = chain.pop(index)
    chain.insert(min(max(to, 0), len(chain)), moved)
    return _changed(design, view, "Reorder effects of", (one,), {id: tuple(chain)})


def switch_effect(design: Design, view: View, id: int, index: int, on: bool) -> Edit | Refusal:
    """Switch an effect on or off."""
    one = _with_effect(design, id, index)
    if one is None:
        return _GONE
    verb = f"Switch {_words(one.effects[index])} {'on' if on else 'off'} in"
    return _set(design, view, verb, one, index, "on", on)


def change_effect_field(
    design: Design, view: View, id: int, index: int, name: str, value: Any
) -> Edit | Refusal:
    """Set a field of an effect."""
    one = _with_effect(design, id, index)
    if one is None or name not in specs_of(one.effects[index]):
        return _GONE
    label = specs_of(one.effects[index])[name].label.lower()
    return _set(design, view, f"Change {label} of", one, index, name, value)


def set_envelope(
    design: Design, view: View, id: int, points: tuple[Breakpoint, ...]
) -> Edit | Refusal:
    """Give a clip an envelope: that of its last one, or of a new one at the end of the chain."""
    found = present_clips(design, (id,))
    if not found:
        return NO_CLIP
    [one] = found
    try:
        drawn = Envelope(points)
    except InvalidInputError as error:
        return refused(error)
    places = [k for k, each in enumerate(one.effects) if isinstance(each, Envelope)]
    if places:
        chain = (*one.effects[: places[-1]], drawn, *one.effects[places[-1] + 1 :])
    elif len(one.effects) < MAX_EFFECTS:
        chain = (*one.effects, drawn)
    else:
        return Refusal(sentence=f"A clip has at most {MAX_EFFECTS} effects; remove one first.")
    return _changed(design, view, "Change envelope of", found, {id: chain})


def fitted(kind: type[Effect], one: Clip) -> Effect:
    """A new effect that fits what a clip plays."""
    length_s = float(f"{min(one.duration_s, 600.0):.12g}")
    if kind is Envelope and length_s > 0.0:
        return Envelope(((0.0, 1.0, "straight"), (length_s, 1.0, "straight")))
    if kind is Fade:
        fade_s = min(_FADE_S, float(f"{length_s / 4.0:.3g}"))
        return Fade(fade_s, fade_s)
    if kind is Trim:
        return Trim(0.0, length_s)
    return kind()


def _with_effect(design: Design, id: int, index: int) -> Clip | None:
    """The clip, if it has an effect at this place."""
    for one in present_clips(design, (id,)):
        if 0 <= index < len(one.effects):
            return one
    return None


def _set(
    design: Design, view: View, verb: str, one: Clip, index: int, name: str, value: Any
) -> Edit | Refusal:
    chain = list(one.effects)
    recipe: Any = chain[index]
    try:
        chain[index] = replace(recipe, **{name: value})
    except InvalidInputError as error:
        return refused(error)
    return _changed(design, view, verb, (one,), {one.id: tuple(chain)})


def _changed(
    design: Design,
    view: View,
    verb: str,
    chosen: tuple[Clip, ...],
    chains: dict[int, tuple[Effect, ...]],
) -> Edit | Refusal:
    try:
        after = with_clips(design, {id: {"effects": chain} for id, chain in chains.items()})
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"{verb} {clips_words(design, chosen)}", design=after, view=view)


def _words(effect: Effect | type[Effect]) -> str:
    return effect.title.lower()
