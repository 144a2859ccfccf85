"""Change limb, scaling, actuators and how results are shown; mend findings and silent inputs."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import PolePairReplacement, RegularisedInverse
from skinsource.actuators.rigs import Rig
from skinsource.base.conventions import ALL_AXES
from skinsource.base.errors import InvalidInputError, SkinSourceError, lowered, quoted
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View, audible_inputs, louder
from skinsource.design.edits.edit import Edit, Refusal, change_view, refusing
from skinsource.design.edits.effects import limit_to_band
from skinsource.design.effects.level import BandLimit, Fade
from skinsource.design.labels import SCALINGS, label_of
from skinsource.design.signal_path import actuation_of_rig, check_drive, drive_of_clips
from skinsource.design.waveforms.pulses import CentredTap, Tap
from skinsource.design.waveforms.samples import Drawn
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource.perception.validity import Finding
from skinsource.specs.samples import Samples


@refusing
def change_limb(design: Design, view: View, limb: str) -> Edit | Refusal:
    """Change the limb; the chosen axes stay as far as the limb has them.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.change_limb(design, ss.View(), "synthetic-2")
    >>> print(edit.design.limb)
    synthetic-2
    """
    facts = facts_of(limb) if isinstance(limb, str) else None
    if facts is None or not facts.known:
        return Refusal(sentence=f"No limb is called {quoted(limb)}; choose one of the list.")
    after = replace(design, limb=limb, limb_digest=facts.digest)
    chose_all = view.axes in (facts_of(design.limb).axes, ALL_AXES)
    axes = facts.axes if chose_all else axes_on(limb, view.axes)
    view = replace(view, axes=axes)
    return Edit(label=f"Change limb to {facts.title}", design=after, view=view)


@refusing
def change_scaling(design: Design, view: View, scaling: Any) -> Edit | Refusal:
    """Change what amplitudes mean.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.change_scaling(design, ss.View(), "relative")
    >>> print(edit.design.scaling)
    relative
    """
    if design.actuated is not None and scaling != "probe":
        return Refusal(
            sentence="With another scaling, drives are not accelerations, so no prediction goes "
            "through an actuator. Switch off Predict through the actuator first."
        )
    after = replace(design, scaling=scaling)
    title = lowered(label_of(SCALINGS, scaling).title)
    return Edit(label=f"Change scaling to {title}", design=after, view=view)


@refusing
def look_along(design: Design, view: View, axes: Any) -> Edit | Refusal:
    """Choose the axes that are shown.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.look_along(design, ss.View(), "z")
    >>> print(edit.view.axes)
    z
    """
    return change_view(design, view, "Change axes", axes=axes)


@refusing
def look_by_method(design: Design, view: View, method: Any) -> Edit | Refusal:
    """Choose how several axes become one signal.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.look_by_method(design, ss.View(), "mag")
    >>> print(edit.view.method)
    mag
    """
    return change_view(design, view, "Change method", method=method)


@refusing
def level_over(design: Design, view: View, span: Any) -> Edit | Refusal:
    """Choose what levels average over.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.level_over(design, ss.View(), "loudest")
    >>> print(edit.view.span)
    loudest
    """
    return change_view(design, view, "Change levels", span=span)


@refusing
def remove_delay(design: Design, view: View, removed: bool) -> Edit | Refusal:
    """Shift time axes by the pre-trigger delay, or back; a zoom keeps showing the same part.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.remove_delay(design, ss.View(), True)
    >>> print(edit.view.delay_removed)
    True
    """
    if removed == view.delay_removed:
        return Edit(label="Remove delay", design=design, view=view)
    range_s = view.time_range_s
    if range_s is not None:
        delay_s = facts_of(design.limb).pre_trigger_delay_s
        shift_s = -delay_s if removed else delay_s
        range_s = (range_s[0] + shift_s, range_s[1] + shift_s)
    label = "Remove delay" if removed else "Restore delay"
    return change_view(design, view, label, delay_removed=removed, time_range_s=range_s)


@refusing
def play_slower(design: Design, view: View, slow_motion: Any) -> Edit | Refusal:
    """Choose how many times slower than in reality the animation plays.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.play_slower(design, ss.View(), 10.0)
    >>> print(edit.view.slow_motion)
    10.0
    """
    return change_view(design, view, "Change slow motion", slow_motion=slow_motion)


_NEEDS_PROBE = (
    "Predict through the actuator needs drives that are accelerations or volts. Choose the scaling "
    "Probe acceleration first."
)


@refusing
def predict_through(design: Design, view: View, actuation: Actuation | None) -> Edit | Refusal:
    """Predict through actuators; None: without, and the design keeps them switched off.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> edit = ss.edits.predict_through(design, ss.View(), None)
    >>> print(edit.label)
    Predict without the actuator
    """
    if actuation is not None and actuation.on and design.scaling != "probe":
        return Refusal(sentence=_NEEDS_PROBE)
    if actuation is None and design.actuation is not None:
        actuation = replace(design.actuation, on=False)
    on = actuation is not None and actuation.on
    label = "Predict through the actuator" if on else "Predict without the actuator"
    return Edit(label=label, design=replace(design, actuation=actuation), view=view)


_OF_RIG = Refusal(
    sentence="The rig says which actuators move the skin. Choose another rig, or none, first."
)


@refusing
def choose_actuation(design: Design, view: View, actuation: Actuation | None) -> Edit | Refusal:
    """Choose actuators and equaliser; predictions go through them as before.  None: none.

    Other actuators than those of the rig, which exports are for, are refused.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> coil = ss.ActuatorAt(actuator="coil", model=ss.actuators.load("example-voice-coil"))
    >>> edit = ss.edits.choose_actuation(design, ss.View(), ss.Actuation(actuators=(coil,)))
    >>> print(edit.design.actuation.on)
    False
    """
    known, label = design.actuation, "Remove the actuator"
    if actuation is not None:
        actuation = replace(actuation, on=design.actuated is not None)
        same = known is not None and known.actuators == actuation.actuators
        label = "Change the equaliser" if same else "Change the actuator"
        if design.rig is not None and not same:
            with suppress(InvalidInputError):
                if actuation_of_rig(design.rig).actuators != actuation.actuators:
                    return _OF_RIG
    return Edit(label=label, design=replace(design, actuation=actuation), view=view)


@refusing
def choose_rig(design: Design, view: View, rig: Rig | None) -> Edit | Refusal:
    """Choose the rig, and its actuators where it says how they move; None: no rig.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> rig = ss.actuators.rigs.Rig(title="Bench 3")
    >>> edit = ss.edits.choose_rig(design, ss.View(), rig)
    >>> print(edit.design.rig.title)
    Bench 3
    """
    known = design.actuation
    actuation = None if known is not None and known.rig else known
    if rig is not None:
        # A rig that does not say how its actuators move leaves the choice of them.
        with suppress(InvalidInputError):
            equaliser = None if known is None else known.equaliser
            on, wired = design.actuated is not None, actuation_of_rig(rig)
            if known is not None and isinstance(equaliser, PolePairReplacement):
                # Its pole pair is that of one actuator.
                before, after = ([at.model for at in of.actuators] for of in (known, wired))
                equaliser = equaliser if before == after else RegularisedInverse()
            actuation = replace(wired, equaliser=equaliser, on=on)
    label = "Remove the rig" if rig is None else "Change the rig"
    return Edit(label=label, design=replace(design, actuation=actuation, rig=rig), view=view)


_NO_REPAIR = Refusal(sentence="No edit mends this condition; see its sentence.")
# Slightly below the limit, so that rounding does not leave the lamp on.
_BELOW_LIMIT = 0.999


@refusing
def mend(design: Design, view: View, finding: Finding) -> Edit | Refusal:
    """Repair a finding of the validity check, see `Finding.repair`.

    Examples
    --------
    >>> import skinsource as ss
    >>> design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(8)))
    >>> loud = ss.edits.change_field(design, ss.View(), [1], "amplitude", 60.0).design
    >>> findings = ss.evaluate(loud, "validity")["validity"]
    >>> fast = next(finding for finding in findings if finding.repair == "quieter")
    >>> edit = ss.edits.mend(loud, ss.View(), fast)
    >>> print(edit.label)
    Limit to 40 mm/s
    """
    if finding.repair == "probe_scaling":
        return change_scaling(design, view, "probe")
    if finding.repair == "quieter":
        after = louder(design, finding.factor * _BELOW_LIMIT)
        return Edit(label="Limit to 40 mm/s", design=after, view=view)
    if finding.repair == "band_limit":
        audible = audible_inputs(design.inputs)
        return limit_to_band(design, view, [clip.id for track in audible for clip in track.clips])
    if finding.repair == "deselect":
        outputs = tuple(output for output in view.outputs if output not in finding.outputs)
        if outputs == view.outputs:
            return Refusal(sentence="No selected output is mostly noise; select others.")
        return change_view(design, view, "Deselect noisy outputs", outputs=outputs)
    return _NO_REPAIR


# Longest fade that mends, and the share of a clip that it takes at most.
_LONGEST_FADE_S, _FADED_SHARE = 0.05, 0.25


def mends(design: Design, view: View, id: int) -> tuple[Edit, ...]:
    """Return edits after which nothing keeps an input from being played, the best one first.

    At most one of them changes its clips, and only if that is enough.
    """
    track = design.input(id)

    edits = []
    for label, change in _changes(design):
        # What cannot be sampled cannot be balanced either.
        with suppress(SkinSourceError):
            clips = tuple(clip if clip.muted else change(clip) for clip in track.clips)
            after = design.with_input(design.index_of(id), clips=clips)
            if clips != track.clips and _plays(after, id):
                edits.append(Edit(label=label, design=after, view=view))
                break
    muted = design.with_input(design.index_of(id), muted=True)
    edits.append(Edit(label="Mute it", design=muted, view=view))
    without = predict_through(design, view, None)
    if isinstance(without, Edit) and design.actuated is not None and _plays(without.design, id):
        edits.append(without)
    return tuple(edits)


def repair_for_actuators(design: Design, view: View, id: int) -> Edit | None:
    """Return the edit that lets the chosen actuators follow an input; None: none has to, or can."""
    if design.actuation is None or id not in design.ids:
        return None
    through = replace(design, actuation=replace(design.actuation, on=True))
    edit = mends(through, view, id)[0]
    if edit.design.input(id).muted or _plays(through, id):
        return None
    return replace(edit, design=replace(edit.design, actuation=design.actuation))


def _changes(design: Design) -> Iterator[tuple[str, Callable[[Clip], Clip]]]:
    """Yield labels of edits, and what they do to a clip; those that change least come first."""
    facts = facts_of(design.limb)

    def centred(clip: Clip) -> Clip:
        return replace(clip, waveform=CentredTap()) if isinstance(clip.waveform, Tap) else clip

    yield "Use a centred tap", centred
    if facts.band_hz is not None:
        limit = BandLimit(low_hz=facts.band_hz[0], high_hz=facts.band_hz[1])
        yield "Limit to the band", lambda clip: replace(clip, effects=(*clip.effects, limit))

    def faded(clip: Clip) -> Clip:
        fade_s = min(_LONGEST_FADE_S, _FADED_SHARE * clip.duration_s)
        return replace(clip, effects=(*clip.effects, Fade(in_s=fade_s, out_s=fade_s)))

    def balanced(clip: Clip) -> Clip:
        """Take away a slow bump with the velocity that the samples leave."""
        rate_hz = facts.sample_rate_hz
        samples = clip.waveform.samples(rate_hz)
        bump = np.hanning(samples.size + 2)[1:-1]
        left = samples - bump * (samples.sum() / bump.sum())
        return replace(clip, waveform=Drawn(Samples(values=left, sample_rate_hz=rate_hz)))

    yield "Fade in and out", faded
    yield "Balance the samples", balanced


def _plays(design: Design, id: int) -> bool:
    track, facts = design.input(id), facts_of(design.limb)
    rate_hz, place = facts.sample_rate_hz, track.location
    try:
        _, drive = drive_of_clips(track.clips, track.gain_curve, rate_hz, place)
        if design.actuated is not None:
            design.actuated.at(place)
        check_drive(design.actuated, drive, rate_hz, facts.band_hz, place)
    except SkinSourceError:
        return False
    return place <= facts.n_inputs
