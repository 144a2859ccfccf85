"""Which figure each scene has."""

from collections.abc import Callable

from skinsource.figures.check_figures import (
    output_over_input,
    straightness,
    strengths,
    superposition,
)
from skinsource.figures.map_figures import maps_each_relative, maps_in_one_scale, maps_of_axes
from skinsource.figures.moving_figures import tone_frames, train_windows
from skinsource.figures.row_figures import (
    axis_spectra,
    overlaid_traces,
    own_traces,
    pulse_traces,
    smoothed_axis_spectra,
)
from skinsource.figures.sheet import Drawn
from skinsource.scenes import OpenedScene

#: By the name of the scene: what draws its figure.
FIGURES: dict[str, Callable[[OpenedScene], Drawn]] = {
    "1C": pulse_traces,
    "1D": axis_spectra,
    "1E": maps_of_axes,
    "1F": maps_each_relative,
    "1G": maps_each_relative,
    "2A": own_traces,
    "2B": maps_in_one_scale,
    "2C": own_traces,
    "2D": smoothed_axis_spectra,
    "2E": maps_in_one_scale,
    "2F": overlaid_traces,
    "2H": train_windows,
    "4A": tone_frames,
    "4B": own_traces,
    "5A": strengths,
    "5B": strengths,
    "5D": output_over_input,
    "5E": straightness,
    "5F": superposition,
}
