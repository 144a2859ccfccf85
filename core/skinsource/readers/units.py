"""Units of recordings, and how each is converted to what an actuator plays.

Accelerations, velocities and displacements become m/s²; forces, voltages and shares of full scale
stay drives as they are, because nothing says what they would move.
"""

import re
from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.base.conventions import Floats

#: The spectrum of a differentiated signal is empty below `EMPTY_HZ` and complete above `FULL_HZ`.
EMPTY_HZ, FULL_HZ = 15.0, 25.0
STANDARD_GRAVITY = 9.80665
# Silence added on either side: the edge of the band rings for this long.
_PADDING_S = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Unit:
    """A unit that a recording may have.

    Attributes
    ----------
    name
        Its symbol.
    title
        Its name for the user: "mm/s, velocity".
    factor
        Its size in SI units; 1 for drives.
    derivatives
        How often a signal is differentiated to become an acceleration.
    becomes
        The unit after the conversion.
    """

    name: str
    title: str
    factor: float = 1.0
    derivatives: int = 0
    becomes: str = ""


UNITS: dict[str, Unit] = {
    unit.name: unit
    for unit in (
        Unit(name="full scale", title="Full scale (±1)"),
        Unit(name="m/s²", title="m/s², acceleration", becomes="m/s²"),
        Unit(name="g", title="g, acceleration", factor=STANDARD_GRAVITY, becomes="m/s²"),
        Unit(name="mm/s", title="mm/s, velocity", factor=1e-3, derivatives=1, becomes="m/s²"),
        Unit(name="µm", title="µm, displacement", factor=1e-6, derivatives=2, becomes="m/s²"),
        Unit(name="N", title="N, force", becomes="N"),
        Unit(name="V", title="V, voltage", becomes="V"),
    )
}

_SPELLINGS = {
    "m/s^2": "m/s²", "m/s2": "m/s²", "m/s**2": "m/s²", "m s^-2": "m/s²", "m s-2": "m/s²",
    "ms-2": "m/s²", "m·s⁻²": "m/s²", "m/s/s": "m/s²", "gn": "g", "g0": "g", "mm s^-1": "mm/s",
    "mm/sec": "mm/s", "um": "µm", "μm": "µm", "micron": "µm", "microns": "µm",
    "micrometer": "µm", "newton": "N", "newtons": "N", "volt": "V", "volts": "V", "fs": "",
}  # fmt: skip
_TIMES_S = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "μs": 1e-6,
            "ns": 1e-9}  # fmt: skip
_TIME_NAMES = re.compile(r"(t|time|times|zeit|timestamps?|time[ _-]?stamps?|tijd|temps|seconds)")
_IN_BRACKETS = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]{1,20}?)\s*[\])]\s*$")
_AFTER = re.compile(r"^(.*?)[ _](s|sec|ms|us|µs|ns)$")


def unit_named(text: str) -> str:
    """Return the name of the unit that ``text`` spells; empty if it is none of `UNITS`."""
    stripped = text.strip()
    spelled = _SPELLINGS.get(stripped.lower(), stripped)
    if spelled in UNITS:
        return spelled
    return {"n": "N", "v": "V", "g": "g"}.get(spelled.lower(), "") if len(spelled) == 1 else ""


def split_heading(heading: str) -> tuple[str, str]:
    """Return the name of a column and its unit in brackets: "acc_x [g]" is "acc_x" and "g"."""
    match = _IN_BRACKETS.match(heading.strip())
    return (match[1], match[2]) if match else (heading.strip(), "")


def time_unit_s(name: str, unit: str = "") -> float | None:
    """Return the unit of times in a series of this name, in s; None if it does not hold times."""
    base, ending = name.strip().lower(), unit.strip().lower()
    if not ending and (match := _AFTER.match(base)):
        base, ending = match[1], match[2]
    if not _TIME_NAMES.fullmatch(base):
        return None
    return _TIMES_S.get(ending) if ending else 1.0


def differentiated(samples: Floats, sample_rate_hz: float, times: int) -> Floats:
    """Return the derivative with respect to time, (n,), of a signal that is silent around it.

    The spectrum is multiplied by i 2 pi f.  Below 15 Hz it is set to zero, and from 15 to 25 Hz it
    rises by half a cosine: drifts and offsets mean nothing here and would become large.
    """
    if not times:
        return samples
    n = samples.size
    padding = int(_PADDING_S * sample_rate_hz)
    length = scipy.fft.next_fast_len(n + 2 * padding, real=True)
    padded = np.concatenate((np.zeros(padding), samples, np.zeros(length - n - padding)))
    frequency_hz = scipy.fft.rfftfreq(length, 1.0 / sample_rate_hz)
    rise = np.clip((frequency_hz - EMPTY_HZ) / (FULL_HZ - EMPTY_HZ), 0.0, 1.0)
    passed = 0.5 * (1.0 - np.cos(np.pi * rise))
    spectrum = scipy.fft.rfft(padded) * passed * (2j * np.pi * frequency_hz) ** times
    if length % 2 == 0 and times % 2:
        spectrum[-1] = 0.0  # at half the sample rate the slope is not known
    return scipy.fft.irfft(spectrum, length)[padding : padding + n]
