"""What an edit leads to."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from skinsource.design import Design, Input
from skinsource.errors import InvalidInputError
from skinsource.locations import input_words
from skinsource.quoting import sentence
from skinsource.view import View


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """Another design and another view, both at once.

    Attributes
    ----------
    label
        What was done, as the history names it: "Mute input at 7 (II pad)".
    design, view
        What there is afterwards.
    said
        What is told once it is done, of what may not be seen.
    """

    label: str
    design: Design
    view: View
    said: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Refusal:
    """Nothing is done; ``sentence`` says why, and what to do instead."""

    sentence: str


NOTHING_CHOSEN = Refusal(sentence="No input is selected; click one, on the hand or in the list.")


def refused(error: InvalidInputError) -> Refusal:
    """Nothing is done, for a value that is not allowed."""
    return Refusal(sentence=sentence(str(error)))


def present(design: Design, ids: Iterable[int]) -> tuple[Input, ...]:
    """Those inputs that ``design`` has, in its order."""
    wanted = set(ids)
    return tuple(one for one in design.inputs if one.id in wanted)


def inputs_words(chosen: tuple[Input, ...], limb: str) -> str:
    """What the history calls them: "input at 7 (II pad)", or "3 inputs"."""
    return (
        f"input at {place_words(chosen[0].location, limb)}"
        if len(chosen) == 1
        else (f"{len(chosen)} inputs")
    )


def place_words(location: int, limb: str = "") -> str:
    """Number and short name of an input place of a limb, "7 (II pad)"."""
    short = input_words(location, limb).short_name
    return str(location) if short == f"place {location}" else f"{location} ({short})"


def changed(
    design: Design,
    view: View,
    verb: str,
    changes: dict[int, dict[str, Any]],
    clip_changes: dict[int, dict[str, Any]] | None = None,
) -> Edit | Refusal:
    """Change fields of inputs, and of clips of them, by id; refused where one is not allowed."""
    chosen = present(design, changes)
    if not chosen:
        return NOTHING_CHOSEN
    try:
        inputs = tuple(
            _with_clips(_replaced(one, changes.get(one.id, {})), clip_changes or {})
            for one in design.inputs
        )
        after = replace(design, inputs=inputs)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label=f"{verb} {inputs_words(chosen, design.limb)}", design=after, view=view)


def with_clips(design: Design, changes: dict[int, dict[str, Any]]) -> Design:
    """Return ``design`` with changed fields of clips, by id.

    Raises
    ------
    InvalidInputError
        A value is not allowed.
    """
    if not changes:
        return design
    return replace(design, inputs=tuple(_with_clips(one, changes) for one in design.inputs))


def _with_clips(one: Input, changes: dict[int, dict[str, Any]]) -> Input:
    if not changes or not any(clip.id in changes for clip in one.clips):
        return one
    clips = tuple(
        replace(clip, **changes[clip.id]) if clip.id in changes else clip for clip in one.clips
    )
    return one if clips == one.clips else replace(one, clips=clips)


def _replaced(one: Input, changes: dict[str, Any]) -> Input:
    # What does not change keeps its identity.
    if not changes:
        return one
    after = replace(one, **changes)
    return one if after == one else after
