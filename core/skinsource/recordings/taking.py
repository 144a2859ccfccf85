"""From the raw numbers of a file to what a waveform plays: pure functions of both."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.recordings.choice import ImportChoice
from skinsource.recordings.stamps import at_steady_rate, pace_of
from skinsource.recordings.three_axes import dft321
from skinsource.recordings.units import UNITS, differentiated
from skinsource.resampling import by_ratio
from skinsource.samples import Samples
from skinsource.waveforms import Recording

_MOST_NAME = 200
# Shares of the energy that are smaller are what edges ring.
_NOTED_LOSS = 0.01
# Of the largest deviation from it.
_NOTED_OFFSET = 1e-3
_BLOCK = 2**18


@dataclass(frozen=True, slots=True, kw_only=True)
class Taken:
    """What came of a part of a file.

    Attributes
    ----------
    samples
        At the rate that was asked for, with their unit.
    name
        Of the file, and of the signal where it has several.
    from_hz
        The rate of the file.
    notes
        What was done to it, in sentences.
    """

    samples: Samples
    name: str
    from_hz: float
    notes: tuple[str, ...] = ()

    @property
    def waveform(self) -> Recording:
        """What a clip plays of it."""
        return Recording(self.samples, self.name[:_MOST_NAME], self.from_hz)


def taken(
    values: NDArray[Any],
    choice: ImportChoice,
    to_hz: float,
    *,
    name: str = "",
    stamps_s: Floats | None = None,
) -> Taken:
    """Return what ``choice`` makes of the raw numbers of the part.

    In this order: missing numbers are refused or become 0; time stamps that are not steady are
    made so; the mean is taken off; the rate is changed by `skinsource.resampling.resample`; the
    unit becomes that of a drive, velocities and displacements by their derivatives from 25 Hz on;
    the peak becomes 1.  Whatever is not asked for changes no bit.

    Parameters
    ----------
    values : (n,) or (3, n)
        As the file holds them; n >= 1.  Three axes become one signal by `three_axes.dft321`.
    choice
        What they are; start and duration are not looked at: this is the part.
    to_hz
        The rate of the result.
    name
        What it is called.
    stamps_s : (n,)
        When each was, in s; None where the rate says so.

    Raises
    ------
    InvalidInputError
        Nothing is left, numbers are missing, the rate is not known, or stamps do not increase.
    """
    if values.ndim not in (1, 2) or not values.size:
        raise InvalidInputError("there is no sample in this part; choose another one")
    notes: list[str] = []
    if values.ndim == 1:
        signal, rate = _at_one_rate(_complete(values, choice, notes), choice, stamps_s, notes)
    else:
        signal, rate = _of_axes(values, choice, stamps_s, notes)
    offset = _offset_of(signal, choice, notes)
    ratio = Fraction(to_hz).limit_denominator(10_000) / rate
    found = by_ratio(signal, ratio, min(float(rate), to_hz), offset=offset)
    _note_loss(_energy(signal, offset), found, ratio, to_hz, notes)
    found, unit = _in_drive_units(found, choice, to_hz, notes)
    return Taken(
        samples=Samples(values=found, sample_rate_hz=to_hz, unit=unit),
        name=name,
        from_hz=float(rate),
        notes=tuple(notes),
    )


def _of_axes(
    axes: NDArray[Any], choice: ImportChoice, stamps_s: Floats | None, notes: list[str]
) -> tuple[Floats, Fraction]:
    """One signal of three axes, and its rate; the offset of each goes before, if it is unwanted."""
    each: list[Floats] = []
    rate, told = Fraction(1), list[str]()
    for axis in axes:
        signal, rate = _at_one_rate(_complete(axis, choice, told), choice, stamps_s, told)
        each.append(np.asarray(signal, np.float64) - _offset_of(signal, choice, told))
    notes += dict.fromkeys(told)
    notes.append(
        "Three axes became one with the energy of all at each frequency (DFT321, Landin et al. "
        "2010)."
    )
    return dft321(np.stack(each)), rate


def _at_one_rate(
    signal: NDArray[Any], choice: ImportChoice, stamps_s: Floats | None, notes: list[str]
) -> tuple[NDArray[Any], Fraction]:
    if stamps_s is None:
        if choice.rate_hz is None:
            raise InvalidInputError("the file does not say its sample rate; type it in")
        return signal, Fraction(choice.rate_hz).limit_denominator(10_000)
    pace = pace_of(stamps_s)
    if pace.steady:
        return signal, pace.rate_hz
    notes.append(pace.note)
    return at_steady_rate(np.asarray(signal, np.float64), stamps_s, pace.rate_hz), pace.rate_hz


def _complete(values: NDArray[Any], choice: ImportChoice, notes: list[str]) -> NDArray[Any]:
    there = np.isfinite(values)
    absent = values.size - int(np.count_nonzero(there))
    if not absent:
        return values
    first = int(np.argmin(there)) + 1
    if choice.missing == "refuse":
        raise InvalidInputError(
            f"{absent} of {values.size} numbers are missing or not finite, the first is number "
            f"{first} of this part; let them count as 0, or choose another part"
        )
    notes.append(f"{absent} missing numbers count as 0, the first is number {first}.")
    return np.where(there, values, values.dtype.type(0))


def _offset_of(signal: NDArray[Any], choice: ImportChoice, notes: list[str]) -> float:
    """What is to be taken off each number; a copy of them all would take much memory."""
    if not choice.remove_offset:
        return 0.0
    mean = float(np.mean(signal, dtype=np.float64))
    most = max(float(signal.max()) - mean, mean - float(signal.min()))
    if abs(mean) > _NOTED_OFFSET * most:
        words = f"{mean:.4g}{_with_unit(choice)}".replace("-", "−")
        notes.append(f"An offset of {words} was taken off.")
    return mean


def _energy(signal: NDArray[Any], offset: float) -> float:
    """Sum of squares, without a copy of all numbers."""
    parts = (signal[k : k + _BLOCK].astype(np.float64) for k in range(0, signal.size, _BLOCK))
    return float(sum(np.sum((part - offset) ** 2) for part in parts))


def _note_loss(
    before: float, after: Floats, ratio: Fraction, to_hz: float, notes: list[str]
) -> None:
    """Say how much of the energy ``before`` lay above what the new rate can hold."""
    if ratio < 1 and before > 0.0:
        lost = 1.0 - float(np.vdot(after, after)) / float(ratio) / before
        if lost >= _NOTED_LOSS:
            share = f"{100.0 * lost:.0f} % of its energy"
            notes.append(f"{share} was above {to_hz / 2:g} Hz and is gone.")


def _in_drive_units(
    signal: Floats, choice: ImportChoice, rate_hz: float, notes: list[str]
) -> tuple[Floats, str]:
    unit = UNITS[choice.unit]
    if unit.derivatives:
        signal = differentiated(signal, rate_hz, unit.derivatives)
        how = "its derivative" if unit.derivatives == 1 else "its second derivative"
        notes.append(f"The acceleration is {how}, from 25 Hz on.")
    # A factor that is 1 changes no bit.
    signal = signal * unit.factor
    if choice.scale == "keep":
        return signal, unit.becomes
    peak = float(np.abs(signal).max())
    if not peak > 0.0:
        raise InvalidInputError("this part is silent and cannot be scaled to a peak of 1")
    return signal / peak, ""


def _with_unit(choice: ImportChoice) -> str:
    return "" if choice.unit == "full scale" else f" {choice.unit}"
