"""The rig: which actuator is wired to which output, its calibration, and its limits.

A rig is a JSON file of its own, made by hand or from measurements; a design holds a copy of the
one that it is exported for.  A machine plays for its own rig: no design can loosen its limits.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import fields as dataclass_fields
from datetime import date
from math import inf
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators.actuation import LIMITS, MODEL, THERMAL, Model, load, names, profile_of
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.prediction import Breach, Limits, Thermal, breaches, limit_text, predicted
from skinsource.base.arguments import checking, finite_array, integer
from skinsource.base.conventions import MOST_LOCATIONS, Floats
from skinsource.base.errors import FileFormatError, InvalidInputError, quoted, sentence
from skinsource.base.files import path_text, read_bytes, write_bytes
from skinsource.base.json_text import MAX_TEXT_BYTES
from skinsource.signals.resampling import MAX_RATE_HZ
from skinsource.specs import fields, models
from skinsource.specs.codec import from_plain_text, to_plain_text
from skinsource.specs.numbers import SMALLEST, ListSpec, ModelSpec, NumberSpec, OptionalSpec
from skinsource.specs.spec import Address, ChoiceSpec, TextSpec

__all__ = [
    "SUFFIX",
    "Margin",
    "Rig",
    "RigBreach",
    "RigChannel",
    "calibration_words",
    "highest_gain",
    "open_rig",
    "rig_breaches",
    "samples_for",
    "save_rig",
    "strictest",
    "volts_of",
]


PLACE = NumberSpec(label="Place", minimum=1, maximum=MOST_LOCATIONS, whole=True)
NAME = TextSpec(label="Actuator", longest=100, one_line=True)
DEVICE = TextSpec(label="Device", longest=200, one_line=True, hint="Name of the sound card")
OUTPUT = NumberSpec(label="Output", minimum=1, maximum=1024, whole=True, hint="Of the device")
FULL_SCALE = OptionalSpec(
    label="Full scale",
    of=NumberSpec(label="Full scale", unit="V", minimum=SMALLEST, maximum=1e6),
    hint="Volts at the device output for a sample of 1",
)
GAIN = NumberSpec(label="Amplifier gain", minimum=SMALLEST, maximum=1e6, hint="Volts per volt")
POLARITY = ChoiceSpec(
    label="Polarity",
    options=(("normal", "Normal"), ("inverted", "Inverted")),
    hint="Inverted: a positive voltage pulls away from the skin",
)
DELAY = NumberSpec(label="Delay", unit="s", minimum=0.0, maximum=10.0, hint="From sample to motion")
DATE = TextSpec(label="Measured on", longest=10, one_line=True, hint="Year-month-day, or empty")


@dataclass(frozen=True, slots=True, kw_only=True)
class RigChannel:
    """A place of the skin, its actuator, and the output that drives it.

    Attributes
    ----------
    place
        Input place, from 1; the limb says which it has.
    actuator
        What it is called: a name of `skinsource.actuators.names`, or words for another.
    model
        How it moves; None: not known.
    device, output
        Sound card, and number of its output, from 1.
    full_scale_v
        Voltage at that output where a sample is 1; None: not known.
    amplifier_gain
        Volts at the actuator for each volt of the output.
    measured
        Measured acceleration on the skin per volt at the actuator; None: not measured.
    polarity
        ``"normal"``, or ``"inverted"`` where a positive voltage moves it the other way.
    delay_s
        From the sample to the motion.
    measured_on
        Date, ``"2026-11-22"``; empty where nothing was measured.
    limits, thermal
        What must not be passed, at the actuator; how it warms.
    """

    place: int = fields.field(PLACE)
    actuator: str = fields.text("", NAME)
    model: Model | None = fields.field(OptionalSpec(label="Model", of=MODEL), None)
    device: str = fields.text("", DEVICE)
    output: int = fields.number(1, OUTPUT)
    full_scale_v: float | None = fields.field(FULL_SCALE, None)
    amplifier_gain: float = fields.number(1.0, GAIN)
    measured: MeasuredResponse | None = fields.field(
        OptionalSpec(
            label="Measured response",
            of=ModelSpec(label="Measured response", kinds=lambda: (MeasuredResponse,)),
        ),
        None,
    )
    polarity: str = fields.choice("normal", POLARITY)
    delay_s: float = fields.number(0.0, DELAY)
    measured_on: str = fields.text("", DATE)
    limits: Limits = fields.field(LIMITS, factory=Limits)
    thermal: Thermal | None = fields.field(THERMAL, None)

    def __post_init__(self) -> None:
        fields.check(self)
        if self.measured_on:
            try:
                date.fromisoformat(self.measured_on)
            except ValueError:
                raise InvalidInputError(
                    f"RigChannel.measured_on is {quoted(self.measured_on)}, expected a date such "
                    "as 2026-11-22, or nothing"
                ) from None

    @property
    def calibrated(self) -> bool:
        """Whether m/s² on the skin follow from samples: volts and response are both known."""
        return self.full_scale_v is not None and self.measured is not None

    @property
    def moves_as(self) -> Model | None:
        """Measured response, else the model."""
        return self.measured if self.measured is not None else self.model

    @property
    def volts_at_full_scale(self) -> float | None:
        """Voltage at the actuator where a sample is 1, with its sign; None where not known."""
        if self.full_scale_v is None:
            return None
        sign = -1.0 if self.polarity == "inverted" else 1.0
        return sign * self.full_scale_v * self.amplifier_gain


MAX_CHANNELS = 256
TITLE = TextSpec(label="Title", longest=100, one_line=True)
NOTE = TextSpec(label="Note", longest=5000)
CHANNELS = ListSpec(
    label="Channels",
    of=ModelSpec(label="Channel", kinds=lambda: (RigChannel,)),
    most=MAX_CHANNELS,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rig:
    """Actuators of a lab, their wiring, and their limits.

    Attributes
    ----------
    title, note
        Words for it.
    channels
        No place and no output of a device twice.
    """

    title: str = fields.text("", TITLE)
    note: str = fields.text("", NOTE)
    channels: tuple[RigChannel, ...] = fields.field(CHANNELS, ())

    def __post_init__(self) -> None:
        fields.check(self)
        named = Counter(
            name
            for channel in self.channels
            for name in (
                f"place {channel.place}",
                f"output {channel.output} of device {quoted(channel.device)}",
            )
        )
        for name, count in named.items():
            if count > 1:
                raise InvalidInputError(
                    f"Rig.channels has {name} {count} times, expected once; wire each place to its "
                    "own output"
                )

    def channel_of(self, place: int) -> RigChannel | None:
        """Return the channel of an input place; None where nothing is wired to it."""
        return next((channel for channel in self.channels if channel.place == place), None)


def known_model(channel: RigChannel) -> Model | None:
    """Return how an actuator moves: as measured, by its model, or by that of its name."""
    if channel.moves_as is None and channel.actuator in names():
        return load(channel.actuator)
    return channel.moves_as


def wired_channel(rig: Rig, place: int | None) -> RigChannel:
    """Return the channel of an input place; raise where nothing is wired to it."""
    channel = None if place is None else rig.channel_of(place)
    if channel is None:
        raise InvalidInputError(
            f"Place {place} is not wired in the rig {quoted(rig.title)}; add a channel for it"
        )
    return channel


@checking
def calibration_words(rig: Rig | None, places: Sequence[int]) -> str:
    """Return the text on the calibration of these places for exports and the player.

    ``"calibrated"``, where volts and measured responses of all of them are known, with the date of
    the oldest measurement where it is; else what is missing, beginning with ``"uncalibrated"``.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.rigs.calibration_words(None, [7]))
    uncalibrated: no rig says how many volts, and how many m/s², a sample of 1 is
    """
    if rig is None:
        return "uncalibrated: no rig says how many volts, and how many m/s², a sample of 1 is"
    missing = []
    for place in places:
        channel = rig.channel_of(place)
        if channel is None:
            missing.append(f"place {place} is not wired")
        elif channel.full_scale_v is None:
            missing.append(f"place {place} has no volts at full scale")
        elif channel.measured is None:
            missing.append(f"place {place} has no measured response")
    if missing:
        return f"uncalibrated: {', '.join(missing)}"
    dates = [channel.measured_on for place in places if (channel := rig.channel_of(place))]
    known = [day for day in dates if day]
    return f"calibrated, measured on {min(known)}" if known else "calibrated"


@checking
def volts_of(channel: RigChannel, samples: ArrayLike) -> Floats:
    """Return volts at the actuator for samples from -1 to 1, shaped as ``samples``.

    Raises
    ------
    InvalidInputError
        The channel does not say its volts at full scale.

    Examples
    --------
    >>> import skinsource as ss
    >>> channel = ss.rigs.RigChannel(place=7, full_scale_v=2.0, amplifier_gain=5.0)
    >>> print(ss.rigs.volts_of(channel, [0.5]))
    [5.]
    """
    return finite_array("samples", samples) * full_scale_volts(channel)


@checking
def samples_for(channel: RigChannel, volts: ArrayLike) -> Floats:
    """Return samples that give these volts at the actuator, shaped as ``volts``.

    Raises
    ------
    InvalidInputError
        The channel does not say its volts at full scale, or they do not suffice.

    Examples
    --------
    >>> import skinsource as ss
    >>> channel = ss.rigs.RigChannel(place=7, full_scale_v=2.0, amplifier_gain=5.0)
    >>> print(ss.rigs.samples_for(channel, [5.0]))
    [0.5]
    """
    needed_v = finite_array("volts", volts)
    full = full_scale_volts(channel)
    peak = float(np.abs(needed_v).max(initial=0.0))
    if peak > abs(full):
        raise InvalidInputError(
            f"place {channel.place}: {peak:.4g} V are needed, and output {channel.output} gives at "
            f"most {abs(full):.4g} V; lower the amplitude, or raise the gain of the amplifier"
        )
    return needed_v / full


def full_scale_volts(channel: RigChannel) -> float:
    """Return volts at the actuator where a sample is 1; raise where they are not known."""
    full = channel.volts_at_full_scale
    if full is None:
        raise InvalidInputError(
            f"place {channel.place}: the rig does not say the volts at full scale; measure them "
            "with a tone at full scale and a voltmeter"
        )
    return full


#: Limits that depend neither on volts nor on the gain.
_TIME_LIMITS = frozenset({"duration_s", "duty"})
# Where nothing is known of the motion, limits of the voltage can be checked all the same.
_UNIT_RESPONSE = MeasuredResponse(((1.0, 1.0, 0.0), (1000.0, 1.0, 0.0)))


@dataclass(frozen=True, slots=True)
class RigBreach:
    """A limit of a rig that would be passed.

    Attributes
    ----------
    place
        Input place of the channel.
    breach
        Which limit, and by how much.
    """

    place: int
    breach: Breach

    def __str__(self) -> str:
        return f"place {self.place}: {self.breach}"


@checking
def strictest(*several: Limits) -> Limits:
    """Return for each limit the least of those that are known.

    Examples
    --------
    >>> import skinsource as ss
    >>> first, second = (ss.actuators.Limits(peak_voltage_v=volts) for volts in (2.0, 1.0))
    >>> print(ss.rigs.strictest(first, second).peak_voltage_v)
    1.0
    """
    least = {}
    for limit in dataclass_fields(Limits):
        known = [value for limits in several if (value := getattr(limits, limit.name)) is not None]
        least[limit.name] = min(known, default=None)
    return Limits(**least)


def limits_of(channel: RigChannel) -> Limits:
    """Return the limits of the channel and of its actuator, where the library knows that."""
    known = profile_of(channel.actuator)
    return channel.limits if known is None else strictest(channel.limits, known.limits)


@checking
def rig_breaches(
    rig: Rig, places: Sequence[int], samples: ArrayLike, sample_rate_hz: int
) -> tuple[RigBreach, ...]:
    """Return the limits that samples would exceed when they are sent to a rig.

    Parameters
    ----------
    places
        Input place of each channel of the samples.
    samples : (n_channels, n_times)
        As they are sent, -1 to 1.
    sample_rate_hz
        A whole number of hertz.

    Returns
    -------
    In order of the places; none: nothing is passed, so far as the rig knows its limits.  Of a
    channel without volts at full scale only the duration and the duty are known, and of one
    without a model no displacement.

    Raises
    ------
    InvalidInputError
        A place is not wired, or samples and places do not fit together.

    Examples
    --------
    >>> import skinsource as ss
    >>> limits = ss.actuators.Limits(peak_voltage_v=1.0)
    >>> channel = ss.rigs.RigChannel(place=7, full_scale_v=2.0, limits=limits)
    >>> (passed,) = ss.rigs.rig_breaches(ss.rigs.Rig(channels=[channel]), [7], [[0.9]], 48000)
    >>> print(passed.place)
    7
    """
    rows = finite_array("samples", samples, "finite numbers, (n_channels, n_times)")
    if rows.ndim != 2 or len(rows) != len(places):
        raise InvalidInputError(
            f"samples have the shape {rows.shape}, expected ({len(places)} places, n_times)"
        )
    rate_hz = integer("sample_rate_hz", sample_rate_hz, 1, MAX_RATE_HZ)
    passed = []
    for place, row in zip(places, rows, strict=True):
        broken = _breaches_of(wired_channel(rig, place), row, rate_hz)
        passed += [RigBreach(place, breach) for breach in broken]
    return tuple(passed)


def _breaches_of(channel: RigChannel, row: np.ndarray, sample_rate_hz: int) -> tuple[Breach, ...]:
    limits = limits_of(channel)
    if not row.size or limits == Limits():
        return ()
    known_volts, model = channel.full_scale_v is not None, channel.moves_as
    volts = volts_of(channel, row) if known_volts else row
    # A measured response knows no current, the model does.
    electrical = channel.model if channel.model is not None else model
    (prediction,) = predicted(
        volts, sample_rate_hz, electrical or _UNIT_RESPONSE, thermal=channel.thermal
    )
    passed = list(breaches(prediction, limits))
    if model is not electrical or model is None:
        passed = [breach for breach in passed if breach.name != "displacement_m"]
    if model is not electrical and model is not None:
        (motion,) = predicted(volts, sample_rate_hz, model)
        passed += [breach for breach in breaches(motion, limits) if breach.name == "displacement_m"]
    return tuple(breach for breach in passed if known_volts or breach.name in _TIME_LIMITS)


# So much louder every limit is exceeded; a power of two, so that nothing rounds.
_TEST_GAIN = 2.0**40


@dataclass(frozen=True, slots=True)
class Margin:
    """The highest gain that a rig allows.

    Attributes
    ----------
    factor
        0: none; infinity: the rig knows no limit.
    words
        The limit that would be passed first, "" where there is none.
    """

    factor: float = inf
    words: str = ""


@checking
def highest_gain(
    rig: Rig,
    places: Sequence[int],
    samples: ArrayLike,
    sample_rate_hz: int,
    *,
    repeated: bool = False,
) -> Margin:
    """Return the gain that samples may get before they exceed a limit of a rig.

    All figures but those of time grow as the samples do.

    Parameters
    ----------
    places, samples, sample_rate_hz
        As of `rig_breaches`.
    repeated
        Whether they are sent again and again: no limit of the duration allows that.

    Raises
    ------
    InvalidInputError
        As `rig_breaches`.

    Examples
    --------
    >>> import skinsource as ss
    >>> limits = ss.actuators.Limits(peak_voltage_v=1.0)
    >>> channel = ss.rigs.RigChannel(place=7, full_scale_v=2.0, limits=limits)
    >>> margin = ss.rigs.highest_gain(ss.rigs.Rig(channels=[channel]), [7], [[0.9]], 48000)
    >>> print(f"{margin.factor:.3f}")
    0.556
    """
    rows = finite_array("samples", samples, "finite numbers, (n_channels, n_times)")
    margin = Margin()
    for rig_breach in rig_breaches(rig, places, rows * _TEST_GAIN, sample_rate_hz):
        breach = rig_breach.breach
        allowed = 0.0 if breach.name in _TIME_LIMITS else _TEST_GAIN * breach.limit / breach.found
        if allowed < margin.factor:
            margin = Margin(allowed, f"place {rig_breach.place}: {limit_text(breach.name)}")
    if repeated:
        for place in places:
            channel = rig.channel_of(place)
            if channel is not None and limits_of(channel).duration_s is not None:
                return Margin(0.0, f"place {place}: duration, repeated without end")
    return margin


FORMAT, VERSION = "skinsource rig", 1
SUFFIX = ".skinrig"


@checking
def save_rig(path: str | os.PathLike[str], rig: Rig) -> None:
    """Write a rig, whole or not at all.

    Parameters
    ----------
    path
        The file; it usually ends in ``.skinrig``.  An existing file is replaced.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        It holds so much that it could not be read again.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "lab.skinrig"
    ...     ss.save_rig(path, ss.rigs.Rig())
    ...     print(path.exists())
    True
    """
    write_bytes(Path(path), to_plain_text(models.encode(rig), FORMAT, VERSION).encode())


@checking
def open_rig(path: str | os.PathLike[str]) -> Rig:
    """Read a rig file.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It holds no rig, or what no rig can be: the message says where.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "lab.skinrig"
    ...     ss.save_rig(path, ss.rigs.Rig())
    ...     print(ss.open_rig(path) == ss.rigs.Rig())
    True
    """
    place = Path(path)
    try:
        tree = from_plain_text(read_bytes(place, most=MAX_TEXT_BYTES + 1), FORMAT, VERSION)
        rig: Rig = models.decode(tree, (Rig,), Address())
    except (FileFormatError, InvalidInputError) as error:
        message = str(error).removeprefix(f"{path_text(Path(place.name))}: ")
        raise FileFormatError(f"{path_text(Path(place.name))}: {sentence(message)}") from error
    return rig
