"""Rules from the vibration to its levels along each axis by itself, whatever axes are chosen."""

import numpy as np

from skinsource.analysis_rules import noise_rules
from skinsource.arrays import Floats
from skinsource.job import Stop
from skinsource.limb import Limb
from skinsource.loudest_window import Span
from skinsource.rendering import level_rules
from skinsource.rendering.moments import Moments
from skinsource.rendering.projecting import Projection
from skinsource.rendering.streaming import StreamedVibration
from skinsource.rendering.total_spectrum import TotalSpectrum
from skinsource.surface import SurfaceOperator


def single_axes(limb_data: Limb) -> tuple[Projection, ...]:
    """Each axis that the limb measures along, by itself."""
    along = np.ones((limb_data.n_outputs, 1))
    return tuple(Projection((number,), along) for number in range(limb_data.n_axes))


def axis_record_rms(
    single_axes: tuple[Projection, ...],
    moments: Moments,
    total_spectrum: TotalSpectrum | None,
    record_samples: int,
) -> tuple[Floats, ...]:
    """RMS over the whole record along each axis, (n_outputs,) each, in m/s²."""
    return tuple(
        level_rules.record_rms(moments, one, total_spectrum, record_samples) for one in single_axes
    )


def axis_levels_db(
    single_axes: tuple[Projection, ...],
    axis_record_rms: tuple[Floats, ...],
    span: Span,
    limb_data: Limb,
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    stop: Stop,
) -> tuple[Floats, ...]:
    """RMS level along each axis, (n_outputs,) each, in dB re 1 m/s²: as if it alone were chosen."""
    found = []
    for one, record in zip(single_axes, axis_record_rms, strict=True):
        loudest = level_rules.loudest_rms(
            span, limb_data, one, total_spectrum, streamed_vibration, stop
        )
        found.append(level_rules.output_levels_db(level_rules.output_rms(record, loudest)))
    return tuple(found)


def axis_surface_levels_db(
    surface: SurfaceOperator, axis_levels_db: tuple[Floats, ...]
) -> tuple[Floats, ...]:
    """The same over the back of hand and arm, (rows, columns) each; NaN outside the outline."""
    return tuple(surface.interpolate(levels) for levels in axis_levels_db)


def axis_above_noise_db(
    single_axes: tuple[Projection, ...],
    axis_record_rms: tuple[Floats, ...],
    noise_energy: Floats | None,
    record_samples: int,
) -> tuple[Floats | None, ...]:
    """Level along each axis above that of its noise, (n_outputs,) each, dB; None: not known."""
    return tuple(
        noise_rules.above_noise_db(
            record, noise_rules.output_noise_rms(noise_energy, one, record_samples)
        )
        for one, record in zip(single_axes, axis_record_rms, strict=True)
    )


RULES = (
    single_axes,
    axis_record_rms,
    axis_levels_db,
    axis_surface_levels_db,
    axis_above_noise_db,
)
