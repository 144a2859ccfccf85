"""The signal path from the clips of a track to a drive that is sampled.

`placed_signal_path` describes what the clips of a track play as a `Chain` of parts; `drive_played`
samples it as a `Drive`.  A `Voice` is a signal path at an input place, with its start and
amplitude: this is all that the engine knows of a design's inputs.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.actuators.equalising import (
    PolePairReplacement,
    RegularisedInverse,
    followed_band,
    net_velocity,
)
from skinsource.actuators.rigs import Rig, known_model
from skinsource.base.arguments import checking
from skinsource.base.conventions import Band, Floats
from skinsource.base.errors import InvalidInputError, counted, first_sentence
from skinsource.design.clips import Clip
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.playing import placed, played
from skinsource.design.waveform import Waveform

Curve = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Part:
    """A waveform through its effects, at a place in a signal path.

    Attributes
    ----------
    start
        Sample of the signal path at which its samples begin.
    shift_s
        Time from that sample to its own start: less than a sample.
    """

    waveform: Waveform
    effects: tuple[Effect, ...] = ()
    start: int = 0
    shift_s: float = 0.0
    gain: float = 1.0

    @property
    def title(self) -> str:
        """Title of the waveform."""
        return self.waveform.title


@dataclass(frozen=True, slots=True)
class SignalPath:
    """The way from waveforms to a drive: a sum of parts, times a gain curve.

    Equal signal paths give the same samples at one sample rate.

    Attributes
    ----------
    parts
        What is added up; the first sample of the earliest part is sample 0.
    curve
        Breakpoints, s and factor, by which the sum is multiplied; empty: it is not.
    curve_start
        Sample in the curve's time at which the signal path begins; 0 without a curve.
    """

    parts: tuple[Part, ...]
    curve: Curve = ()
    curve_start: int = 0
    # Stored, because each edit needs it several times and it takes long with many parts.
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_hash", hash((self.parts, self.curve, self.curve_start)))

    def __hash__(self) -> int:
        return self._hash

    @property
    def title(self) -> str:
        """Title of its waveform, or the number of its clips."""
        return self.parts[0].title if len(self.parts) == 1 else f"{len(self.parts)} clips"


#: Largest sample of a drive or a response; far larger ones would make levels overflow to NaN.
LARGEST = 1e30


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class Drive:
    """Samples of a voice, scaled by a power of two to a peak between 1 and 2.

    Attributes
    ----------
    samples : (n_times,)
        Scaled samples.
    factor
        The power of two by which they were divided, exactly.
    """

    samples: Floats
    factor: float

    @property
    def silent(self) -> bool:
        """Whether all samples are 0."""
        return self.factor == 0.0


def drive_played(
    signal_path: SignalPath, sample_rate_hz: float, place: int, drawn: Callable[[Part], Floats]
) -> Drive:
    """Add up the parts of a signal path, times its curve.

    Parameters
    ----------
    drawn
        Returns the samples of a part before its gain, (n_times,).

    Raises
    ------
    InvalidInputError
        A part cannot be sampled, or a sample is too large or not finite; the message names the
        input place.
    """
    try:
        pieces = [drawn(part) for part in signal_path.parts]
    except InvalidInputError as error:
        raise InvalidInputError(f"Input at place {place}, {signal_path.title}: {error}") from error
    for part, piece in zip(signal_path.parts, pieces, strict=True):
        _check_samples(piece, part.title, place)
    samples = _mixed(signal_path, sample_rate_hz, pieces)
    if len(pieces) != 1 or samples is not pieces[0]:
        _check_samples(samples, signal_path.title, place)
    return drive_of(samples)


def _mixed(signal_path: SignalPath, sample_rate_hz: float, pieces: list[Floats]) -> Floats:
    """Add up the samples of the parts, times their gains and the curve, (n_times,)."""
    if len(pieces) == 1 and signal_path.parts[0].gain == 1.0 and not signal_path.curve:
        return pieces[0]
    pairs = list(zip(signal_path.parts, pieces, strict=True))
    total = np.zeros(max((part.start + piece.size for part, piece in pairs), default=0))
    for part, piece in pairs:
        total[part.start : part.start + piece.size] += part.gain * piece
    if signal_path.curve:
        time_s, factor = np.array(signal_path.curve).T
        own_s = (
            np.arange(signal_path.curve_start, signal_path.curve_start + total.size)
            / sample_rate_hz
        )
        total *= np.interp(own_s, time_s, factor)
    return total


def _check_samples(samples: Floats, title: str, place: int) -> None:
    bad = first_unusable(samples)
    if bad is not None:
        raise InvalidInputError(
            f"Input at place {place}, {title}: sample {bad[0]} is {samples[bad]}, expected a "
            f"finite number of at most {LARGEST:g}. Correct what the input plays, or mute it."
        )


def drive_of(samples: Floats) -> Drive:
    """Scale ``samples`` by a power of two, so that later sums neither overflow nor underflow."""
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0.0:
        return Drive(samples, 0.0)
    exponent = math.frexp(peak)[1] - 1
    return Drive(np.ldexp(samples, -exponent), math.ldexp(1.0, exponent))


def first_unusable(samples: Floats) -> tuple[int, ...] | None:
    """Return the index of the first sample that is not finite or beyond `LARGEST`, if any."""
    # If a sample is NaN, so is the maximum, and the comparison is false.
    if samples.size == 0 or np.abs(samples).max() <= LARGEST:
        return None
    return tuple(int(index) for index in np.argwhere(~(np.abs(samples) <= LARGEST))[0])


def check_drive(
    actuation: Actuation | None,
    drive: Drive,
    sample_rate_hz: float,
    band_hz: Band | None,
    place: int,
) -> None:
    """Check that a drive through an equaliser leaves no velocity at its end.

    Rate and band are those of the limb; the band is None where it is not known.

    Raises
    ------
    InvalidInputError
        The drive leaves a velocity; the message names the input place and says what to do.
    """
    if actuation is None or actuation.equaliser is None:
        return
    lowest_hz = followed_band(band_hz, sample_rate_hz)[0]
    net = net_velocity(drive.samples, sample_rate_hz, lowest_hz)
    if not net.returns:
        raise InvalidInputError(
            f"Input at place {place} cannot be played through this actuator: it leaves a velocity, "
            f"and {100.0 * net.share_below_band:.0f} % of its energy lies below {lowest_hz:g} Hz. "
            "Choose a waveform whose velocity returns to zero, for a tap the 'Centred tap', or let "
            "it fade in and out."
        )


@checking
def actuation_of_rig(
    rig: Rig, equaliser: RegularisedInverse | PolePairReplacement | None = None
) -> Actuation:
    """Return the actuators of a rig, as they were measured, or else as their listed models.

    Channels whose movement is not known are left out: nothing is predicted there.

    Raises
    ------
    InvalidInputError
        The movement of no channel is known.

    Examples
    --------
    >>> import skinsource as ss
    >>> channel = ss.rigs.RigChannel(place=7, actuator=ss.actuators.names()[0])
    >>> print(ss.actuation_of_rig(ss.rigs.Rig(channels=[channel])).at(7).actuator)
    example-piezo
    """
    actuators = []
    for channel in rig.channels:
        model = known_model(channel)
        if model is not None:
            actuators.append(
                ActuatorAt(place=channel.place, actuator=channel.actuator, model=model)
            )
    if not actuators:
        raise InvalidInputError(
            "The rig has no response of its actuators. Measure one, or choose a listed actuator."
        )
    return Actuation(actuators=tuple(actuators), equaliser=equaliser, rig=rig.title or "rig")


def placed_signal_path(
    clips: Iterable[Clip], gain_curve: Curve, sample_rate_hz: float
) -> tuple[int, SignalPath]:
    """Return the sample at which the first audible clip begins, and the signal path from there on.

    The result does not depend on the order of the clips.
    """
    entries = []
    for clip in clips:
        if not clip.muted:
            first_sample, shift_s = placed(
                clip.waveform, clip.effects, clip.onset_s, sample_rate_hz
            )
            entries.append((first_sample, shift_s, clip.gain, clip))
    # The last digit of a sum depends on the order of its terms: clips that are equal in start,
    # shift and gain are sorted by their texts.
    entries.sort(key=_position)
    if len(set(map(_position, entries))) < len(entries):
        entries.sort(key=lambda entry: (*_position(entry), repr(entry[3])))
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
    return first, SignalPath(parts, gain_curve, first if gain_curve else 0)


def drive_of_clips(
    clips: Iterable[Clip], gain_curve: Curve, sample_rate_hz: float, place: int
) -> tuple[int, Drive]:
    """Return the sample at which the first audible clip begins, and the drive from there on.

    Raises
    ------
    InvalidInputError
        As for `drive_played`; the message names ``place``.
    """
    first, signal_path = placed_signal_path(clips, gain_curve, sample_rate_hz)

    def drawn(part: Part) -> Floats:
        return played(part.waveform, part.effects, sample_rate_hz, part.shift_s)

    return first, drive_played(signal_path, sample_rate_hz, place, drawn)


def _position(entry: tuple[int, float, float, Clip]) -> tuple[int, float, float]:
    return entry[:3]


@dataclass(frozen=True, slots=True, kw_only=True)
class Voice:
    """A signal path that plays at an input place.

    Attributes
    ----------
    location
        Input place, from 1.
    start
        Sample at which it starts.
    amplitude
        Factor; the scaling of the design says what 1 means.
    heard
        Whether it is audible: not muted, and solo if any input is solo.
    """

    id: int
    location: int
    start: int
    amplitude: float
    audible: bool
    signal_path: SignalPath

    @property
    def unit(self) -> "UnitVoice":
        """The same voice at amplitude 1 and start 0."""
        return UnitVoice(self.signal_path, self.location)


@dataclass(frozen=True, slots=True)
class UnitVoice:
    """A voice at amplitude 1 and start 0: a signal path and its input place."""

    signal_path: SignalPath
    location: int


@dataclass(frozen=True, slots=True)
class UnplayableInput:
    """An audible input that cannot be played.

    ``problem`` is the message of the error: why, and what to do.
    """

    id: int
    problem: str
    location: int

    @property
    def sentence(self) -> str:
        """First sentence of the problem: which input, and why."""
        return first_sentence(self.problem)


def unplayable_text(unplayable: Sequence[UnplayableInput]) -> str:
    """Return one sentence about inputs that cannot be played; empty if there are none."""
    if not unplayable:
        return ""
    text, more = unplayable[0].sentence, unplayable[1:]
    places = ", ".join(map(str, sorted({track.location for track in more})))
    others = f"; {counted(len(more), 'more input')} cannot be played either, at {places}."
    return f"{text.removesuffix('.')}{others}" if more else text
