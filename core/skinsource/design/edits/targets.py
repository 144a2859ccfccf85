"""Paint a target, change its fields, take over its drives, and make it ordinary clips.

A design has one target at a time.  An edit leaves the drives as they are: they are found again away
from the window, see `skinsource.design.target.is_unsolved`.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from skinsource.base.errors import InvalidInputError, counted
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit, Refusal, listed, refusing
from skinsource.design.edits.motions import add_motion, change_motion
from skinsource.design.panel_settings import BRUSH, NO_BRUSH
from skinsource.design.target import NO_TARGET, Target, target_in


@refusing
def paint_target(
    design: Design, view: View, outputs: Sequence[int], brush: str = "strong"
) -> Edit | Refusal:
    """Make outputs strong or quiet, or erase them; the first stroke makes a target.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1")
    >>> edit = ss.edits.paint_target(design, ss.View(), [30])
    >>> print(edit.design.motions[0].motion.strong, edit.label)
    (30,) Paint 1 output strong
    """
    outputs, brush = listed(outputs), BRUSH.checked(brush)
    if brush == NO_BRUSH:
        return Refusal(sentence="No brush is chosen; take Strong, Quiet or Erase.")
    found = target_in(design)
    target = Target() if found is None else found[1]
    if found is None:
        # The playhead may be later than the latest onset.
        with suppress(InvalidInputError):
            target = replace(target, onset_s=view.playhead_s)
    label = "Erase" if brush == "erase" else "Paint"
    how = "" if brush == "erase" else f" {brush}"
    painted = target.painted(outputs, brush)
    return _with_target(design, view, painted, f"{label} {counted(len(outputs), 'output')}{how}")


@refusing
def change_target(design: Design, view: View, target: Target) -> Edit | Refusal:
    """Change fields of the target; its drives stay until it is solved.

    Examples
    --------
    >>> from dataclasses import replace
    >>> import skinsource as ss
    >>> from skinsource.design.target import target_in
    >>> design = ss.edits.paint_target(ss.Design(limb="synthetic-1"), ss.View(), [30]).design
    >>> sharper = replace(target_in(design)[1], beta=0.1)
    >>> print(ss.edits.change_target(design, ss.View(), sharper).design.motions[0].motion.beta)
    0.1
    """
    found = target_in(design)
    changed = target if found is None else target.taking_drives(found[1])
    return _with_target(design, view, changed, "Change target")


@refusing
def solve_target(design: Design, view: View, solved: Target) -> Edit | Refusal:
    """Have the target play the drives of a solved one.

    Examples
    --------
    >>> import skinsource as ss
    >>> from skinsource.inverse.aiming import aim_of
    >>> design = ss.edits.paint_target(ss.Design(limb="synthetic-1"), ss.View(), [30]).design
    >>> solved = aim_of(design).solved(design)
    >>> print(len(ss.edits.solve_target(design, ss.View(), solved).design.inputs))
    15
    """
    found = target_in(design)
    if found is None:
        return Refusal(sentence=NO_TARGET)
    return _with_target(design, view, found[1].taking_drives(solved), "Solve target")


@refusing
def detach_target(design: Design, view: View) -> Edit | Refusal:
    """Leave the clips of the target as ordinary ones, which are not solved again.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.edits.paint_target(ss.Design(limb="synthetic-1"), ss.View(), [30]).design
    >>> print(ss.edits.detach_target(design, ss.View()).design.motions)
    ()
    """
    found = target_in(design)
    if found is None:
        return Refusal(sentence=NO_TARGET)
    motions = tuple(group for k, group in enumerate(design.motions) if k != found[0])
    return Edit(label="Detach target", design=replace(design, motions=motions), view=view)


def _with_target(design: Design, view: View, target: Target, label: str) -> Edit | Refusal:
    """Return an edit that takes over a target; what is selected stays so."""
    found = target_in(design)
    if found is None:
        outcome = add_motion(design, view, target)
    else:
        outcome = change_motion(design, view, found[0], target)
    return outcome if isinstance(outcome, Refusal) else replace(outcome, label=label, view=view)
