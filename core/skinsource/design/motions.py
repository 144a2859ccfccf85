"""Motions write ordinary tracks, so that something seems to move over the skin.

A motion is a frozen dataclass with fields from `skinsource.specs.fields`, and everything that
`Motion` names.  To add one, write its class here and name it in `MOTIONS`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import groupby, pairwise
from math import degrees, pi, remainder, sqrt
from typing import Any, ClassVar, Protocol, runtime_checkable

from skinsource.base.errors import InvalidInputError, counted, quoted
from skinsource.design.clips import ONSET, PLACE, Clip
from skinsource.design.design import AMPLITUDE, Input
from skinsource.design.effects.level import Fade
from skinsource.design.effects.time import Trim
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms import kinds
from skinsource.design.waveforms.periodic import Saw, Square, Triangle
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec

__all__ = [
    "MOTIONS",
    "Alternation",
    "ApparentMotion",
    "Motion",
    "Phantom",
    "Sweep",
    "TapSequence",
    "TravellingPhase",
]


@runtime_checkable
class Motion(Protocol):
    """A frozen dataclass that writes tracks.

    Attributes
    ----------
    title
        Name for the user.
    law
        The rule that gives times and amplitudes, in a line.
    source
        Publication of the rule.
    limits
        What is known about the rule on the palm, and what is not.
    """

    title: ClassVar[str]
    law: ClassVar[str]
    source: ClassVar[str]
    limits: ClassVar[str]

    @property
    def path(self) -> tuple[int, ...]:
        """Return the input places in the order in which they are passed."""

    @property
    def waveform(self) -> Waveform:
        """Return what plays at the places."""

    @property
    def summary(self) -> str:
        """Describe the times in a phrase."""

    def tracks(self) -> tuple[Input, ...]:
        """Return the tracks, one for each place, in the order of the path.

        Raises
        ------
        InvalidInputError
            A clip would start later than one may.
        """


#: The largest number of places in a path; a place may come again.
MAX_PATH = 100

PATH = ListSpec(
    label="Path",
    of=PLACE,
    fewest=2,
    most=MAX_PATH,
    hint="Places in their order",
    # It is clicked on the hand.
    editable=False,
)
WAVEFORM = ModelSpec(label="Waveform", kinds=kinds, hint="What plays at each place")
START = replace(ONSET, label="Start", hint="When it begins")
SPACING = NumberSpec(
    label="Spacing",
    unit="s",
    minimum=0.001,
    maximum=60.0,
    step=0.005,
    hint="Stimulus onset asynchrony: from one start to the next",
)
LEVEL = replace(AMPLITUDE, minimum=0.0, hint="Amplitude of each input")


def tracks_of(
    motion: Any, locations: Sequence[int], clips: Iterable[dict[str, Any]]
) -> tuple[Input, ...]:
    """Return a track for each location, with its clips by their fields; locations keep their order.

    A clip plays the waveform of the motion from its onset on, unless its fields say otherwise.
    """
    clips_at: dict[int, list[Clip]] = {}
    for k, (location, fields_of_clip) in enumerate(zip(locations, clips, strict=True)):
        label = f"{motion.title} {k + 1}/{len(locations)}"
        clip = {"onset_s": motion.onset_s, "waveform": motion.waveform, **fields_of_clip}
        clips_at.setdefault(location, []).append(Clip(label=label, **clip))
    return tuple(
        Input(location=location, clips=tuple(clips), amplitude=motion.amplitude)
        for location, clips in clips_at.items()
    )


def _evenly_spaced_tracks(
    motion: Alternation | ApparentMotion | TapSequence, locations: Sequence[int]
) -> tuple[Input, ...]:
    """Return tracks that play the waveform of a motion at one location after the other."""
    onsets_s = (motion.onset_s + k * motion.spacing_s for k in range(len(locations)))
    return tracks_of(motion, locations, ({"onset_s": onset_s} for onset_s in onsets_s))


def ms_text(time_s: float) -> str:
    """Return a time as a text in milliseconds.

    >>> ms_text(0.0793)
    '79.3 ms'
    """
    return f"{1e3 * time_s:.4g} ms"


def _gap_text(spacing_s: float, duration_s: float) -> str:
    """Say whether two bursts that follow each other overlap, touch or leave a pause."""
    if abs(gap_s := spacing_s - duration_s) < 1e-9:
        return "one right after the other"
    return f"{ms_text(abs(gap_s))} {'apart' if gap_s > 0 else 'overlap'}"


def with_motion_field(motion: Motion, name: str, value: Any) -> Motion:
    """Return ``motion`` with another value of a field.

    Raises
    ------
    InvalidInputError
        The value is not allowed, alone or with the other fields.
    """
    model: Any = motion
    return replace(model, **{name: value})


def with_path_of(motion: Motion, other: Motion) -> Motion:
    """Return ``motion`` with the path, amplitude and onset of ``other``.

    Parts of the path that the motion does not allow are left out: a sweep does not stay at a
    place, and a phantom lies between the first two different places.
    """
    source: Any = other
    model: Any = motion
    model = replace(model, amplitude=source.amplitude, onset_s=source.onset_s)
    moving = tuple(place for place, _ in groupby(other.path))
    for path in (other.path, moving, tuple(dict.fromkeys(moving))[:2]):
        with suppress(InvalidInputError):
            return replace(model, path=path)
    return model


def path_of(text: str) -> tuple[int, ...]:
    """Read a path from a text such as "16, 18, 20", "16 18 20" or "16-18-20".

    Raises
    ------
    InvalidInputError
        A part of the text is not the number of a place.
    """
    parts = re.findall(r"[^\s,;→-]+", text)
    for part in parts:
        if not re.fullmatch(r"[0-9]{1,3}", part):
            raise InvalidInputError(
                f"the path has {quoted(part)}, expected numbers of places, as in 16, 18, 20"
            )
    return tuple(map(int, parts))


ROUNDS = NumberSpec(
    label="Rounds", minimum=1, maximum=200, whole=True, hint="Number of passes along the path"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternation(fields.CheckedModel):
    """Bursts at each place of a path in turn, for a number of rounds.

    Burst k, counted from 0 through all rounds, starts k times the spacing after the first.

    Attributes
    ----------
    path
        Input places, in their order; two of them alternate.
    waveform
        The burst.
    spacing_s
        Time from the start of one burst to the start of the next.
    rounds
        Number of passes along the path.
    amplitude
        Amplitude of each track.
    onset_s
        When the first burst starts.
    """

    title: ClassVar[str] = "Alternation"
    law: ClassVar[str] = "Burst k starts k × spacing after the first, at the next place in turn."
    source: ClassVar[str] = "Timing only; it follows no law of perception."
    limits: ClassVar[str] = (
        "Slow alternation is felt at two places; near the timing of apparent motion it is felt as "
        "one point that moves to and fro. On the palm, vibration also reaches the other place: the "
        "skin map shows how much the levels differ."
    )

    path: tuple[int, ...] = fields.field(PATH, (7, 9))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.1))
    spacing_s: float = fields.number(0.2, SPACING)
    rounds: int = fields.number(4, ROUNDS)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    @property
    def summary(self) -> str:
        """Describe the times in a phrase."""
        n, burst_s = self.rounds * len(self.path), self.waveform.duration_s
        whole_s = (n - 1) * self.spacing_s + burst_s
        return (
            f"{counted(n, 'burst')} of {ms_text(burst_s)}, {_gap_text(self.spacing_s, burst_s)}; "
            f"{ms_text(whole_s)} in all"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        return _evenly_spaced_tracks(self, self.path * self.rounds)


#: Stimulus onset asynchrony: its share of the duration of a burst, and the constant added to it.
SOA_PER_DURATION, SOA_OFFSET_S = 0.32, 0.0473


@dataclass(frozen=True, slots=True, kw_only=True)
class ApparentMotion(fields.CheckedModel):
    """Bursts at one place after the other that are felt as one smooth movement.

    Each burst starts 0.32 d + 47.3 ms after the one before; d is the duration of a burst.

    Attributes
    ----------
    path
        Input places, in their order.
    waveform
        The burst; its duration is d.
    amplitude
        Amplitude of each track.
    onset_s
        When the first burst starts.
    """

    title: ClassVar[str] = "Apparent motion"
    law: ClassVar[str] = "Stimulus onset asynchrony: 0.32 d + 47.3 ms, d the duration of a burst."
    source: ClassVar[str] = (
        "Israr and Poupyrev, Tactile Brush: drawing on skin with a tactile grid display, CHI 2011."
    )
    limits: ClassVar[str] = (
        "Found on the back, with actuators some centimetres apart. On the palm places lie closer, "
        "and vibration runs on through the skin; strokes were felt to move more evenly there with "
        "steps between the places (Park et al., EuroHaptics 2016)."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.1))
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    @property
    def spacing_s(self) -> float:
        """Time from the start of one burst to the start of the next."""
        return SOA_PER_DURATION * self.waveform.duration_s + SOA_OFFSET_S

    @property
    def summary(self) -> str:
        """Describe the times in a phrase."""
        burst_s = self.waveform.duration_s
        whole_s = (len(self.path) - 1) * self.spacing_s + burst_s
        return (
            f"{len(self.path)} bursts of {ms_text(burst_s)}, one every "
            f"{ms_text(self.spacing_s)}, {_gap_text(self.spacing_s, burst_s)}; "
            f"{ms_text(whole_s)} in all"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        return _evenly_spaced_tracks(self, self.path)


TWO_PLACES = replace(PATH, most=2, different=True, label="Places", hint="The two places")
POSITION = NumberSpec(
    label="Position",
    minimum=0.0,
    maximum=1.0,
    step=0.01,
    hint="β: 0 is at the first place, 1 at the second",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Phantom(fields.CheckedModel):
    """The same waveform at two places, felt as one between them.

    At the position β from the first place (0) to the second (1), the first plays with sqrt(1 - β)
    and the second with sqrt(β) of the amplitude, so that the sum of their energies stays constant.

    Attributes
    ----------
    path
        Two input places.
    waveform
        What both play.
    position
        β, 0 to 1.
    amplitude
        Amplitude of the single actuator that would feel the same.
    onset_s
        When both start.
    """

    title: ClassVar[str] = "Phantom"
    law: ClassVar[str] = "Amplitudes √(1-β) and √β at once: their summed energy stays."
    source: ClassVar[str] = (
        "Israr and Poupyrev, Tactile Brush, CHI 2011; first Alles, Information transmission by "
        "phantom sensations, IEEE Trans. Man-Machine Systems 11, 1970."
    )
    limits: ClassVar[str] = (
        "Each alone must feel equally strong: places differ, and the scaling decides what "
        "amplitudes mean. On the hand the two also meet in the skin, where they add with their "
        "phases; more than a few centimetres apart they are felt as two."
    )

    path: tuple[int, ...] = fields.field(TWO_PLACES, (17, 19))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.3))
    position: float = fields.number(0.5, POSITION)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    @property
    def shares(self) -> tuple[float, float]:
        """Shares of the amplitude: sqrt(1 - β) and sqrt(β)."""
        return sqrt(1.0 - self.position), sqrt(self.position)

    @property
    def summary(self) -> str:
        """Describe the amplitudes in a phrase."""
        first, second = self.shares
        return (
            f"{first:.3g} and {second:.3g} of the amplitude at once, for "
            f"{ms_text(self.waveform.duration_s)}"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each of the two places, also for a silent one."""
        # Shares are amplitudes of tracks, which count under every scaling; gains of clips do not.
        tracks = tracks_of(self, self.path, ({}, {}))
        return tuple(
            replace(track, amplitude=share * self.amplitude)
            for track, share in zip(tracks, self.shares, strict=True)
        )


OVERLAP = replace(
    POSITION,
    label="Overlap",
    step=0.05,
    hint="Share of each step in which both places play; 0: none",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """One waveform that moves along a path while it plays.

    Each leg of the path takes the same time.  In the middle of a leg, during the overlap, the
    place behind fades out with cos(pi u / 2) and the place ahead fades in with sin(pi u / 2),
    where u goes evenly from 0 to 1: the phantom's √(1-β) and √β with β = sin²(pi u / 2).  The sum
    of the energies stays constant, and the waveform goes on without a break.

    Attributes
    ----------
    path
        Input places, in their order; a place cannot follow itself.
    waveform
        What moves; its duration is that of the whole sweep.
    overlap
        Share of each leg during which both places play, 0 to 1.
    amplitude
        Amplitude of each track.
    onset_s
        When it starts.
    """

    title: ClassVar[str] = "Sweep"
    law: ClassVar[str] = (
        "Neighbours crossfade by cosine and sine, at constant energy; steps take equal time."
    )
    source: ClassVar[str] = (
        "Energy of phantom sensations: Israr and Poupyrev, Tactile Brush, CHI 2011; equal steps "
        "are this studio's choice."
    )
    limits: ClassVar[str] = (
        "Steps of different length have different speeds. On the palm the waves of both places "
        "meet in the skin and add with their phases, not their energies; differences in "
        "sensitivity make the intensity vary."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Waveform = fields.field(WAVEFORM, Tone(200.0, duration_s=0.6))
    overlap: float = fields.number(1.0, OVERLAP)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    def __post_init__(self) -> None:
        fields.check(self)
        for place, next_place in pairwise(self.path):
            if place == next_place:
                raise InvalidInputError(
                    f"Sweep.path goes from place {place} to {next_place}, expected another place; "
                    "leave one of them out"
                )

    @property
    def leg_s(self) -> float:
        """Time from one place to the next."""
        return self.waveform.duration_s / (len(self.path) - 1)

    @property
    def summary(self) -> str:
        """Describe the times in a phrase."""
        return (
            f"{len(self.path)} places in {ms_text(self.waveform.duration_s)}, "
            f"{ms_text(self.leg_s)} from one to the next (overlap "
            f"{ms_text(self.overlap * self.leg_s)})"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        return tracks_of(self, self.path, map(self._clip, range(len(self.path))))

    def _clip(self, k: int) -> dict[str, Any]:
        n = len(self.path)
        cross_s = self.overlap * self.leg_s
        begin_s = 0.0 if k == 0 else (k - 0.5) * self.leg_s - cross_s / 2
        end_s = self.waveform.duration_s if k == n - 1 else (k + 0.5) * self.leg_s + cross_s / 2
        trim = Trim(start_s=begin_s, duration_s=end_s - begin_s)
        in_s, out_s = cross_s if k > 0 else 0.0, cross_s if k < n - 1 else 0.0
        fade = Fade(in_s=in_s, out_s=out_s, shape="equal power")
        return {"onset_s": self.onset_s + begin_s, "effects": (trim, fade)}


TAPS = replace(ROUNDS, label="Taps", hint="Number of taps at each place")


@dataclass(frozen=True, slots=True, kw_only=True)
class TapSequence(fields.CheckedModel):
    """The same number of taps at each place of a path, evenly spaced throughout.

    Tap k, counted from 0 through all places, starts k times the spacing after the first.

    Attributes
    ----------
    path
        Input places, in their order.
    waveform
        The tap.
    taps
        Number of taps at each place.
    spacing_s
        Time from the start of one tap to the start of the next, also from place to place.
    amplitude
        Amplitude of each track.
    onset_s
        When the first tap starts.
    """

    title: ClassVar[str] = "Tap sequence"
    law: ClassVar[str] = "Tap k starts k × spacing after the first, the same number at each place."
    source: ClassVar[str] = (
        "Geldard and Sherrick, The cutaneous “rabbit”: a perceptual illusion, Science 178, 1972; "
        "range of times: Geldard, J. Invest. Dermatology 69, 1977."
    )
    limits: ClassVar[str] = (
        "Sensory saltation: from 20 to 260 ms apart, taps are felt between the places, as if they "
        "hopped along; slower ones stay where they are. Found on the arm: where the skin resolves "
        "places well, as on the palm and most of all at the fingertips, hops are short."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Waveform = fields.field(WAVEFORM, Tap())
    taps: int = fields.number(3, TAPS)
    spacing_s: float = fields.number(0.06, SPACING)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    @property
    def summary(self) -> str:
        """Describe the times in a phrase."""
        n = self.taps * len(self.path)
        whole_s = (n - 1) * self.spacing_s + self.waveform.duration_s
        return (
            f"{counted(n, 'tap')}, one every {ms_text(self.spacing_s)}; {ms_text(whole_s)} in all"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        places = [place for place in self.path for _ in range(self.taps)]
        return _evenly_spaced_tracks(self, places)


#: Waveforms that have one frequency and a phase.
_PERIODIC = (Tone, Square, Saw, Triangle)

PERIODIC = ModelSpec(
    label="Waveform", kinds=lambda: _PERIODIC, hint="What plays at all places, with its phase"
)
DISTANCE = NumberSpec(
    label="Distance",
    unit="m",
    minimum=0.0001,
    maximum=1.0,
    step=0.001,
    hint="Distance from one place to the next, taken as equal",
)
SPEED = NumberSpec(
    label="Speed",
    unit="m/s",
    minimum=0.01,
    maximum=1000.0,
    step=0.05,
    logarithmic=True,
    hint="How fast the phase runs along the path",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TravellingPhase(fields.CheckedModel):
    """The same steady tone at all places at once, with a phase that lags from place to place.

    At place k it starts with the phase of the waveform minus 2 pi frequency k distance / speed,
    the phase of a wave that passes the places in their order at this speed.

    Attributes
    ----------
    path
        Input places, in their order.
    waveform
        A tone, square, saw or triangle wave.
    distance_m
        Distance from one place to the next.
    speed_m_s
        Speed of the wave.
    amplitude
        Amplitude of each track.
    onset_s
        When all of them start.
    """

    title: ClassVar[str] = "Travelling phase"
    law: ClassVar[str] = "At place k the phase lags by 2π × frequency × k × distance / speed."
    source: ClassVar[str] = "Phase of a plane wave; the phased array of acoustics."
    limits: ClassVar[str] = (
        "The skin adds its own waves, of 5 to 20 m/s and fading within centimetres, to the phases "
        "of the actuators; whether a direction is felt on the palm is unknown. Animate the skin to "
        "see how the waves run."
    )

    path: tuple[int, ...] = fields.field(PATH, (16, 18, 20))
    waveform: Tone | Square | Saw | Triangle = fields.field(PERIODIC, Tone(100.0, duration_s=0.5))
    distance_m: float = fields.number(0.02, DISTANCE)
    speed_m_s: float = fields.number(5.0, SPEED)
    amplitude: float = fields.number(1.0, LEVEL)
    onset_s: float = fields.number(0.0, START)

    @property
    def lag_turns(self) -> float:
        """Lag from one place to the next, in turns."""
        return self.waveform.frequency_hz * self.distance_m / self.speed_m_s

    @property
    def summary(self) -> str:
        """Describe the times in a phrase."""
        return (
            f"{len(self.path)} places at once for {ms_text(self.waveform.duration_s)}, each "
            f"{degrees(2 * pi * self.lag_turns):.4g}° behind the one before"
        )

    def tracks(self) -> tuple[Input, ...]:
        """Return a track for each place."""
        phases_rad = map(self._phase_rad, range(len(self.path)))
        waveforms = (replace(self.waveform, phase_rad=phase_rad) for phase_rad in phases_rad)
        return tracks_of(self, self.path, ({"waveform": waveform} for waveform in waveforms))

    def _phase_rad(self, k: int) -> float:
        if k == 0:
            return self.waveform.phase_rad
        lag = 2.0 * pi * remainder(k * self.lag_turns, 1.0)
        return remainder(self.waveform.phase_rad - lag, 2.0 * pi)


#: Every kind of motion, in the order in which a user sees them.
MOTIONS: tuple[type[Motion], ...] = (
    Sweep,
    ApparentMotion,
    Alternation,
    TapSequence,
    TravellingPhase,
    Phantom,
)
