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

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1.

        Parameters
        ----------
        sample_rate_hz
            Any rate; frequencies at or above half of it are refused.
        shift_s
            0 up to one sample, 1 / ``sample_rate_hz``: how much later than sample 0 it starts.
            Sample k shows the recipe at its own time k / ``sample_rate_hz`` - ``shift_s``, and 0
            before its start and after its end, so that a shifted one takes one sample more.

        Raises
        ------
        InvalidInputError
            The rate, or the shift, is none; or the recipe would alias at this rate.
        """
