"""Rules from the inputs of a scene to levels.

Levels follow from moments, moments from spectra: only the outputs that are looked at are brought
back to time.  With the selected input apart, a change of its amplitude is three terms.
"""

import numpy as np

from skinsource.decibels import decibels
from skinsource.design import Input, audible_indices, audible_inputs
from skinsource.job import Stop
from skinsource.limb import N_AXES, N_OUTPUTS, N_TAPS
from skinsource.projection import Axes, Method, axis_numbers
from skinsource.rendering.drives import Booleans, Source, delayed, source_of
from skinsource.rendering.forms import CrossForms, OwnForms
from skinsource.rendering.moments import (
    Moments,
    combined,
    directions_of,
    energies,
    energies_of,
    moments_of,
    needs_products,
)
from skinsource.rendering.part import Part, rows_of
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.segments import length_at_once
from skinsource.rendering.streaming import StreamedField
from skinsource.rendering.transforms import Complexes, Floats
from skinsource.signals import sample_count


def audible(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Inputs that are heard."""
    return audible_inputs(inputs)


def pivot(inputs: tuple[Input, ...], selected_input: int | None) -> Input | None:
    """The selected input, if it is heard."""
    heard = selected_input is not None and selected_input in audible_indices(inputs)
    return inputs[selected_input] if heard and selected_input is not None else None


def others(inputs: tuple[Input, ...], selected_input: int | None) -> tuple[Input, ...]:
    """Inputs that are heard, without the selected one."""
    return tuple(inputs[k] for k in audible_indices(inputs) if k != selected_input)


def pivot_source(pivot: Input | None) -> Source | None:
    """The selected input without its amplitude and onset."""
    return None if pivot is None else source_of(pivot)


def pivot_delay(pivot: Input | None, sample_rate_hz: float) -> int:
    """Samples before the selected input starts."""
    return 0 if pivot is None else sample_count(pivot.onset_s, sample_rate_hz)


def pivot_delayed_drive(
    pivot_drive: Complexes | None, pivot_delay: int, n_fft: int | None
) -> Complexes | None:
    """Spectrum of what the selected input plays, from its onset on, (n_bins,)."""
    if pivot_drive is None or n_fft is None:
        return None
    return delayed(pivot_drive, pivot_delay, n_fft)


def pivot_weight(pivot: Input | None, pivot_gain: float) -> float:
    """What the unit field of the selected input is multiplied with."""
    return 0.0 if pivot is None else pivot.amplitude * pivot_gain


def response_samples(stimulus_samples: int) -> int:
    """Samples of the response: the stimulus and one response more."""
    return stimulus_samples + N_TAPS - 1


def products_needed(axes: Axes, method: Method) -> bool:
    """Whether levels need the products of different axes."""
    return needs_products(axes, method)


def n_fft(response_samples: int, audible: tuple[Input, ...]) -> int | None:
    """Length of transforms; None where the scene is too long to be transformed at once."""
    return length_at_once(response_samples, len({one.location for one in audible}))


def others_part(
    others_spectrum: Complexes | None, others_felt: Booleans, n_fft: int | None
) -> Part | None:
    """Field of all inputs but the selected one, to be brought back to time."""
    if others_spectrum is None or n_fft is None:
        return None
    return Part(lambda channels: rows_of(others_spectrum, channels), n_fft, others_felt)


def others_moments(
    others_spectrum: Complexes | None, n_fft: int | None, products_needed: bool
) -> Moments | None:
    """Moments of all inputs but the selected one."""
    if others_spectrum is None or n_fft is None:
        return None
    return moments_of(others_spectrum, n_fft, products=products_needed)


def own_forms(pivot_response: ResponseSpectrum | None) -> OwnForms | None:
    """What moments of the selected input follow from, whatever it plays."""
    return None if pivot_response is None else OwnForms(pivot_response.values)


def cross_forms(others_spectrum: Complexes | None, own_forms: OwnForms | None) -> CrossForms | None:
    """What moments between it and all others follow from, whatever it plays."""
    if others_spectrum is None or own_forms is None:
        return None
    return CrossForms(others_spectrum, own_forms)


def pivot_moments(
    own_forms: OwnForms | None,
    pivot_drive: Complexes | None,
    n_fft: int | None,
    products_needed: bool,
) -> Moments | None:
    """Moments of the selected input at amplitude 1, before any gain; its onset has no part."""
    if own_forms is None or pivot_drive is None or n_fft is None:
        return None
    return own_forms.moments(pivot_drive, n_fft, products=products_needed)


def cross_moments(
    cross_forms: CrossForms | None,
    pivot_delayed_drive: Complexes | None,
    n_fft: int | None,
    products_needed: bool,
) -> Moments | None:
    """Moments between the selected input and all others."""
    if cross_forms is None or pivot_delayed_drive is None or n_fft is None:
        return None
    return cross_forms.moments(pivot_delayed_drive, n_fft, products=products_needed)


def moments(
    others_moments: Moments | None,
    cross_moments: Moments | None,
    pivot_moments: Moments | None,
    pivot_weight: float,
    cross_forms: CrossForms | None,
    pivot_delayed_drive: Complexes | None,
    n_fft: int | None,
    products_needed: bool,
    streamed_field: StreamedField | None,
    stop: Stop,
) -> Moments:
    """Moments of the whole field.

    Where the terms of an axis cancel, the moments are computed again from the sum of the fields, so
    that no digits are lost.
    """
    if streamed_field is not None:
        return streamed_field.moments(stop)
    if pivot_moments is None or pivot_weight == 0.0:
        return others_moments or _silence()
    if others_moments is None or cross_moments is None:
        return Moments(pivot_weight**2 * pivot_moments.second, pivot_weight * pivot_moments.first)
    total, cancelled = combined(others_moments, cross_moments, pivot_moments, pivot_weight)
    if cancelled.any() and cross_forms and pivot_delayed_drive is not None and n_fft is not None:
        unit = cross_forms.own.values[cancelled] * pivot_delayed_drive
        field = cross_forms.others[cancelled] + pivot_weight * unit
        again = moments_of(field, n_fft, products=products_needed)
        total.second[cancelled], total.first[cancelled] = again.second, again.first
    return total


def directions(
    moments: Moments, axes: Axes, method: Method, response_samples: int
) -> Floats | None:
    """Vector that each output is projected on, (72 outputs, n_axes); None: magnitude."""
    return directions_of(moments, axes, method, response_samples)


def output_rms(
    moments: Moments,
    directions: Floats | None,
    axes: Axes,
    response_samples: int,
    others_spectrum: Complexes | None,
    pivot_response: ResponseSpectrum | None,
    pivot_delayed_drive: Complexes | None,
    pivot_weight: float,
    n_fft: int | None,
) -> Floats:
    """RMS over the whole response of the projected signals, (72 outputs,), in m/s².

    Where the axes of an output cancel in its projection, its energy is taken from the projected
    spectrum instead.
    """
    energy, cancelled = energies(moments, directions, axes)
    if directions is not None and n_fft is not None and cancelled.any():
        rows = np.ix_(np.flatnonzero(cancelled), np.array(axis_numbers(axes)))
        field = np.zeros((int(cancelled.sum()), len(axes), n_fft // 2 + 1), np.complex128)
        if others_spectrum is not None:
            field += others_spectrum[rows]
        if pivot_response is not None and pivot_delayed_drive is not None:
            field += pivot_response.values[rows] * pivot_delayed_drive * pivot_weight
        projected = np.einsum("oa,oaf->of", directions[cancelled], field)
        energy[cancelled] = energies_of(projected, n_fft)
    return np.sqrt(energy / response_samples)


def output_levels_db(output_rms: Floats) -> Floats:
    """RMS level of each output, (72,), in dB re 1 m/s²; silence is -200 dB."""
    return decibels(output_rms)


RULES = (
    audible,
    pivot,
    others,
    pivot_source,
    pivot_delay,
    pivot_delayed_drive,
    pivot_weight,
    response_samples,
    n_fft,
    products_needed,
    others_part,
    others_moments,
    own_forms,
    cross_forms,
    pivot_moments,
    cross_moments,
    moments,
    directions,
    output_rms,
    output_levels_db,
)


def _silence() -> Moments:
    return Moments(np.zeros((N_OUTPUTS, N_AXES, N_AXES)), np.zeros((N_OUTPUTS, N_AXES)))
