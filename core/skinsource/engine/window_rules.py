"""Rules from vibrations to the RMS of all outputs in consecutive windows, and their extent."""

import numpy as np

from skinsource.base.arrays import Floats, Indices
from skinsource.base.decibels import decibels
from skinsource.base.job import Stop, stop_if
from skinsource.design.signal_path import Voice
from skinsource.engine.moments import Projection
from skinsource.engine.spectra import TotalSpectrum
from skinsource.engine.streaming import StreamedVibration, output_groups, projected_signals
from skinsource.limbs.extent import Extent, extent
from skinsource.limbs.limb import Limb
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.signals.analysis.windows import Windows, windows_over


class WindowEnergy:
    """Sums squares of signals within consecutive windows; signals come in pieces."""

    def __init__(self, n_outputs: int, windows: Windows) -> None:
        self._windows = windows
        self._energy = np.zeros((windows.count, n_outputs))

    def add(self, outputs: Indices, first: int, signals: Floats) -> None:
        """Add samples of some outputs, (n_outputs, n), from sample ``first`` on."""
        begin, length = self._windows.first_sample, self._windows.window_samples
        end = first + signals.shape[-1]
        earliest = max((first - begin) // length, 0)
        latest = min(-((begin - end) // length), self._windows.count)
        for window in range(earliest, latest):
            low = max(begin + window * length - first, 0)
            high = min(begin + (window + 1) * length - first, signals.shape[-1])
            if low < high:
                piece = signals[:, low:high]
                self._energy[window, outputs] += np.einsum("ot,ot->o", piece, piece)

    def rms(self) -> Floats:
        """Return the RMS of each output in each window, (n_windows, n_outputs)."""
        return np.sqrt(self._energy / self._windows.window_samples)


# Transforms leave at most this share of the loudest window where there is silence.
_ROUNDING = 1e-12


def windows(
    windows_cut: str,
    window_count: int,
    window_s: float,
    response_samples: int,
    limb_data: Limb,
    sample_rate_hz: float,
) -> Windows:
    """Windows in which the response to the stimulus arrives."""
    by_count = windows_cut == "count"
    return windows_over(
        max(response_samples - limb_data.n_taps + 1, 1),
        response_samples,
        sample_rate_hz,
        count=window_count if by_count else None,
        window_s=None if by_count else window_s,
        delay_s=limb_data.pre_trigger_delay_s,
    )


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
    energy = WindowEnergy(limb_data.n_outputs, windows)
    if streamed_vibration is not None:
        numbers = range(1, limb_data.n_outputs + 1)
        for first, block in streamed_vibration.blocks_of(numbers, projection.axis_numbers, stop):
            energy.add(np.arange(limb_data.n_outputs), first, projection.signals(block))
    elif total_spectrum is not None:
        for outputs in output_groups(limb_data.n_outputs):
            stop_if(stop)
            signals = projected_signals(total_spectrum, projection, outputs)
            energy.add(outputs, 0, signals[:, :response_samples])
    rms = energy.rms()
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
    rms_of_windows: Floats, limb_data: Limb, voices: tuple[Voice, ...]
) -> tuple[Extent | None, ...]:
    """How far each window reaches from the nearest audible input; None: it is silent."""
    places = sorted(
        {voice.location for voice in voices if voice.audible and voice.amplitude != 0.0}
    )
    placed = np.isfinite(limb_data.map.output_positions[:, 0])
    return tuple(
        extent(rms, limb_data, places) if places and rms[placed].any() else None
        for rms in rms_of_windows
    )


RULES = (
    windows,
    rms_of_windows,
    levels_of_windows_db,
    surface_of_windows_db,
    extents_of_windows,
)
