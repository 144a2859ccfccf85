"""Rules from vibrations to levels.

Levels of the whole record follow from moments, and moments from spectra: no channel is transformed
back to time.  Moments are sums of three terms, so that a changed amplitude of the edited voice
costs three products.
"""

from dataclasses import dataclass

import numpy as np

from skinsource.base.conventions import Axes, Booleans, Complexes, Floats
from skinsource.base.conventions import axis_numbers as numbers_of
from skinsource.base.decibels import decibels
from skinsource.base.job import Stop
from skinsource.engine.moments import (
    CrossMatrix,
    Moments,
    OwnMatrix,
    Projection,
    combined,
    directions_of,
    energies,
    energies_of,
    moments_of,
    needs_products,
)
from skinsource.engine.spectra import ResponseSpectrum, TotalSpectrum
from skinsource.engine.streaming import StreamedVibration, loudest_energies
from skinsource.limbs.limb import Limb
from skinsource.signals.loudest_window import Span, window_samples
from skinsource.signals.projection import Method


@dataclass(frozen=True, slots=True, eq=False)
class SummedMoments:
    """Moments of a sum, and the outputs, (n_outputs,), where too many digits cancelled."""

    moments: Moments
    cancelled: Booleans


def axis_numbers(limb_data: Limb, axes: Axes) -> tuple[int, ...]:
    """Where the chosen axes are among those that the limb measures along."""
    return numbers_of(axes, limb_data.axes)


def products_needed(axis_numbers: tuple[int, ...], method: Method) -> bool:
    """Whether levels need the products of different axes."""
    return needs_products(axis_numbers, method)


def others_moments(
    others_spectrum: Complexes | None, n_fft: int | None, products_needed: bool
) -> Moments | None:
    """Moments of the vibration by the other voices."""
    if others_spectrum is None or n_fft is None:
        return None
    return moments_of(others_spectrum, n_fft, products=products_needed)


def own_matrix(edited_response: ResponseSpectrum | None, products_needed: bool) -> OwnMatrix | None:
    """What moments of the edited voice follow from, whatever it plays."""
    return None if edited_response is None else OwnMatrix(edited_response.values, products_needed)


def cross_matrix(
    others_spectrum: Complexes | None, own_matrix: OwnMatrix | None
) -> CrossMatrix | None:
    """What moments between it and all others follow from, whatever it plays."""
    if others_spectrum is None or own_matrix is None:
        return None
    return CrossMatrix(others_spectrum, own_matrix)


def edited_moments(
    own_matrix: OwnMatrix | None,
    edited_spectrum: Complexes | None,
    n_fft: int | None,
) -> Moments | None:
    """Moments by the edited voice at amplitude 1, before any gain; its onset has no part."""
    if own_matrix is None or edited_spectrum is None or n_fft is None:
        return None
    return own_matrix.moments(edited_spectrum, n_fft)


def cross_moments(
    cross_matrix: CrossMatrix | None,
    edited_delayed_spectrum: Complexes | None,
    n_fft: int | None,
) -> Moments | None:
    """Moments between the edited voice and all others."""
    if cross_matrix is None or edited_delayed_spectrum is None or n_fft is None:
        return None
    return cross_matrix.moments(edited_delayed_spectrum, n_fft)


def summed_moments(
    limb_data: Limb,
    others_moments: Moments | None,
    cross_moments: Moments | None,
    edited_moments: Moments | None,
    edited_weight: float,
) -> SummedMoments:
    """Moments of all voices, as a sum of three terms."""
    sound = np.zeros(limb_data.n_outputs, bool)
    if edited_moments is None or edited_weight == 0.0:
        return SummedMoments(others_moments or _silence(limb_data), sound)
    if others_moments is None or cross_moments is None:
        second, first = edited_moments.second, edited_moments.first
        return SummedMoments(Moments(edited_weight**2 * second, edited_weight * first), sound)
    return SummedMoments(*combined(others_moments, cross_moments, edited_moments, edited_weight))


def moments(
    summed_moments: SummedMoments,
    total_spectrum: TotalSpectrum | None,
    products_needed: bool,
    streamed_vibration: StreamedVibration | None,
    stop: Stop,
) -> Moments:
    """Moments of the vibration by all voices.

    Where the terms of an axis cancel, the moments are computed from the sum of the vibrations, so
    that no digits are lost.
    """
    if streamed_vibration is not None:
        return streamed_vibration.moments(stop)
    total, cancelled = summed_moments.moments, summed_moments.cancelled
    if total_spectrum is None or not cancelled.any():
        return total
    every_axis = tuple(range(total_spectrum.shape[1]))
    rows = total_spectrum.rows(np.flatnonzero(cancelled), every_axis)
    again = moments_of(rows, total_spectrum.n_fft, products=products_needed)
    second, first = total.second.copy(), total.first.copy()
    second[cancelled], first[cancelled] = again.second, again.first
    return Moments(second, first)


def projection(
    moments: Moments, axis_numbers: tuple[int, ...], method: Method, response_samples: int
) -> Projection:
    """How the axes of each output become one signal."""
    directions = directions_of(moments, axis_numbers, method, response_samples)
    return Projection(axis_numbers, directions)


def record_rms(
    moments: Moments,
    projection: Projection,
    total_spectrum: TotalSpectrum | None,
    record_samples: int,
) -> Floats:
    """RMS over the whole record of the projected signals, (n_outputs,), in m/s².

    Where the axes of an output cancel in its projection, its energy is computed from the projected
    spectrum.
    """
    energy, cancelled = energies(moments, projection.directions, projection.axis_numbers)
    if total_spectrum is not None and cancelled.any():
        rows = np.flatnonzero(cancelled)
        spectra = total_spectrum.rows(rows, projection.axis_numbers)
        projected = projection.at(rows).spectra(spectra)
        energy[cancelled] = energies_of(projected, total_spectrum.n_fft)
    return np.sqrt(energy / record_samples)


def loudest_rms(
    span: Span,
    limb_data: Limb,
    projection: Projection,
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    stop: Stop,
) -> Floats | None:
    """RMS of the loudest window of each projected signal, (n_outputs,); None: not asked for."""
    if span != "loudest":
        return None
    energy = loudest_energies(total_spectrum, streamed_vibration, projection, limb_data, stop)
    return np.sqrt(energy / window_samples(limb_data.sample_rate_hz))


def output_rms(record_rms: Floats, loudest_rms: Floats | None) -> Floats:
    """RMS of the projected signal of each output, (n_outputs,), in m/s²."""
    return record_rms if loudest_rms is None else loudest_rms


def output_levels_db(output_rms: Floats) -> Floats:
    """RMS level of each output, (n_outputs,), in dB re 1 m/s²; silence is -200 dB."""
    return decibels(output_rms)


def _silence(limb: Limb) -> Moments:
    shape = limb.n_outputs, limb.n_axes
    return Moments(np.zeros((*shape, limb.n_axes)), np.zeros(shape))
