"""What a prediction beside the one of the window starts from, and why there may be none."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from skinsource.base.errors import SkinSourceError
from skinsource.base.work import counted
from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.edits import Refusal
from skinsource.design.view import View
from skinsource.engine.quantities import sources
from skinsource.limbs.limb import LIVE_INPUTS, LIVE_OUTPUTS
from skinsource.limbs.own_limbs import axes_on, facts_of

#: Of these is made what takes long on a large limb; drives and clips are not.
FROM_THE_LIMB = frozenset({"driven_limb", "surface"})
#: What is of the selected outputs, of all that is wanted of designs beside the one of the window.
OF_OUTPUTS = frozenset({"axis_traces", "shown_outputs"})
#: What levels depend on.
_DEPENDS_ON = (
    "limb",
    "limb_digest",
    "limb_mirrored",
    "inputs",
    "scaling",
    "actuation",
    "match_gain",
    "axes",
    "method",
    "span",
)


def sources_shown(design: Design, view: View) -> dict[str, Any]:
    """What evaluation of the design in the window starts from: as loud as it is shown.

    Here and in `sources_of_levels` an input that cannot be played is left out, and named by
    ``unplayable_inputs``: the others are still seen.
    """
    return sources(design, view, match_gain=view.match_gain(design), leave_out_unplayable=True)


def sources_of_levels(
    design: Design, view: View, *, match_gain: float = 1.0, with_outputs: bool = False
) -> dict[str, Any]:
    """What evaluation starts from: of the view only what levels depend on.

    The rest of it changes while one looks around.  A design on a limb that has not been measured
    along the axes of the view is looked at along those that it has.  ``match_gain``: see
    `skinsource.engine.quantities.sources`.  ``with_outputs``: what is wanted is also of the
    selected outputs, as traces are.
    """
    axes = axes_on(design.limb, view.axes)
    seen = View(axes=axes, method=view.method, span=view.span, selected_inputs=())
    if with_outputs:
        seen = replace(seen, outputs=view.outputs)
    return sources(design, seen, match_gain=match_gain, leave_out_unplayable=True)


def on_limb(design: Design, view: View, limb: str) -> tuple[Design, View] | str:
    """The design on a limb and how it is looked at there; or why there is no such thing."""
    if limb == design.limb:
        return design, view
    edit = edits.change_limb(design, view, limb)
    return edit.sentence if isinstance(edit, Refusal) else (edit.design, edit.view)


def key_of_levels(given: Mapping[str, Any]) -> tuple[Any, ...]:
    """What the same levels have in common, of what an evaluation starts from."""
    return tuple(given[name] for name in _DEPENDS_ON)


def too_large(limb: str) -> str:
    """Why a limb is not computed while one edits, in a sentence; empty if it is."""
    facts = facts_of(limb)
    if facts.live:
        return ""
    return (
        f"{facts.title} has {counted(facts.n_inputs, 'place')} and "
        f"{counted(facts.n_outputs, 'output')}, and results follow edits up to "
        f"{LIVE_INPUTS} and {LIVE_OUTPUTS}. File > Export and sweeps compute it."
    )


def reason_of(error: Exception | None) -> str:
    """Why there are no values, in words for the user."""
    if isinstance(error, SkinSourceError):
        return str(error)
    return f"The studio made a mistake: {type(error).__name__}: {error}"
