"""Sensation levels: how far each output is above the detection threshold."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking, finite_array, one_of, positive_number
from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import BAND_HZ, LIMB_NAMES, Band
from skinsource.base.quoting import quoted
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.locations import ARM_REGIONS, OUTPUTS
from skinsource.perception.thresholds import CHANNELS, Channel, threshold_rms
from skinsource.signals.loudest_window import loudest_energy, window_samples

#: Text to show with every number of this module.
LIMITS = (
    "Thresholds are of glabrous skin, most outputs lie on hairy or bony skin; sensors, age, "
    "temperature and force are not modelled; people differ by 6 to 10 dB. Compare designs on one "
    "limb only."
)
#: The same where there is little room.
LIMITS_IN_SHORT = "Thresholds of glabrous skin: compare designs on one limb only."
#: How much less sensitive hairy skin of hand and digits is, and that of the arm; 5 to 15 and 10 to
#: 20 dB are reported.
HAIRY_HAND_DB, ARM_DB = 10.0, 15.0
_SILENCE_DB = -300.0
# Growth of the sensation with the amplitude: Stevens, at 250 and 60 Hz.
_EXPONENTS: dict[Channel, float] = {"P": 0.6, "NP I": 0.9}


@checking
def site_offsets_db(limb: str = LIMB_NAMES[0]) -> dict[Channel, Floats]:
    """Return how much the outputs' thresholds exceed those of glabrous skin, dB, (n_outputs,).

    Infinite where a channel plays no part: P on wrist, forearm and elbow, where NP governs
    (Whitehouse and Griffin, 2006).

    Parameters
    ----------
    limb
        Name of a published or synthetic limb: their outputs are at the same places.

    Raises
    ------
    InvalidInputError
        The limb is not one of the published kind: nothing is known of its outputs.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.perception.site_offsets_db()["P"][[0, 71]])
    [10. inf]
    """
    if limb not in PUBLISHED:
        raise InvalidInputError(
            f"limb is {quoted(limb)}, expected one of {', '.join(LIMB_NAMES)}: where the outputs "
            "of others lie is not known. Hand over offsets_db."
        )
    on_arm = np.array([place.region in ARM_REGIONS for place in OUTPUTS])
    return {
        "P": np.where(on_arm, np.inf, HAIRY_HAND_DB),
        "NP I": np.where(on_arm, ARM_DB, HAIRY_HAND_DB),
    }


def sensation_levels_db(
    acceleration: ArrayLike,
    sample_rate_hz: float,
    offsets_db: dict[Channel, Floats] | None = None,
    *,
    area_cm2: float = 2.9,
    band_hz: Band = BAND_HZ,
) -> dict[Channel, Floats]:
    """Return the level above the threshold of each channel, at each output, in its loudest 100 ms.

    Accelerations are divided by the threshold at each frequency of the measured band; 10 log10 of
    the mean square over the loudest window is the level, as in the studio's panel.  Energies add
    up over axes because the direction of fast vibrations is hardly perceived (Landin, Romano,
    McMahan and Kuchenbecker, 2010), and within a channel over frequency.

    Parameters
    ----------
    acceleration : (n_outputs, n_axes, n_times)
        m/s², so in probe scaling only.
    sample_rate_hz
        Its rate.
    offsets_db
        As `site_offsets_db` of the published limbs, which is taken where there is none.
    area_cm2
        As in `threshold_rms`.
    band_hz
        Nothing was measured beyond: it does not count.

    Returns
    -------
    (n_outputs,) for each of `CHANNELS`, dB; -300 in silence.  The higher one of both is
    the level above threshold.

    Raises
    ------
    InvalidInputError
        Wrong shape, samples that are not finite, or offsets for other outputs.

    Examples
    --------
    >>> import skinsource as ss
    >>> acceleration = ss.predict("synthetic-1", [ss.sinusoid(200.0)], [7])
    >>> levels_db = ss.perception.sensation_levels_db(acceleration, 1300.0)["P"]
    >>> print(levels_db.shape, levels_db.argmax() + 1)
    (72,) 28
    """
    data = finite_array("acceleration", acceleration, "(n_outputs, n_axes, n_times)")
    if data.ndim != 3 or data.shape[-1] == 0:
        raise InvalidInputError(
            f"acceleration has shape {data.shape}, expected (n_outputs, n_axes, n_times)"
        )
    rate_hz = positive_number("sample_rate_hz", sample_rate_hz)
    offsets = site_offsets_db() if offsets_db is None else offsets_db
    if offsets_db is None and len(offsets["P"]) != len(data):
        raise InvalidInputError(
            f"acceleration has {len(data)} outputs, expected the {len(offsets['P'])} of the "
            "published limbs: where others lie is not known. Hand over offsets_db."
        )
    n_fft = scipy.fft.next_fast_len(data.shape[-1], real=True)
    spectra = scipy.fft.rfft(data, n_fft)
    frequency_hz = np.arange(n_fft // 2 + 1) * (rate_hz / n_fft)
    inside = (frequency_hz >= band_hz[0]) & (frequency_hz <= band_hz[1])
    levels: dict[Channel, Floats] = {}
    for channel in CHANNELS:
        weights = np.zeros(frequency_hz.size)
        weights[inside] = 1.0 / threshold_rms(frequency_hz[inside], channel, area_cm2=area_cm2)
        weighted = scipy.fft.irfft(spectra * weights, n_fft)
        n_window = window_samples(rate_hz)
        energy = loudest_energy(np.linalg.norm(weighted, axis=1), n_window) / n_window
        offset_db = np.broadcast_to(offsets[channel], energy.shape)
        with np.errstate(divide="ignore"):
            levels_db = 10.0 * np.log10(energy) - offset_db
        levels[channel] = np.maximum(levels_db, _SILENCE_DB)
    return levels


@checking
def sensation_magnitude(levels_db: dict[Channel, Floats]) -> Floats:
    """Return the perceived strength, (n_outputs,), on a scale that only compares.

    Each channel grows as a power of its amplitude from the threshold on; together they are the
    larger and half of the smaller (Hollins and Roy, 1996, doi:10.3109/08990229609052583).

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> print(ss.perception.sensation_magnitude({"P": np.array([20.0]), "NP I": np.array([0.0])}))
    [2.98107171]
    """
    for channel in CHANNELS:
        one_of("a channel", channel, tuple(levels_db))
    parts = [
        np.maximum(10.0 ** (_EXPONENTS[channel] * levels_db[channel] / 20.0) - 1.0, 0.0)
        for channel in CHANNELS
    ]
    magnitude: Floats = np.maximum(*parts) + 0.5 * np.minimum(*parts)
    return magnitude
