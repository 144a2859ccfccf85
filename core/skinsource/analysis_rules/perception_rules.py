"""Rules from vibrations to levels above the thresholds of detection."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy

from skinsource.arrays import Floats
from skinsource.chain import Actuation, Drive
from skinsource.job import Stop
from skinsource.limb import PUBLISHED, Band, Limb
from skinsource.loudest_window import window_samples
from skinsource.perception import CHANNELS, sensation_magnitude, site_offsets_db, threshold_rms
from skinsource.perception.hand_arm import weighted_rms
from skinsource.perception.settings import PerceptionSettings
from skinsource.perception.threshold_table import table_threshold
from skinsource.rendering.loudest_energies import loudest_energies, loudest_energies_streamed
from skinsource.rendering.projecting import Projection
from skinsource.rendering.segments import Played
from skinsource.rendering.streaming import StreamedVibration
from skinsource.rendering.total_spectrum import TotalSpectrum
from skinsource.scaling.response_scaling import Scaling
from skinsource.surface import SurfaceOperator
from skinsource.validity import are_probe_accelerations

#: Levels of what is not felt at all.
SILENT_DB = -200.0
_NO_SCALE = "Levels above threshold need accelerations: choose the scaling Probe acceleration"
_NO_SITES = "Which outputs lie on hairy skin is known of the published limbs only"
_OWN = "own"
# Before and after a drive, so that a weighted one has room to ring.
_ROOM_S = 0.2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sensation:
    """Levels above the threshold of detection, of the loudest 100 ms.

    Attributes
    ----------
    by_channel
        ``"P"`` and ``"NP I"``, or ``"own"`` for thresholds of one's own: (n_outputs,), dB.
    level_db : (n_outputs,)
        The highest of them.
    strength : (n_outputs,) or None
        See `skinsource.perception.sensation_magnitude`; None for thresholds of one's own.
    problem
        Why there are none; "" where there are.
    band_hz
        Frequencies that count: those that the limb was measured at, or, where that is not known,
        those of the thresholds of one's own.
    """

    by_channel: Mapping[str, Floats]
    level_db: Floats
    strength: Floats | None = None
    problem: str = ""
    band_hz: Band | None = None


def sensation(
    perception_settings: PerceptionSettings,
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    limb_data: Limb,
    scaling: Scaling,
    stop: Stop,
) -> Sensation:
    """Level of each output above the thresholds: energies add up over axes and frequencies."""
    table = perception_settings.thresholds
    problem = _problem(limb_data, scaling, own=bool(table))
    if problem:
        return Sensation(by_channel={}, level_db=np.zeros(0), problem=problem)
    rate = limb_data.sample_rate_hz
    band_hz = limb_data.band_hz or (table[0][0], table[-1][0])
    offsets: dict[Any, Floats] = {} if table else {**site_offsets_db(limb_data.name)}
    found: dict[Any, Floats] = {}
    for channel in (_OWN,) if table else CHANNELS:

        def weights(frequency_hz: Floats, channel: str = channel) -> Floats:
            return _weights(frequency_hz, channel, perception_settings, band_hz)

        energy = _loudest(total_spectrum, streamed_vibration, limb_data, weights, stop)
        with np.errstate(divide="ignore"):
            level = 10.0 * np.log10(energy / window_samples(rate))
        found[channel] = np.maximum(level - offsets.get(channel, 0.0), SILENT_DB)
    return Sensation(
        by_channel=found,
        level_db=np.array(list(found.values())).max(axis=0),
        strength=None if table else sensation_magnitude(found),
        band_hz=band_hz,
    )


def sensation_db(sensation: Sensation) -> Floats:
    """Level of each output above threshold, (n_outputs,), dB; none where it is not known."""
    return sensation.level_db


def surface_sensation_db(surface: SurfaceOperator, sensation_db: Floats) -> Floats | None:
    """The same over the back of hand and arm, (rows, columns)."""
    return surface.interpolate(sensation_db) if sensation_db.size else None


def contact_weighted_rms(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
) -> tuple[tuple[int, float], ...] | None:
    """Acceleration of each probe through Wh of ISO 5349-1, RMS over what it plays, m/s².

    None where drives are no accelerations.
    """
    if not are_probe_accelerations(limb_data, scaling, actuated=actuation is not None):
        return None
    return tuple(
        (place, float(weighted_rms(np.trim_zeros(played), limb_data.sample_rate_hz)))
        for place, played in place_drives
        if played.any()
    )


RULES = (sensation, sensation_db, surface_sensation_db, contact_weighted_rms)


def _problem(limb: Limb, scaling: Scaling, *, own: bool) -> str:
    if scaling != "probe":
        return _NO_SCALE
    # As many outputs do not make them lie where those of the published limbs do.
    return _NO_SITES if limb.name not in PUBLISHED and not own else ""


def _weights(
    frequency_hz: Floats,
    channel: str,
    settings: PerceptionSettings,
    band_hz: Band,
) -> Floats:
    """One over the threshold within the band, else 0: what is slower was not measured."""
    low, high = band_hz
    inside = (frequency_hz >= low) & (frequency_hz <= high)
    at = np.where(inside, frequency_hz, low)
    if channel == _OWN:
        threshold = table_threshold(settings.thresholds, at)
    elif channel == "P":
        threshold = threshold_rms(at, "P", area_cm2=settings.area_cm2)
    else:
        threshold = threshold_rms(at, "NP I")
    return np.where(inside, 1.0 / threshold, 0.0)


def _loudest(
    total: TotalSpectrum | None,
    streamed: StreamedVibration | None,
    limb: Limb,
    weights: Callable[[Floats], Floats],
    stop: Stop,
) -> Floats:
    """Energy of the loudest window of the weighted vibration, all axes together, (n_outputs,)."""
    every = Projection(tuple(range(limb.n_axes)), None)
    rate, n_window = limb.sample_rate_hz, window_samples(limb.sample_rate_hz)
    if streamed is not None:
        weighted = streamed.played_through(lambda one: _through(one, weights, rate))
        return loudest_energies_streamed(weighted, every, limb.n_outputs, n_window, stop)
    if total is None:
        return np.zeros(limb.n_outputs)
    frequency_hz = _bins_hz(total.n_fft, rate)
    return loudest_energies(total.times(weights(frequency_hz)), every, n_window, stop)


def _through(played: Played, weights: Callable[[Floats], Floats], rate: float) -> Played:
    """What is played through a weighting, which begins a little earlier and ends later."""
    room = round(_ROOM_S * rate)
    samples = np.pad(played.drive.samples, room)
    n_fft = scipy.fft.next_fast_len(samples.size, real=True)
    frequency_hz = _bins_hz(n_fft, rate)
    heard = scipy.fft.irfft(scipy.fft.rfft(samples, n_fft) * weights(frequency_hz), n_fft)
    first = played.start - room
    heard = heard[max(-first, 0) : samples.size]
    return replace(played, drive=Drive(heard, played.drive.factor), start=max(first, 0))


def _bins_hz(n_fft: int, rate: float) -> Floats:
    return np.arange(n_fft // 2 + 1, dtype=np.float64) * (rate / n_fft)
