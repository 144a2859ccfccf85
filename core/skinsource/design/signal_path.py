"""What a voice plays, written down."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.catalog import load, names
from skinsource.actuators.equalising import (
    PolePairReplacement,
    RegularisedInverse,
    followed_band,
    net_velocity,
)
from skinsource.actuators.rigs import Rig
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.published import Band
from skinsource.base.quoting import first_sentence
from skinsource.design.clips import Clip
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.playing import placed, played
from skinsource.design.waveform import Waveform

Curve = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Part:
    """A waveform through its effects, somewhere in a chain.

    Attributes
    ----------
    waveform, effects
        What is played.
    start
        Sample of the chain at which its samples begin.
    shift_s
        How much later it starts itself: less than a sample.
    gain
        Factor.
    """

    waveform: Waveform
    effects: tuple[Effect, ...] = ()
    start: int = 0
    shift_s: float = 0.0
    gain: float = 1.0

    @property
    def title(self) -> str:
        """Word for what is played."""
        return self.waveform.title


@dataclass(frozen=True, slots=True)
class Chain:
    """The way from recipes to a drive: a sum of parts, times a curve.

    Equal chains play the same at one sample rate.

    Attributes
    ----------
    parts
        What sounds; the first sample of the earliest is sample 0.
    curve
        Breakpoints, s and factor, that all of it is multiplied with; none: nothing is.
    curve_start
        Sample of the curve's time at which the chain begins; 0 without a curve.
    """

    parts: tuple[Part, ...]
    curve: Curve = ()
    curve_start: int = 0
    # Looked up several times for each edit, and as long to compute as there are parts.
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_hash", hash((self.parts, self.curve, self.curve_start)))

    def __hash__(self) -> int:
        return self._hash

    @property
    def title(self) -> str:
        """Words for what is played."""
        return self.parts[0].title if len(self.parts) == 1 else f"{len(self.parts)} clips"


# Sampled drives, far from over- and underflow.

#: Largest sample of a drive or a response.  Far beyond it levels overflow, and NaN would come out.
LARGEST = 1e30


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class Drive:
    """What a voice plays, scaled by a power of two so that its peak lies between 1 and 2.

    Attributes
    ----------
    samples : (n_times,)
        Scaled samples.
    factor
        The power of two that was divided out; nothing rounds.
    """

    samples: Floats
    factor: float

    @property
    def silent(self) -> bool:
        """Whether it holds nothing but zeros."""
        return self.factor == 0.0


def drive_played(
    signal_path: Chain, sample_rate_hz: float, place: int, drawn: Callable[[Part], Floats]
) -> Drive:
    """Sum up what ``chain`` plays; its length is that of the samples.

    Parameters
    ----------
    drawn
        What each part plays before its gain, (n_times,).

    Raises
    ------
    InvalidInputError
        A part cannot be sampled, or a sample is not a usable number; the message names the place.
    """
    try:
        pieces = [drawn(part) for part in signal_path.parts]
    except InvalidInputError as error:
        raise InvalidInputError(f"Input at place {place}, {signal_path.title}: {error}") from error
    for part, piece in zip(signal_path.parts, pieces, strict=True):
        _check(piece, part.title, place)
    samples = _mixed(signal_path, sample_rate_hz, pieces)
    if len(pieces) != 1 or samples is not pieces[0]:
        _check(samples, signal_path.title, place)
    return drive_of(samples)


def _mixed(signal_path: Chain, sample_rate_hz: float, pieces: list[Floats]) -> Floats:
    """Sum of the pieces of a chain, times their gains and the curve, (n_times,)."""
    if len(pieces) == 1 and signal_path.parts[0].gain == 1.0 and not signal_path.curve:
        return pieces[0]
    placed = list(zip(signal_path.parts, pieces, strict=True))
    total = np.zeros(max((part.start + piece.size for part, piece in placed), default=0))
    for part, piece in placed:
        total[part.start : part.start + piece.size] += part.gain * piece
    if signal_path.curve:
        time_s, factor = np.array(signal_path.curve).T
        own_s = (
            np.arange(signal_path.curve_start, signal_path.curve_start + total.size)
            / sample_rate_hz
        )
        total *= np.interp(own_s, time_s, factor)
    return total


def _check(samples: Floats, title: str, place: int) -> None:
    bad = first_unusable(samples)
    if bad is not None:
        raise InvalidInputError(
            f"Input at place {place}, {title}: sample {bad[0]} is {samples[bad]}, expected a "
            f"finite number of at most {LARGEST:g}. Correct what the input plays, or mute it."
        )


def drive_of(samples: Floats) -> Drive:
    """Scale ``samples`` by a power of two; all computing is then far from over- and underflow."""
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0.0:
        return Drive(samples, 0.0)
    exponent = math.frexp(peak)[1] - 1
    return Drive(np.ldexp(samples, -exponent), math.ldexp(1.0, exponent))


def first_unusable(samples: Floats) -> tuple[int, ...] | None:
    """Index of the first sample that is not finite or beyond `LARGEST`; None if all are sound."""
    # NaN is the maximum of whatever holds it, and not less than anything.
    if samples.size == 0 or np.abs(samples).max() <= LARGEST:
        return None
    return tuple(int(index) for index in np.argwhere(~(np.abs(samples) <= LARGEST))[0])


# Drives that an actuator can follow.


def check_drive(
    actuation: Actuation | None,
    drive: Drive,
    sample_rate_hz: float,
    band_hz: Band | None,
    place: int,
) -> None:
    """Refuse a drive that the equaliser refuses: one that leaves what it moves in motion.

    Rate and band are those of the limb, None where its band is not known.

    Raises
    ------
    InvalidInputError
        It leaves a velocity; the message names the input place, and says what to do.
    """
    if actuation is None or actuation.equaliser is None:
        return
    lowest_hz = followed_band(band_hz, sample_rate_hz)[0]
    net = net_velocity(drive.samples, sample_rate_hz, lowest_hz)
    if not net.returns:
        raise InvalidInputError(
            f"Input at place {place} cannot be played through this actuator: it leaves a velocity, "
            f"and {100.0 * net.share_below_band:.0f} % of its energy lies below {lowest_hz:g} "
            "Hz. Choose a waveform whose velocity returns to zero, for a tap the 'Centred tap', or "
            "let it fade in and out."
        )


# What a rig predicts through.


def actuation_of_rig(
    rig: Rig, equaliser: RegularisedInverse | PolePairReplacement | None = None
) -> Actuation:
    """Return the actuators of a rig, as they were measured, else as their models say.

    Channels of which it is not known how they move are left out: nothing is predicted there.

    Raises
    ------
    InvalidInputError
        It is not known of any.
    """
    actuators = []
    for channel in rig.channels:
        listed = load(channel.actuator) if channel.actuator in names() else None
        model = channel.moves_as if channel.moves_as is not None else listed
        if model is not None:
            actuators.append(
                ActuatorAt(place=channel.place, actuator=channel.actuator, model=model)
            )
    if not actuators:
        raise InvalidInputError(
            "The rig does not say how any of its actuators moves. Measure one, or name one that "
            "the library lists."
        )
    return Actuation(actuators=tuple(actuators), equaliser=equaliser, rig=rig.title or "rig")


# From clips on a track to a chain, the sample at which it starts, and what it plays.


def placed_chain(
    clips: Iterable[Clip], gain_curve: Curve, sample_rate_hz: float
) -> tuple[int, Chain]:
    """Sample at which the first clip that sounds begins, and all of them from there on.

    The order in which they are listed plays no part.
    """
    entries = []
    for clip in clips:
        if not clip.muted:
            first_sample, shift_s = placed(
                clip.waveform, clip.effects, clip.onset_s, sample_rate_hz
            )
            entries.append((first_sample, shift_s, clip.gain, clip))
    _put_in_order(entries)
    first = entries[0][0] if entries else 0
    parts = tuple(
        Part(
            clip.waveform,
            tuple(effect for effect in clip.effects if effect.on),
            first_sample - first,
            *rest,
        )
        for first_sample, *rest, clip in entries
    )
    return first, Chain(parts, gain_curve, first if gain_curve else 0)


def drive_of_clips(
    clips: Iterable[Clip], gain_curve: Curve, sample_rate_hz: float, place: int
) -> tuple[int, Drive]:
    """Sample at which the first clip that sounds begins, and what all play from there on.

    Raises
    ------
    InvalidInputError
        See `drive_played`, which names ``place``.
    """
    first, signal_path = placed_chain(clips, gain_curve, sample_rate_hz)

    def drawn(part: Part) -> Floats:
        return played(part.waveform, part.effects, sample_rate_hz, part.shift_s)

    return first, drive_played(signal_path, sample_rate_hz, place, drawn)


def _put_in_order(entries: list[tuple[int, float, float, Clip]]) -> None:
    """Sort by place and gain; what is alike in both by what it plays, in words.

    Sums of three numbers depend on their order in the last digit.
    """
    entries.sort(key=_where)
    n_equal = len(entries) - len(set(map(_where, entries)))
    if n_equal:
        entries.sort(key=lambda entry: (*_where(entry), repr(entry[3])))


def _where(entry: tuple[int, float, float, Clip]) -> tuple[int, float, float]:
    return entry[:3]


# What sounds: all that the engine knows of a design's inputs.


@dataclass(frozen=True, slots=True, kw_only=True)
class Voice:
    """Something that plays at an input place.

    Attributes
    ----------
    id
        Tells voices apart.
    location
        Input place, 1, 2, 3, …
    start
        Sample at which it starts.
    amplitude
        Factor; what 1 means is a matter of scaling.
    heard
        Whether it takes part: neither muted nor beside a solo one.
    chain
        What it plays.
    """

    id: int
    location: int
    start: int
    amplitude: float
    heard: bool
    chain: Chain

    @property
    def unit(self) -> "UnitVoice":
        """The same without amplitude and start."""
        return UnitVoice(self.chain, self.location)


@dataclass(frozen=True, slots=True)
class UnitVoice:
    """A voice at amplitude 1 and start 0: what it plays, and where."""

    chain: Chain
    location: int


@dataclass(frozen=True, slots=True)
class UnplayableInput:
    """An input that is heard and cannot be played.

    Attributes
    ----------
    id
        Tells inputs apart.
    problem
        Why, and what to do, as the error says it.
    """

    id: int
    problem: str

    @property
    def sentence(self) -> str:
        """Which input, and why."""
        return first_sentence(self.problem)


def unplayable_text(unplayable: Sequence[UnplayableInput]) -> str:
    """One sentence on inputs that cannot be played; empty where there are none."""
    if not unplayable:
        return ""
    text, more = unplayable[0].sentence, len(unplayable) - 1
    if more == 0:
        return text
    others = "1 more input" if more == 1 else f"{more} more inputs"
    return f"{text.removesuffix('.')}; {others} cannot be played either."
