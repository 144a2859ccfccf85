"""Rules from parts of a scene to traces and spectra of the outputs that are looked at."""

import numpy as np

from skinsource.job import Stop
from skinsource.projection import Axes, Method, axis_numbers, magnitude
from skinsource.rendering.field import Field, one_by_one
from skinsource.rendering.moments import Moments, without_main_axis
from skinsource.rendering.part import Part
from skinsource.rendering.streaming import StreamedField
from skinsource.rendering.transforms import Complexes, Floats, forward
from skinsource.spectra import one_sided_magnitude


def field(
    response_samples: int,
    others_part: Part | None,
    pivot_part: Part | None,
    pivot_weight: float,
    pivot_delay: int,
    streamed_field: StreamedField | None,
) -> Field:
    """The whole field, for the outputs that are looked at."""
    return Field(
        n_times=response_samples,
        others=others_part,
        pivot=pivot_part,
        weight=pivot_weight,
        delay_samples=pivot_delay,
        streamed=streamed_field,
    )


def axis_traces(field: Field, outputs: tuple[int, ...], axes: Axes, stop: Stop) -> Floats:
    """Acceleration of the selected outputs, (n_selected, n_axes, n_times), in m/s²."""
    return field.traces(outputs, axis_numbers(axes), stop)


def selected_directions(directions: Floats | None, outputs: tuple[int, ...]) -> Floats | None:
    """Vector that each selected output is projected on, (n_selected, n_axes); None: magnitude."""
    return None if directions is None else directions[[output - 1 for output in outputs]]


def selected_without_main_axis(
    moments: Moments,
    outputs: tuple[int, ...],
    axes: Axes,
    method: Method,
    response_samples: int,
) -> tuple[int, ...]:
    """Selected outputs that are projected on a main axis they do not have."""
    without = without_main_axis(moments, axes, method, response_samples)
    return tuple(output for output in outputs if without[output - 1])


def selected_traces(axis_traces: Floats, selected_directions: Floats | None) -> Floats:
    """Projected acceleration of the selected outputs, (n_selected, n_times), in m/s²."""
    if selected_directions is None:
        return magnitude(axis_traces)
    return np.einsum("oa,oat->ot", selected_directions, axis_traces)


def axis_spectra(field: Field, outputs: tuple[int, ...], axes: Axes, stop: Stop) -> Complexes:
    """Transforms of `axis_traces` over exactly their samples, (n_selected, n_axes, n_bins)."""
    return field.transforms(outputs, axis_numbers(axes), stop)


def selected_spectra(
    field: Field,
    outputs: tuple[int, ...],
    axes: Axes,
    selected_directions: Floats | None,
    selected_traces: Floats,
    sample_rate_hz: float,
    stop: Stop,
) -> tuple[Floats, Floats]:
    """Frequencies, (n_bins,), in Hz, and magnitudes, (n_selected, n_bins), in m/s².

    A projection is linear in its axes, so their transforms serve it, whatever its direction; a
    magnitude is not, and the traces of a long scene are at hand: those are transformed.
    """
    if field.streamed is not None:
        transforms = one_by_one(selected_traces, stop)
    elif selected_directions is None:
        transforms = forward(selected_traces, field.n_times)
    else:
        of_axes = field.transforms(outputs, axis_numbers(axes))
        transforms = np.einsum("oa,oaf->of", selected_directions, of_axes)
    return one_sided_magnitude(transforms, field.n_times, sample_rate_hz)


RULES = (
    field,
    axis_traces,
    selected_directions,
    selected_without_main_axis,
    selected_traces,
    axis_spectra,
    selected_spectra,
)
