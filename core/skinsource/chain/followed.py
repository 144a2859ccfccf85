"""Drives that an actuator can follow."""

from skinsource.chain.actuation import Actuation
from skinsource.chain.drive import Drive
from skinsource.equalising import followed_band, net_velocity
from skinsource.errors import InvalidInputError
from skinsource.limb import Band


def refuse_unfollowed(
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
    found = net_velocity(drive.samples, sample_rate_hz, lowest_hz)
    if not found.returns:
        raise InvalidInputError(
            f"Input at place {place} cannot be played through this actuator: it leaves a velocity, "
            f"and {100.0 * found.share_below_band:.0f} % of its energy lies below {lowest_hz:g} "
            "Hz. Choose a waveform whose velocity returns to zero, for a tap the 'Centred tap', or "
            "let it fade in and out."
        )
