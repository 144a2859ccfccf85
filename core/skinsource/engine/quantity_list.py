"""The quantities that scripts and notebooks use, with unit and shape."""

from typing import NamedTuple

from skinsource.engine.quantities import new_graph


class Quantity(NamedTuple):
    """A quantity of `skinsource.evaluate`.

    Attributes
    ----------
    name
        Its name.
    unit
        Unit of its values; empty where they have none.
    shape
        Names of its dimensions: ``n_outputs``, ``n_selected`` (outputs of the view), ``n_axes``,
        ``n_times``, ``n_bins`` (frequencies), ``n_windows``, ``rows`` and ``columns`` (of the map);
        empty for a number.  Spectra are a pair: frequencies, and values of this shape.
    about
        What it is.
    """

    name: str
    unit: str
    shape: tuple[str, ...]
    about: str


_LEVEL, _ACCELERATION, _ABOVE = "dB re 1 m/s²", "m/s²", "dB above threshold"
_OUTPUTS, _MAP, _WINDOWS = "n_outputs", ("rows", "columns"), "n_windows"
_SELECTED, _AXES, _TIMES, _BINS = "n_selected", "n_axes", "n_times", "n_bins"
#: Unit and shape by name.
_LISTED: dict[str, tuple[str, tuple[str, ...]]] = {
    "output_levels_db": (_LEVEL, (_OUTPUTS,)),
    "output_rms": (_ACCELERATION, (_OUTPUTS,)),
    "record_rms": (_ACCELERATION, (_OUTPUTS,)),
    "axis_levels_db": (_LEVEL, (_AXES, _OUTPUTS)),
    "axis_record_rms": (_ACCELERATION, (_AXES, _OUTPUTS)),
    "above_noise_db": ("dB", (_OUTPUTS,)),
    "output_noise_rms": (_ACCELERATION, (_OUTPUTS,)),
    "sensation_db": (_ABOVE, (_OUTPUTS,)),
    "surface_levels_db": (_LEVEL, _MAP),
    "surface_sensation_db": (_ABOVE, _MAP),
    "axis_surface_levels_db": (_LEVEL, (_AXES, *_MAP)),
    "selected_traces": (_ACCELERATION, (_SELECTED, _TIMES)),
    "axis_traces": (_ACCELERATION, (_SELECTED, _AXES, _TIMES)),
    "response_time_s": ("s", (_TIMES,)),
    "selected_spectra": (_ACCELERATION, (_SELECTED, _BINS)),
    "selected_axis_spectra": (_ACCELERATION, (_SELECTED, _AXES, _BINS)),
    "selected_peak_spectra": (_ACCELERATION, (_SELECTED, _BINS)),
    "selected_axis_peak_spectra": (_ACCELERATION, (_SELECTED, _AXES, _BINS)),
    "rms_of_windows": (_ACCELERATION, (_WINDOWS, _OUTPUTS)),
    "levels_of_windows_db": (_LEVEL, (_WINDOWS, _OUTPUTS)),
    "noise_rms_of_windows": (_ACCELERATION, (_WINDOWS, _OUTPUTS)),
    "surface_of_windows_db": (_LEVEL, (_WINDOWS, *_MAP)),
    "sample_rate_hz": ("Hz", ()),
    "stimulus_samples": ("", ()),
    "response_samples": ("", ()),
    "stimulus_start_s": ("s", ()),
    "fastest_probe_m_per_s": ("m/s", ()),
}


def quantities() -> tuple[Quantity, ...]:
    """Return the quantities that `skinsource.evaluate` and `skinsource.result` compute.

    Besides these, which are numbers and arrays, `skinsource.evaluate` knows all values that the
    studio computes.

    Examples
    --------
    >>> import skinsource as ss
    >>> for quantity in ss.quantities()[:3]:
    ...     print(quantity.name, quantity.unit, quantity.shape)
    output_levels_db dB re 1 m/s² ('n_outputs',)
    output_rms m/s² ('n_outputs',)
    record_rms m/s² ('n_outputs',)
    """
    rules = new_graph().rules
    return tuple(
        Quantity(name, unit, shape, (rules[name].__doc__ or "").partition("\n")[0])
        for name, (unit, shape) in _LISTED.items()
    )
