"""Rules from vibrations to the RMS of all outputs in consecutive windows, and their extent."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.job import Stop
from skinsource.engine.moments import Projection
from skinsource.engine.spectra import TotalSpectrum
from skinsource.engine.streaming import Piece, StreamedVibration, projected_pieces
from skinsource.limbs.extent import Extent, extent
from skinsource.limbs.limb import Limb
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.signals.analysis.windows import Windows, windows_over


def _rms_within(windows: Windows, pieces: Iterable[Piece], n_outputs: int) -> Floats:
    """Return the RMS in each window of signals in pieces, (n_windows, n_outputs)."""
    energy = np.zeros((windows.count, n_outputs))
    begin, length = windows.first_sample, windows.window_samples
    for outputs, first, signals in pieces:
        end = first + signals.shape[-1]
        earliest = max((first - begin) // length, 0)
        latest = min(-((begin - end) // length), windows.count)
        for window in range(earliest, latest):
            low = max(begin + window * length - first, 0)
            high = min(begin + (window + 1) * length - first, signals.shape[-1])
            if low < high:
                piece = signals[:, low:high]
                energy[window, outputs] += np.einsum("ot,ot->o", piece, piece)
    return np.sqrt(energy / length)


# Transforms leave at most this share of the loudest window where there is silence.
_ROUNDING = 1e-12


def windows(
    windows_cut: str,
    window_count: int,
    window_s: float,
    response_samples: int,
    driven_limb: Limb,
    sample_rate_hz: float,
) -> Windows:
    """Windows in which the response to the stimulus arrives; actuators may move before it."""
    lead = driven_limb.lead_samples
    after = windows_over(
        max(response_samples - driven_limb.n_taps + 1, 1),
        response_samples - lead,
        sample_rate_hz,
        count=window_count if windows_cut == "count" else None,
        window_s=window_s,
        delay_s=driven_limb.pre_trigger_delay_s,
    )
    return replace(after, first_sample=lead + after.first_sample)


def rms_of_windows(
    windows: Windows,
    projection: Projection,
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    response_samples: int,
    limb_data: Limb,
    stop: Stop,
) -> Floats:
    """RMS of the projected signal of each output in each window, (n_windows, n_outputs), m/s²."""
    n_outputs = limb_data.n_outputs
    pieces = projected_pieces(total_spectrum, streamed_vibration, projection, n_outputs, stop)
    # Transforms may be longer than the response.
    within = ((outputs, at, signals[:, : response_samples - at]) for outputs, at, signals in pieces)
    rms = _rms_within(windows, within, n_outputs)
    rms[rms < _ROUNDING * rms.max(initial=0.0)] = 0.0
    return rms


def levels_of_windows_db(rms_of_windows: Floats) -> Floats:
    """Level of each output in each window, (n_windows, n_outputs), dB re 1 m/s²."""
    return decibels(rms_of_windows)


def surface_of_windows_db(surface: SurfaceOperator, levels_of_windows_db: Floats) -> Floats:
    """Map of each window, (n_windows, rows, columns), dB; NaN outside the outline."""
    maps = np.empty((len(levels_of_windows_db), *surface.mask.shape))
    for surface_map, levels_db in zip(maps, levels_of_windows_db, strict=True):
        surface_map[:] = surface.interpolate(levels_db)
    return maps


def extents_of_windows(
    rms_of_windows: Floats, limb_data: Limb, moving_places: tuple[int, ...]
) -> tuple[Extent | None, ...]:
    """How far each window reaches from the nearest input that moves the skin; None: silence."""
    placed = np.isfinite(limb_data.map.output_positions[:, 0])
    return tuple(
        extent(rms, limb_data, moving_places) if moving_places and rms[placed].any() else None
        for rms in rms_of_windows
    )
