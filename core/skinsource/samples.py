"""A recorded or drawn signal: samples with their rate and unit, equal by what they hold."""

import hashlib
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted

#: At 1300 Hz more than an hour and a half.
MAX_SAMPLES = 2**23
_MAX_UNIT_CHARACTERS = 20


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Samples:
    """One signal that cannot change.

    Two are equal when values, rate and unit are, bit by bit.  What they hold is looked at once,
    when they are made; comparing and hashing them later costs nothing.

    Attributes
    ----------
    values : (n_times,)
        Finite numbers, read-only.
    sample_rate_hz
        Above zero.
    unit
        ``"m/s²"``, or empty for a plain drive.
    digest
        SHA-256 over all of it, in hexadecimal: the name of these samples in files.
    """

    values: NDArray[np.float64]
    sample_rate_hz: float
    unit: str = ""
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
        object.__setattr__(self, "digest", self._digest())

    def __repr__(self) -> str:
        return f"<{self.values.size} samples at {self.sample_rate_hz:g} Hz, {self.digest[:12]}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Samples) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def _digest(self) -> str:
        words = f"{self.sample_rate_hz.hex()} {self.unit}\n"
        found = hashlib.sha256(words.encode("utf-8", "surrogatepass"))
        found.update(self.values.astype("<f8", copy=False).data)
        return found.hexdigest()


def _read_only(values: ArrayLike) -> NDArray[np.float64]:
    found = np.asarray(values)
    masked = isinstance(values, np.ma.MaskedArray)
    if masked or found.dtype.kind not in "iuf" or found.ndim != 1:
        raise InvalidInputError(
            f"values are {'masked ' if masked else ''}{found.dtype} of shape {found.shape}, "
            "expected real numbers, (n_times,)"
        )
    if not 1 <= found.size <= MAX_SAMPLES:
        raise InvalidInputError(f"{found.size} samples, expected 1 to {MAX_SAMPLES}")
    own = np.array(found, np.float64)
    if not np.isfinite(own).all():
        raise InvalidInputError("samples that are not finite numbers cannot be played")
    own.flags.writeable = False
    return own
