"""Whether a drive leaves what it moves at rest."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array, positive_number
from skinsource.errors import InvalidInputError
from skinsource.limb import BAND_HZ

#: Of the velocity that the drive would leave if all of it had one sign, so much may be left.
ALLOWED_SHARE = 0.05


@dataclass(frozen=True, slots=True)
class NetVelocity:
    """What a drive, taken as an acceleration, leaves behind.

    Attributes
    ----------
    left
        Velocity at its end for each m/s² of its peak, in s.
    share
        That over the velocity which it would leave if all of it had one sign, 0 to 1.
    share_below_band
        Share of its energy below the band, 0 to 1.
    lowest_hz
        Where the band begins: 25 Hz of the published limbs.
    """

    left: float
    share: float
    share_below_band: float
    lowest_hz: float = BAND_HZ[0]

    @property
    def returns(self) -> bool:
        """Whether the velocity returns to 0, as nearly as any filter needs."""
        # However long the drive is: as much as the slowest tone of the band has at the same peak.
        allowed_left_s = 1.0 / (2.0 * np.pi * self.lowest_hz)
        return self.share <= ALLOWED_SHARE and self.left <= allowed_left_s

    @property
    def reason(self) -> str:
        """Why it cannot be followed, and what to do."""
        below = f"{100.0 * self.share_below_band:.0f} % of its energy lies below "
        below += f"{self.lowest_hz:g} Hz"
        return (
            f"the drive leaves a velocity of {1e3 * self.left:.3g} mm/s for each m/s² of its peak, "
            f"and {below}: no contactor can follow it, its displacement would grow without end. "
            "Choose a waveform whose velocity returns to zero, for a tap the 'Centred tap', or let "
            "it fade in and out."
        )


def net_velocity(
    drive: ArrayLike, sample_rate_hz: float, lowest_hz: float = BAND_HZ[0]
) -> NetVelocity:
    """What a drive leaves behind.

    Parameters
    ----------
    drive : (n_times,)
        Taken as an acceleration, silent before and after.
    sample_rate_hz
        Above 0.
    lowest_hz
        Where the band begins in which it is followed.
    """
    samples = finite_array("drive", drive, "finite numbers, (n_times,)")
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    if samples.ndim != 1:
        raise InvalidInputError(f"drive has the shape {samples.shape}, expected (n_times,)")
    peak = float(np.abs(samples).max(initial=0.0))
    if peak == 0.0:
        return NetVelocity(0.0, 0.0, 0.0, lowest_hz)
    scaled = samples / peak
    left = abs(float(scaled.sum()))
    # Fine enough that the lowest band is seen however short the drive is.
    length = scipy.fft.next_fast_len(max(samples.size, int(4.0 * rate_hz)), real=True)
    energy = np.abs(scipy.fft.rfft(scaled, length)) ** 2
    # Of the two sides, frequency 0 has one.
    energy[0] *= 0.5
    below = np.arange(energy.size) * rate_hz / length < lowest_hz
    return NetVelocity(
        left=left / rate_hz,
        share=left / float(np.abs(scaled).sum()),
        share_below_band=float(energy[below].sum() / energy.sum()),
        lowest_hz=lowest_hz,
    )
