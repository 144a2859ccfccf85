"""Rules from traces of the selected outputs to their figures, spectrograms and main axes."""

import numpy as np

from skinsource.analysis.bands import band_rms
from skinsource.analysis.main_axes import MainAxes, main_axes
from skinsource.analysis.settings import SpectrogramSettings
from skinsource.analysis.spectrogram import Spectrogram, spectrogram
from skinsource.analysis.statistics import (
    Statistics,
    crest_factor,
    dominant_frequency,
    onset_time,
)
from skinsource.arrays import Floats
from skinsource.job import Stop, stop_if
from skinsource.limb import Limb
from skinsource.rendering.placed import Placed
from skinsource.rendering.projecting import Projection
from skinsource.rendering.transforms import forward
from skinsource.rendering.vibration import Vibration


def stimulus_start_s(placed: tuple[Placed, ...], sample_rate_hz: float) -> float:
    """When the first input that is heard starts, s; 0 where none is."""
    return min((one.start for one in placed if one.moves), default=0) / sample_rate_hz


def output_statistics(
    axis_traces: Floats,
    selected_traces: Floats,
    selected_projection: Projection,
    shown_outputs: tuple[int, ...],
    output_rms: Floats,
    response_time_s: Floats,
    stimulus_start_s: float,
    sample_rate_hz: float,
    stop: Stop,
) -> Statistics:
    """Figures of the selected outputs; the RMS is that of the map.

    Delays count from the start of the first input.  The dominant frequency is that of the motion
    along the chosen axes: a magnitude is rectified and would show twice of it.
    """
    rms = output_rms[[output - 1 for output in shown_outputs]]
    peak = np.abs(selected_traces).max(axis=-1, initial=0.0)
    n_times = selected_traces.shape[-1]
    dominant_hz = np.empty(len(shown_outputs))
    for row, of_axes in enumerate(axis_traces):
        stop_if(stop)
        spectra = forward(of_axes, n_times)
        if selected_projection.directions is None:
            power = np.sum(np.square(np.abs(spectra)), axis=0)
        else:
            power = np.square(np.abs(selected_projection.directions[row] @ spectra))
        dominant_hz[row] = dominant_frequency(power, sample_rate_hz / n_times)
    return Statistics(
        rms=rms,
        peak=peak,
        crest=crest_factor(peak, rms),
        dominant_hz=dominant_hz,
        delay_s=onset_time(selected_traces, response_time_s) - stimulus_start_s,
    )


def spectrogram_output(
    shown_outputs: tuple[int, ...], spectrogram_settings: SpectrogramSettings
) -> int:
    """Which output the spectrogram is of; 0 where none is selected."""
    wanted = spectrogram_settings.output
    return wanted if wanted in shown_outputs else (shown_outputs or (0,))[-1]


def spectrogram_window_s(spectrogram_settings: SpectrogramSettings) -> float:
    """Length of its window."""
    return spectrogram_settings.window_s


def output_spectrogram(
    selected_traces: Floats,
    shown_outputs: tuple[int, ...],
    spectrogram_output: int,
    spectrogram_window_s: float,
    sample_rate_hz: float,
    stop: Stop,
) -> Spectrogram | None:
    """Spectrogram of one of the selected outputs; None where there is none."""
    if not spectrogram_output:
        return None
    row = selected_traces[shown_outputs.index(spectrogram_output)]
    return spectrogram(row, sample_rate_hz, spectrogram_window_s, stop)


def output_band_rms(
    vibration: Vibration,
    axis_numbers: tuple[int, ...],
    limb_data: Limb,
    sample_rate_hz: float,
    stop: Stop,
) -> tuple[Floats, Floats] | None:
    """Bands of 2 Hz, and the RMS of all outputs in each, (n_outputs, n_axes, n_bins).

    Middles of the bands in Hz, RMS in m/s², as `band_rms` of the outputs' traces;
    None of what is too long to be transformed at once.
    """
    if vibration.streamed is not None:
        return None
    outputs = tuple(range(1, limb_data.n_outputs + 1))
    transforms = vibration.transforms(outputs, axis_numbers, stop)
    return band_rms(transforms, vibration.n_times, sample_rate_hz, limb_data.band_hz)


def output_main_axes(axis_traces: Floats, axis_numbers: tuple[int, ...]) -> MainAxes | None:
    """Along which direction each selected output moves most; None: not of a single axis."""
    return main_axes(axis_traces) if len(axis_numbers) > 1 else None


RULES = (
    stimulus_start_s,
    output_statistics,
    spectrogram_output,
    spectrogram_window_s,
    output_spectrogram,
    output_band_rms,
    output_main_axes,
)
