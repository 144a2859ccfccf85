"""What every waveform can do."""

from typing import ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray


@runtime_checkable
class Waveform(Protocol):
    """A frozen dataclass that draws itself.

    Attributes
    ----------
    title
        What a user calls this kind.
    """

    title: ClassVar[str]

    @property
    def duration_s(self) -> float:
        """How long it plays."""

    def samples(self, sample_rate_hz: float) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
