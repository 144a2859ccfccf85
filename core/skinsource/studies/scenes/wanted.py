"""Scenes of inverse design: their drives, found on the limb where they open, and what those do.

No drives are stored: those for a measured limb are its data, and those for another limb are wrong.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.edits.targets import detach_target, solve_target
from skinsource.design.waveforms.tones import Tone
from skinsource.inverse.aiming import DEEPEST_DB, Aim, aim_of, on_limb, ways
from skinsource.inverse.reproducing import Reproduction, move, reproduce
from skinsource.limbs.catalog import load_limb

#: Outputs beside the nails of digits I to V, the tone that each plays, and what is to be quiet.
_TIPS, _TONES_HZ, _WRIST = (41, 29, 20, 11, 2), (60.0, 90.0, 120.0, 160.0, 210.0), (9, 18, 27, 36)
_TONE_S, _TONE_BETA = 0.2, 0.01
#: Outputs from the middle of digit III to below its knuckle; time and frequency of what travels.
_FINGER, _TRAVEL_S, _CARRIER_HZ = (22, 24, 26), 0.15, 100.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """Designs of a scene with their drives, and a sentence on what those do on their limbs."""

    designs: tuple[Design, ...]
    sentence: str


def _tip_and_next(designs: tuple[Design, ...]) -> Wanted:
    aims = [aim_of(design) for design in designs]
    one, every = (ways(aim)[-1] for aim in aims)
    text = (
        f"Digit III against the tip: {_deep(one.quiet_db)} with one input, "
        f"{_deep(every.quiet_db)} with {len(aims[-1].places)}; between its sensors expect "
        f"{_deep(one.between_db)} and {_deep(every.between_db)}."
    )
    return Wanted(designs=tuple(map(_solved, designs, aims)), sentence=text)


def _five_tones(designs: tuple[Design, ...]) -> Wanted:
    (design,) = designs
    limb = load_limb(design.limb)
    tones = (Tone(frequency_hz=hz, duration_s=_TONE_S) for hz in _TONES_HZ)
    wanted = dict(zip(_TIPS, (tone.samples(limb.sample_rate_hz) for tone in tones), strict=True))
    made = reproduce(limb, wanted, quiet=_WRIST, beta=_TONE_BETA, exact=False)
    errors_db = made.nmse_db.values()
    text = f"The error at the tips lies {-max(errors_db):.0f} to {-min(errors_db):.0f} dB below "
    return Wanted(designs=_playing(designs, [made]), sentence=f"{text}their tones.")


def _both_ways(designs: tuple[Design, ...]) -> Wanted:
    limb = load_limb(designs[0].limb)
    made = [move(limb, path, _TRAVEL_S, _CARRIER_HZ) for path in (_FINGER, _FINGER[::-1])]
    there, back = (each.centroid_error_mm for each in made)
    text = (
        f"The centre of energy is {there:.0f} mm (RMS) from where it should be on the way to the "
        f"wrist, and {back:.0f} mm on the way back."
    )
    return Wanted(designs=_playing(designs, made), sentence=text)


def _reversal_and_contrast(designs: tuple[Design, ...]) -> Wanted:
    aims = [aim_of(design) for design in designs]
    before, after = (ways(aim)[-1] for aim in aims)
    text = (
        f"Against the loudest other output this place has {_over(-before.loudest_db)} with time "
        f"reversal and {_over(-after.loudest_db)} with contrast control, against the mean of the "
        f"others {_over(-before.quiet_db)} and {_over(-after.quiet_db)}; between the sensors "
        f"expect {_over(-before.between_db)} and {_over(-after.between_db)}. Contrast control "
        f"costs {_db(after.effort_db)} more drive energy."
    )
    return Wanted(designs=tuple(map(_solved, designs, aims)), sentence=text)


def _drives_and_layouts(designs: tuple[Design, ...]) -> Wanted:
    first, carried, own = designs
    aims = [aim_of(first), aim_of(own)]
    kind = first.limb.partition("-")[0]
    others = [load_limb(f"{kind}-{k}") for k in (2, 3, 4)]
    theirs = [-on_limb(aims[0], limb).loudest_db for limb in others]
    each_own = [aim_of(replace(own, limb=limb.name)) for limb in others]
    at_home, *of_their_own = (-on_limb(aim, aim.limb).loudest_db for aim in (aims[0], *each_own))
    text = (
        f"Against the loudest other output this place has {_over(at_home)} on limb 1; on limbs "
        f"2, 3 and 4 {_listed(theirs)} with the drives of limb 1, and {_listed(of_their_own)} with "
        "their own from the same inputs."
    )
    solved = _solved(first, aims[0])
    detached = _done(detach_target(solved, View()))
    played = replace(carried, inputs=detached.inputs)
    return Wanted(designs=(solved, played, _solved(own, aims[1])), sentence=text)


def _solved(design: Design, aim: Aim) -> Design:
    return _done(solve_target(design, View(), aim.solved(design)))


def _done(outcome: Edit | Refusal) -> Design:
    if isinstance(outcome, Refusal):
        raise InvalidInputError(outcome.sentence)
    return outcome.design


def _playing(designs: Sequence[Design], made: Sequence[Reproduction]) -> tuple[Design, ...]:
    pairs = zip(designs, made, strict=True)
    return tuple(replace(design, inputs=each.design().inputs) for design, each in pairs)


def _db(level_db: float) -> str:
    return f"{level_db:.1f} dB".replace("-", "−")


def _over(level_db: float) -> str:
    return f"{level_db:+.1f} dB".replace("-", "−")


def _deep(level_db: float) -> str:
    return _db(level_db) if level_db >= DEEPEST_DB else f"below −{-DEEPEST_DB:g} dB"


def _listed(levels_db: Sequence[float]) -> str:
    *most, last = (_over(level_db).removesuffix(" dB") for level_db in levels_db)
    return f"{', '.join(most)} and {last} dB"


#: What finds the drives of a scene, by its name, for its designs on their limbs.
WANTED: dict[str, Callable[[tuple[Design, ...]], Wanted]] = {
    "I1": _tip_and_next,
    "I2": _five_tones,
    "I3": _both_ways,
    "I4": _reversal_and_contrast,
    "I5": _drives_and_layouts,
}
