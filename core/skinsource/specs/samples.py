"""A recorded or drawn signal: samples with their rate and unit, compared by their content."""

import hashlib
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import positive_number
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.signals.generators import sample_count
from skinsource.signals.resampling import by_ratio
from skinsource.signals.sampling import band_limited_delay, shift_of

#: At 1300 Hz more than an hour and a half.
MAX_SAMPLES = 2**23
_MAX_UNIT_CHARACTERS = 20


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """An immutable signal; a call with a rate returns it at that rate.

    Two signals are equal if values, rate and unit are, bit by bit.  The values are hashed once,
    when the signal is made; comparing and hashing it later costs nothing.

    Attributes
    ----------
    values : (n_times,)
        Finite numbers, read-only.
    sample_rate_hz
        Above zero.
    unit
        ``"m/s²"``, or empty for a plain drive.
    peak
        Largest magnitude of a value.
    digest
        SHA-256 of values, rate and unit, in hexadecimal: the name of these samples in files.
    """

    values: NDArray[np.float64]
    sample_rate_hz: float
    unit: str = ""
    peak: float = field(init=False)
    digest: str = field(init=False)

    def __post_init__(self) -> None:
        rate = self.sample_rate_hz
        if isinstance(rate, bool) or not isinstance(rate, int | float) or not 0 < rate <= 1e9:
            raise InvalidInputError(
                f"sample_rate_hz is {quoted(rate)}, expected a number above 0 and up to 1e9 Hz"
            )
        if not isinstance(self.unit, str) or len(self.unit) > _MAX_UNIT_CHARACTERS:
            raise InvalidInputError(f"unit is {quoted(self.unit)}, expected a short text")
        object.__setattr__(self, "sample_rate_hz", float(rate))
        object.__setattr__(self, "values", _read_only(self.values))
        object.__setattr__(self, "peak", float(np.abs(self.values).max()))
        object.__setattr__(self, "digest", self._digest())

    def __repr__(self) -> str:
        return f"<{self.values.size} samples at {self.sample_rate_hz:g} Hz, {self.digest[:12]}>"

    def __str__(self) -> str:
        unit = f", in {self.unit}" if self.unit else ""
        return f"{self.values.size} at {self.sample_rate_hz:g} Hz{unit}"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Samples) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    @property
    def duration_s(self) -> float:
        """Duration of the signal."""
        return self.values.size / self.sample_rate_hz

    def __call__(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Return the band-limited signal at any rate, shifted by less than a sample, (n_times,).

        At the own rate and without a shift this is a copy of the samples.  Other rates are made as
        by `skinsource.resample`, the shift by a band-limited delay: up to 600 Hz, or 0.92 of half
        the lower rate, both keep the signal within 0.001 dB.
        """
        rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
        shift = shift_of(shift_s, rate_hz) * rate_hz
        if rate_hz == self.sample_rate_hz:
            return band_limited_delay(self.values, shift) if shift else self.values.copy()
        count = sample_count(self.duration_s, rate_hz)
        if not count:
            return np.zeros(0)
        ratio = Fraction(rate_hz) / Fraction(self.sample_rate_hz)
        resampled = by_ratio(self.values, ratio, min(rate_hz, self.sample_rate_hz))
        return band_limited_delay(resampled[:count], shift)

    def _digest(self) -> str:
        head = f"{self.sample_rate_hz.hex()} {self.unit}\n"
        digest = hashlib.sha256(head.encode("utf-8", "surrogatepass"))
        digest.update(self.values.astype("<f8", copy=False).data)
        return digest.hexdigest()


def _read_only(values: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(values)
    masked = isinstance(values, np.ma.MaskedArray)
    if masked or array.dtype.kind not in "iuf" or array.ndim != 1:
        raise InvalidInputError(
            f"values are {'masked ' if masked else ''}{array.dtype} of shape {array.shape}, "
            "expected real numbers, (n_times,)"
        )
    if not 1 <= array.size <= MAX_SAMPLES:
        raise InvalidInputError(f"{array.size} samples, expected 1 to {MAX_SAMPLES}")
    own = np.array(array, np.float64)
    if not np.isfinite(own).all():
        raise InvalidInputError("samples are not all finite numbers; correct them")
    own.flags.writeable = False
    return own
