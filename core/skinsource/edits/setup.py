"""What the whole window is about: limb, scaling, and how accelerations are looked at."""

from dataclasses import replace
from typing import Any

from skinsource.choice_words import SCALINGS, word_of
from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.errors import InvalidInputError
from skinsource.limb import ALL_AXES, Axes, LimbFacts
from skinsource.own_limbs import axes_on, facts_of
from skinsource.quoting import quoted
from skinsource.view import View


def change_limb(design: Design, view: View, limb: str) -> Edit | Refusal:
    """Take another limb; of its axes, those that are looked at now, or all."""
    facts = facts_of(limb) if isinstance(limb, str) else None
    if facts is None or not facts.known:
        return Refusal(sentence=f"No limb is called {quoted(limb)}; choose one of the list.")
    after = replace(design, limb=limb, limb_digest=facts.digest)
    view = replace(view, axes=_fitting_axes(view.axes, facts_of(design.limb), facts))
    return Edit(label=f"Change limb to {facts.title}", design=after, view=view)


def change_scaling(design: Design, view: View, scaling: Any) -> Edit | Refusal:
    """Let amplitudes mean something else."""
    if design.actuated is not None and scaling != "probe":
        return Refusal(
            sentence="Under another scaling drives are no accelerations, and nothing is predicted "
            "through an actuator. Switch off Predict through the actuator first."
        )
    try:
        after = replace(design, scaling=scaling)
    except InvalidInputError as error:
        return refused(error)
    words = word_of(SCALINGS, scaling).title
    return Edit(label=f"Change scaling to {words[:1].lower()}{words[1:]}", design=after, view=view)


def look_along(design: Design, view: View, axes: Any) -> Edit | Refusal:
    """Look at other axes."""
    return _looked_at(design, view, "Change axes", axes=axes)


def look_by_method(design: Design, view: View, method: Any) -> Edit | Refusal:
    """Make one signal of several axes in another way."""
    return _looked_at(design, view, "Change method", method=method)


def level_over(design: Design, view: View, span: Any) -> Edit | Refusal:
    """Let levels average over something else."""
    return _looked_at(design, view, "Change what levels average over", span=span)


def remove_delay(design: Design, view: View, removed: bool) -> Edit | Refusal:
    """Shift time axes by the pre-trigger delay, or back; a zoom stays on the same piece."""
    if removed == view.delay_removed:
        return Edit(label="Remove delay", design=design, view=view)
    shown = view.time_range_s
    if shown is not None:
        delay_s = facts_of(design.limb).pre_trigger_delay_s
        shift_s = -delay_s if removed else delay_s
        shown = (shown[0] + shift_s, shown[1] + shift_s)
    label = "Remove delay" if removed else "Bring back delay"
    return _looked_at(design, view, label, delay_removed=removed, time_range_s=shown)


def play_slower(design: Design, view: View, slow_motion: Any) -> Edit | Refusal:
    """Play so many times slower than it happens."""
    return _looked_at(design, view, "Change slow motion", slow_motion=slow_motion)


def _fitting_axes(axes: Axes, before: LimbFacts, after: LimbFacts) -> Axes:
    """All stay all; else those that the other limb measures along too, and all if there is none."""
    if axes in (before.axes, ALL_AXES):
        return after.axes
    return axes_on(after.name, axes)


def _looked_at(design: Design, view: View, label: str, **changes: Any) -> Edit | Refusal:
    try:
        return Edit(label=label, design=design, view=replace(view, **changes))
    except InvalidInputError as error:
        return refused(error)
