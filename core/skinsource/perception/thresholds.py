"""Thresholds of detection of the psychophysical channels, in closed form, and levels above them.

Displacements in dB re 1 µm peak, at the thenar eminence, with a contactor of 2.9 cm²; the shape
follows Bolanowski, Gescheider, Verrillo and Checkosky, "Four channels mediate the mechanical
aspects of touch", J. Acoust. Soc. Am. 84, 1988, doi:10.1121/1.397184; the anchors are rounded.

The weighting of hand-transmitted vibration after ISO 5349-1 is for health, not for perception: the
standard measures at the surface that vibrates, near the grip, not on the skin.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking, finite_array, one_of, positive_number, real_array
from skinsource.base.conventions import BAND_HZ, LIMB_NAMES, Band, Complexes, Floats
from skinsource.base.errors import FileFormatError, InvalidInputError, quoted
from skinsource.base.files import read_bytes
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.locations import ARM_REGIONS, OUTPUTS
from skinsource.signals.loudest_window import loudest_energy, window_samples
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import PlainSpec, TextSpec

#: ``"P"``: Pacinian, high frequencies, adds up over the area.  ``"NP I"``: below it.
Channel = Literal["P", "NP I"]
CHANNELS: tuple[Channel, ...] = get_args(Channel)

#: Contactor that the thresholds are for.
REFERENCE_AREA_CM2 = 2.9
_MICROMETRE_M = 1e-6
# Far above what anybody feels; the square of much higher ones is no number.
_HIGHEST_HZ = 1e9


def threshold_rms(
    frequency_hz: ArrayLike, channel: Channel | None = None, *, area_cm2: float = REFERENCE_AREA_CM2
) -> Floats:
    """Return the acceleration that is just detected, as RMS.

    Parameters
    ----------
    frequency_hz : (...,)
        Positive.
    channel
        Of which channel; None: of the more sensitive one.
    area_cm2
        Contactor.  Smaller ones raise the threshold of P by 3 dB for each halving; waves that
        spread far from the contact move a large area, and count as the reference.

    Returns
    -------
    (...,), in m/s².

    Raises
    ------
    InvalidInputError
        A frequency or the area is not positive, or there is no such channel.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.perception.threshold_rms(250.0, "P"))
    0.17447160499097195
    """
    frequency = real_array("frequency_hz", frequency_hz)
    if frequency.size and not (frequency.min() > 0.0 and frequency.max() <= _HIGHEST_HZ):
        raise InvalidInputError(
            f"frequency_hz goes from {frequency.min():g} to {frequency.max():g}, expected hertz "
            f"above 0 and up to {_HIGHEST_HZ:g}"
        )
    area = positive_number("area_cm2", area_cm2)
    chosen = CHANNELS if channel is None else (one_of("channel", channel, CHANNELS),)
    displacement_db = np.min([_SHAPES[name](frequency, area) for name in chosen], axis=0)
    peak_m = _MICROMETRE_M * 10.0 ** (displacement_db / 20.0)
    return (2.0 * np.pi * frequency) ** 2 * peak_m / np.sqrt(2.0)


def _pacinian_db(frequency: Floats, area_cm2: float) -> Floats:
    below = 12.0 * np.log2(250.0 / np.minimum(frequency, 250.0))
    above = 10.0 * np.log2(np.maximum(frequency, 300.0) / 300.0)
    smaller = 10.0 * np.log10(REFERENCE_AREA_CM2 / area_cm2)
    return -20.0 + below + above + smaller


def _non_pacinian_1_db(frequency: Floats, _: float) -> Floats:
    # No more sensitive than the channel that takes over below 3 Hz.
    below = 5.0 * np.log2(30.0 / np.clip(frequency, 3.0, 30.0))
    above = 6.0 * np.log2(np.maximum(frequency, 60.0) / 60.0)
    return 10.0 + below + above


_SHAPES = {"P": _pacinian_db, "NP I": _non_pacinian_1_db}


#: Pairs of hertz and m/s² RMS, rising in frequency.
ThresholdTable = tuple[tuple[float, float], ...]
_MOST_BYTES, _MOST_ROWS = 100_000, 1000
_HEADS = "frequency_hz,threshold_m_per_s2 or frequency_hz,threshold_db_re_1e-6_m_per_s2"


def read_threshold_table(path: Path) -> ThresholdTable:
    """Return the table of a CSV file.

    Its header names two columns: ``frequency_hz`` and either ``threshold_m_per_s2`` (RMS) or
    ``threshold_db_re_1e-6_m_per_s2``.  Lines that begin with # say something.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It is no such table; the message says in which line.
    """
    text = read_bytes(path, most=_MOST_BYTES).decode("utf-8-sig", errors="replace")
    lines = [
        (number, line.strip())
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.startswith("#")
    ]
    if not lines:
        raise FileFormatError(f"{quoted(path.name)} is empty, expected {_HEADS}")
    head = lines[0][1].replace(" ", "").lower()
    in_db = head == "frequency_hz,threshold_db_re_1e-6_m_per_s2"
    if not in_db and head != "frequency_hz,threshold_m_per_s2":
        raise FileFormatError(
            f"{quoted(path.name)}, line {lines[0][0]}: found {quoted(lines[0][1])}, expected the "
            f"header {_HEADS}"
        )
    rows = [_row(path.name, number, line, in_db=in_db) for number, line in lines[1:]]
    if not 1 < len(rows) <= _MOST_ROWS:
        raise FileFormatError(
            f"{quoted(path.name)} has {len(rows)} rows, expected 2 to {_MOST_ROWS}"
        )
    table = tuple(sorted(rows))
    if len({frequency for frequency, _ in table}) < len(table):
        raise FileFormatError(f"{quoted(path.name)} has two rows for one frequency; remove one")
    return table


def table_threshold(table: ThresholdTable, frequency_hz: ArrayLike) -> Floats:
    """Return thresholds at frequencies, m/s² RMS; infinite outside of the table.

    Between rows straight in the logarithms of both.
    """
    frequency = finite_array("frequency_hz", frequency_hz)
    known_hz, known = np.array(table).T
    inside = (frequency >= known_hz[0]) & (frequency <= known_hz[-1])
    at = np.log(np.where(inside, frequency, known_hz[0]))
    return np.where(inside, np.exp(np.interp(at, np.log(known_hz), np.log(known))), np.inf)


def _row(name: str, number: int, line: str, *, in_db: bool) -> tuple[float, float]:
    try:
        frequency, value = (float(part) for part in line.split(","))
        threshold = 1e-6 * 10.0 ** (value / 20.0) if in_db else value
    except (ValueError, OverflowError):
        frequency, threshold = math.nan, math.nan
    if not (0.0 < frequency < 1e6 and 0.0 < threshold < 1e12):
        raise FileFormatError(
            f"{quoted(name)}, line {number}: found {quoted(line)}, expected a frequency in Hz and "
            "a threshold, both positive"
        )
    return frequency, threshold


AREA = NumberSpec(
    label="Area",
    unit="cm²",
    minimum=0.01,
    maximum=100.0,
    step=0.1,
    hint="Vibrating area: 2.9 cm² for spreading waves; smaller raises the P threshold",
)
TABLE = PlainSpec(label="Own thresholds")
SOURCE = TextSpec(label="File of own thresholds", longest=200, one_line=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class PerceptionSettings(fields.CheckedModel):
    """Thresholds that levels are compared with.

    Attributes
    ----------
    area_cm2
        See `skinsource.perception.threshold_rms`.
    table
        Own thresholds, see `read_threshold_table`; none: those of the model.
    source
        Name of the file that they come from.
    """

    area_cm2: float = fields.number(REFERENCE_AREA_CM2, AREA)
    table: Any = fields.field(TABLE, ())
    source: str = fields.text("", SOURCE)

    @property
    def thresholds(self) -> ThresholdTable:
        """Own thresholds; none where ``table`` is unusable."""
        pairs = self.table if isinstance(self.table, tuple) else ()
        # A table is stored flat: frequency, threshold, frequency, ...
        numbers = [number for number in pairs if isinstance(number, int | float)]
        table = tuple(zip(numbers[::2], numbers[1::2], strict=False))
        rising = all(a[0] < b[0] for a, b in pairwise(table))
        sound = all(f > 0.0 and a > 0.0 for f, a in table)
        return table if len(table) > 1 and rising and sound else ()


def settings_table(table: ThresholdTable) -> tuple[float, ...]:
    """Return a table as settings hold it."""
    return tuple(number for pair in table for number in pair)


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
    return np.maximum(*parts) + 0.5 * np.minimum(*parts)


#: Frequencies and qualities of Wh (ISO 5349-1:2001, annex A): band limits, transition.
_F1_HZ, _F2_HZ, _F3_HZ, _F4_HZ = 6.310, 1258.9, 15.915, 15.915
_Q1, _Q2 = 0.71, 0.64
# Its slowest part, at 6.3 Hz, has died away to rounding.
_WH_RINGS_S = 1.0


def hand_arm_weighting(frequency_hz: Floats) -> Complexes:
    """Return the analogue response of Wh at frequencies, same shape; 0 at 0 Hz.

    |H| is 0.954 at 10 Hz, 0.325 at 50 Hz, 0.0797 at 200 Hz.
    """
    s = 2j * np.pi * frequency_hz
    w1, w2, w3, w4 = (2.0 * np.pi * f for f in (_F1_HZ, _F2_HZ, _F3_HZ, _F4_HZ))
    band = s**2 * w2**2 / ((s**2 + s * w1 / _Q1 + w1**2) * (s**2 + s * w2 / _Q1 + w2**2))
    gain = 2.0 * np.pi * _F4_HZ**2 / _F3_HZ
    transition = (s + w3) * gain / (s**2 + s * w4 / _Q2 + w4**2)
    return band * transition


def weighted_rms(acceleration: Floats, sample_rate_hz: float) -> float:
    """Return the RMS of an acceleration through Wh over its samples, m/s².

    On the bins of the transform, so that no digital filter warps the response near half the rate.

    Parameters
    ----------
    acceleration : (n_times,)
        Of the surface at the contact, m/s²; silent before and after, where what the filter rings
        counts too.
    sample_rate_hz
        Its rate.
    """
    n_times = acceleration.size
    n_fft = scipy.fft.next_fast_len(n_times + math.ceil(_WH_RINGS_S * sample_rate_hz), real=True)
    spectrum = scipy.fft.rfft(acceleration, n_fft)
    frequency_hz = np.arange(spectrum.size, dtype=np.float64) * (sample_rate_hz / n_fft)
    weight = np.abs(hand_arm_weighting(frequency_hz))
    power = np.square(np.abs(spectrum) * weight)
    power[1 : (n_fft + 1) // 2] *= 2.0
    return float(np.sqrt(power.sum() / n_fft / n_times))
