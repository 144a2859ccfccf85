"""A target: where the skin is to be strong and where quiet, and the drives that were found for it.

It stands in a design as motions do, as a group of ordinary clips.  `skinsource.inverse.aiming`
finds the drives.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar

from skinsource.base.conventions import Axes
from skinsource.base.errors import InvalidInputError, counted
from skinsource.design.clips import PLACE
from skinsource.design.design import AXES, OUTPUTS, Design, Input
from skinsource.design.motions import LEVEL, MAX_PATH, START, WAVEFORM, ms_text, tracks_of
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import RECORDING_SAMPLES, Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource.specs.samples import Samples
from skinsource.specs.spec import TextSpec

INPUTS = ListSpec(
    label="Inputs",
    of=PLACE,
    most=MAX_PATH,
    different=True,
    hint="Places; else those that push, of own limbs all",
    unset="usual",
)
BETA = NumberSpec(
    label="Strong or sharp",
    minimum=1e-3,
    maximum=1e3,
    step=0.1,
    logarithmic=True,
    hint="β: small is sharp, large is strong",
    # It has a slider.
    editable=False,
)
MOST = NumberSpec(
    label="Inputs at most",
    minimum=0,
    maximum=MAX_PATH,
    whole=True,
    hint="Number of places that play",
    unset="all",
)
PLACES = replace(INPUTS, label="Places", editable=False, unset="none")
DRIVES = ListSpec(label="Drives", of=RECORDING_SAMPLES, most=MAX_PATH, editable=False)
NO_TARGET = "There is no target; paint a strong output on the skin map."
LEVEL_THERE = replace(LEVEL, label="Level", unit="m/s²", hint="Peak at the strong outputs")
PEAK = NumberSpec(
    label="Peak",
    unit="m/s²",
    minimum=0.0,
    maximum=LEVEL.maximum,
    step=LEVEL.step,
    hint="Largest drive of each input; it may cost level",
    unset="no limit",
)
SOLVED_FOR = TextSpec(label="Solved for", longest=400, one_line=True, editable=False)
STRONG = replace(OUTPUTS, label="Strong", hint="Outputs, painted on the skin map or typed")
QUIET = replace(
    STRONG, label="Quiet", hint="Outputs; else all others on the hand", unset="all others"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Target(fields.CheckedModel):
    """What the skin should feel, and the drives that come nearest to it.

    Attributes
    ----------
    strong, quiet
        Outputs, from 1; without quiet ones all others of the hand are to be quiet.
    axes
        Along which outputs count.
    beta
        Small is sharp, large is strong, see `skinsource.inverse.focus`.
    inputs
        Places that may be used; none: as `skinsource.inverse.focus` chooses.
    most
        Number of places that play, at most; 0: all of them.
    waveform
        What the strong outputs are to play.
    amplitude
        Acceleration at the strong outputs where the waveform is 1, m/s²; of own limbs in the unit
        of their responses.
    peak
        Most that a drive may reach, in its unit; 0: there is no limit.
    onset_s
        When the drives start.
    places, drives
        Places that play, and what each plays for an amplitude of 1.
    solved_for
        Limb and scaling for which they were found, see `conditions_of`; empty: they are not yet.
    """

    title: ClassVar[str] = "Target"
    law: ClassVar[str] = (
        "At each frequency: least energy at quiet outputs, plus β times that of the drives."
    )
    source: ClassVar[str] = "Pressure matching with effort, as for personal sound zones."
    limits: ClassVar[str] = (
        "Predicted acceleration at the sensors, nearly all on the back of the hand. What is felt "
        "is not predicted; pads and palm have no output."
    )

    strong: tuple[int, ...] = fields.field(STRONG, ())
    quiet: tuple[int, ...] = fields.field(QUIET, ())
    axes: Axes = fields.choice("z", AXES)
    beta: float = fields.number(0.3, BETA)
    inputs: tuple[int, ...] = fields.field(INPUTS, ())
    most: int = fields.number(0, MOST)
    waveform: Waveform = fields.field(WAVEFORM, Tone(100.0, duration_s=0.2))
    amplitude: float = fields.number(1.0, LEVEL_THERE)
    peak: float = fields.number(0.0, PEAK)
    onset_s: float = fields.number(0.0, START)
    places: tuple[int, ...] = fields.field(PLACES, ())
    drives: tuple[Samples, ...] = fields.field(DRIVES, ())
    solved_for: str = fields.text("", SOLVED_FOR)

    def __post_init__(self) -> None:
        fields.check(self)
        if both := set(self.strong) & set(self.quiet):
            raise InvalidInputError(
                f"output {min(both)} of a target is strong and quiet; choose one"
            )
        if len(self.places) != len(self.drives):
            raise InvalidInputError(
                f"a target has {len(self.places)} places and {len(self.drives)} drives, expected "
                "as many of both"
            )

    @property
    def path(self) -> tuple[int, ...]:
        """The places that play."""
        return self.places

    @property
    def summary(self) -> str:
        """Describe it in a phrase."""
        return (
            f"{counted(len(self.strong), 'strong output')}, {len(self.quiet)} quiet, "
            f"{ms_text(self.waveform.duration_s)}"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place that plays."""
        waveforms = ({"waveform": Recording(samples, self.title)} for samples in self.drives)
        return tracks_of(self, self.places, waveforms)

    def painted(self, outputs: tuple[int, ...], brush: str) -> Target:
        """Return a copy with outputs that are ``"strong"`` or ``"quiet"``; else they are free."""
        wanted = {"strong": {*self.strong}, "quiet": {*self.quiet}}
        for which in wanted.values():
            which.difference_update(outputs)
        if brush in wanted:
            wanted[brush].update(outputs)
        changes: dict[str, Any] = {name: tuple(sorted(which)) for name, which in wanted.items()}
        return replace(self, **changes).taking_drives(self)

    def taking_drives(self, solved: Target) -> Target:
        """Return a copy with the drives of another target, solved if that wants the same.

        Without a strong output nothing plays.
        """
        if not self.strong:
            solved = Target()
        unsolved: dict[str, Any] = {"places": (), "drives": (), "solved_for": ""}
        wanted = replace(solved, onset_s=self.onset_s, **unsolved)
        if not self.peak:
            wanted = replace(wanted, amplitude=self.amplitude)
        solved_for = solved.solved_for if wanted == replace(self, **unsolved) else ""
        return replace(self, places=solved.places, drives=solved.drives, solved_for=solved_for)


def target_in(design: Design) -> tuple[int, Target] | None:
    """Return the target of a design and its index among the motions; None: it has none."""
    groups = reversed(list(enumerate(design.motions)))
    return next(
        ((k, group.motion) for k, group in groups if isinstance(group.motion, Target)), None
    )


def conditions_of(design: Design) -> str:
    """Return what of a design the drives of a target depend on, besides the target."""
    actuated, digest = design.actuated, design.limb_digest or facts_of(design.limb).digest
    volts = "V" if actuated is not None and actuated.equaliser is None else ""
    return f"{design.limb} {digest} {design.scaling} {volts}".strip()


def is_unsolved(design: Design) -> bool:
    """Return whether the drives of the target of a design have to be found."""
    found = target_in(design)
    if found is None or not found[1].strong:
        return False
    return found[1].solved_for != conditions_of(design)
