"""Motions become tracks of a design."""

from dataclasses import replace

from skinsource.counting import counted
from skinsource.design import MAX_INPUTS, Design
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.motions import Motion
from skinsource.quoting import quoted
from skinsource.view import View


def add_motion(design: Design, view: View, motion: Motion) -> Edit | Refusal:
    """Add the tracks of a motion at the end, and select them."""
    if not isinstance(motion, Motion):
        return Refusal(sentence=f"{quoted(motion)} is no motion; make one of skinsource.motions.")
    try:
        tracks = motion.tracks()
        if len(design.inputs) + len(tracks) > MAX_INPUTS:
            return Refusal(
                sentence=f"{motion.title} takes {counted(len(tracks), 'input')} more, and a "
                f"design holds at most {MAX_INPUTS}; remove some first."
            )
        after = design
        for one in tracks:
            after = after.adding(one)
    except InvalidInputError as error:
        return refused(error)
    return Edit(
        label=f"Add {motion.title.lower()} at {counted(len(tracks), 'place')}",
        design=after,
        view=replace(view, selected_inputs=after.ids[len(design.inputs) :], selected_clips=()),
    )
