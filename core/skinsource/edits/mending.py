"""Edits that bring a design back to where predictions hold."""

from dataclasses import replace

from skinsource.design import Design, audible_inputs
from skinsource.edits.edit import Edit, Refusal, refused
from skinsource.edits.setup import change_scaling
from skinsource.effects import BandLimit
from skinsource.errors import InvalidInputError
from skinsource.own_limbs import facts_of
from skinsource.validity import Finding
from skinsource.view import View

_NOTHING = Refusal(sentence="Nothing can be done about this one here.")
# A hair below the limit, so that rounding does not leave the lamp lit.
_BELOW = 0.999


def mend(design: Design, view: View, finding: Finding) -> Edit | Refusal:
    """Do what mends a finding, see `Finding.mend`."""
    if finding.mend == "probe_scaling":
        return change_scaling(design, view, "probe")
    if finding.mend == "quieter":
        return _quieter(design, view, finding.factor * _BELOW)
    if finding.mend == "band_limit":
        return _band_limited(design, view)
    if finding.mend == "deselect":
        kept = tuple(one for one in view.outputs if one not in finding.outputs)
        if kept == view.outputs:
            return Refusal(sentence="None of the selected outputs is mostly noise.")
        return Edit(
            label="Deselect outputs that are mostly noise",
            design=design,
            view=replace(view, outputs=kept),
        )
    return _NOTHING


def _quieter(design: Design, view: View, factor: float) -> Edit | Refusal:
    """All amplitudes smaller by one factor: what differs between inputs stays."""
    inputs = tuple(replace(one, amplitude=one.amplitude * factor) for one in design.inputs)
    return Edit(label="Play within 40 mm/s", design=replace(design, inputs=inputs), view=view)


def _band_limited(design: Design, view: View) -> Edit | Refusal:
    """A band limit at the end of the chain of each clip that is heard."""
    heard = {one.id for one in audible_inputs(design.inputs)}
    band_hz = facts_of(design.limb).band_hz
    if band_hz is None:
        return _NOTHING
    try:
        limit = BandLimit(low_hz=band_hz[0], high_hz=band_hz[1])
        inputs = tuple(
            replace(
                one,
                clips=tuple(replace(clip, effects=(*clip.effects, limit)) for clip in one.clips),
            )
            if one.id in heard
            else one
            for one in design.inputs
        )
        after = replace(design, inputs=inputs)
    except InvalidInputError as error:
        return refused(error)
    return Edit(label="Limit clips to the measured band", design=after, view=view)
