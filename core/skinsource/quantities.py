"""Every quantity the studio can show.  To add one, write one function here.

A function's name is the quantity it computes, its parameters are the quantities it needs; the
fields of the design and of the view are given.
"""

from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.catalogue import load_limb
from skinsource.decibels import decibels
from skinsource.design import Design, Input, audible_inputs
from skinsource.field_memory import FieldMemory, UnitField
from skinsource.graph import Graph
from skinsource.limb import Limb, LimbMap
from skinsource.projection import Axes, Method, project_axes
from skinsource.signals import sample_count
from skinsource.spectra import magnitude_spectrum, rms
from skinsource.surface import SurfaceOperator, surface_operator
from skinsource.view import View

Floats = NDArray[np.float64]

#: Time between the trigger and the pulse in the measured responses, s.
PRE_TRIGGER_DELAY_S = 0.052


def limb_data(limb: str) -> Limb:
    """The limb, with its responses read when touched."""
    return load_limb(limb)


def limb_map(limb_data: Limb) -> LimbMap:
    """Outline of the limb and places on it."""
    return limb_data.map


def sample_rate_hz(limb_data: Limb) -> float:
    """Sample rate of drives and responses."""
    return limb_data.sample_rate_hz


def audible(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Inputs that are heard."""
    return audible_inputs(inputs)


def input_waveforms(inputs: tuple[Input, ...], sample_rate_hz: float) -> tuple[Floats, ...]:
    """What each input plays, muted or not: one (n_times,) each, of peak 1."""
    return tuple(one.waveform.samples(sample_rate_hz) for one in inputs)


def drives(audible: tuple[Input, ...], sample_rate_hz: float) -> Floats:
    """Drive of each audible input from time 0 to the end of the last, (n_inputs, n_times).

    Amplitudes are applied later: dragging one changes nothing here.
    """
    played = [one.waveform.samples(sample_rate_hz) for one in audible]
    starts = [sample_count(one.onset_s, sample_rate_hz) for one in audible]
    ends = [start + len(samples) for start, samples in zip(starts, played, strict=True)]
    result = np.zeros((len(audible), max(ends, default=1)))
    for row, samples, start, end in zip(result, played, starts, ends, strict=True):
        row[start:end] = samples
    return result


def drive_time_s(drives: Floats, sample_rate_hz: float) -> Floats:
    """Sampling instants of the drives, (n_times,), in seconds."""
    return np.arange(drives.shape[-1]) / sample_rate_hz


def amplitudes(audible: tuple[Input, ...]) -> tuple[float, ...]:
    """Amplitude of each audible input."""
    return tuple(one.amplitude for one in audible)


def skin_acceleration(
    unit_fields: tuple[UnitField, ...], amplitudes: tuple[float, ...], drives: Floats
) -> Floats:
    """Predicted skin acceleration, (72 outputs, 3 axes, n_times), in m/s²."""
    if not unit_fields:
        return np.zeros((72, 3, drives.shape[-1] + 521))
    total = np.zeros_like(unit_fields[0].acceleration)
    for field, amplitude in zip(unit_fields, amplitudes, strict=True):
        total += field.acceleration * (amplitude * field.gain)
    return total


def projected(skin_acceleration: Floats, axes: Axes, method: Method) -> Floats:
    """Skin acceleration along the chosen axes, (72 outputs, n_times), in m/s²."""
    return project_axes(skin_acceleration, axes, method)


def output_rms(projected: Floats) -> Floats:
    """RMS over the whole response, (72 outputs,), in m/s²."""
    return rms(projected)


def output_levels_db(output_rms: Floats) -> Floats:
    """RMS level of each output, (72,), in dB re 1 m/s²; silence is -200 dB."""
    return decibels(output_rms)


def surface(limb_data: Limb) -> SurfaceOperator:
    """Operator from outputs to the pixels of the map."""
    return surface_operator(limb_data)


def surface_levels_db(surface: SurfaceOperator, output_levels_db: Floats) -> Floats:
    """RMS level over the back of hand and arm, (rows, columns), dB; NaN outside the outline."""
    return surface.interpolate(output_levels_db)


def response_time_s(
    skin_acceleration: Floats, sample_rate_hz: float, delay_removed: bool
) -> Floats:
    """Sampling instants of the response, (n_times,), in seconds."""
    shift_s = PRE_TRIGGER_DELAY_S if delay_removed else 0.0
    return np.arange(skin_acceleration.shape[-1]) / sample_rate_hz - shift_s


def selected_traces(projected: Floats, outputs: tuple[int, ...]) -> Floats:
    """Projected acceleration of the selected outputs, (n_selected, n_times), in m/s²."""
    return projected[[output - 1 for output in outputs]]


def selected_spectra(selected_traces: Floats, sample_rate_hz: float) -> tuple[Floats, Floats]:
    """Frequencies, (n_bins,), in Hz, and magnitudes, (n_selected, n_bins), in m/s²."""
    return magnitude_spectrum(selected_traces, sample_rate_hz)


RULES: tuple[Callable[..., Any], ...] = (
    limb_data,
    limb_map,
    sample_rate_hz,
    audible,
    input_waveforms,
    drives,
    drive_time_s,
    amplitudes,
    skin_acceleration,
    projected,
    output_rms,
    output_levels_db,
    surface,
    surface_levels_db,
    response_time_s,
    selected_traces,
    selected_spectra,
)


def sources(design: Design, view: View) -> dict[str, Any]:
    """Return the fields of design and view by name: where evaluation starts from."""
    return {
        field.name: getattr(value, field.name)
        for value in (design, view)
        for field in fields(value)
    }


def new_graph() -> Graph:
    """Return a graph of all quantities, with an empty memory."""
    return Graph(*RULES, FieldMemory().unit_fields)
