"""What is looked at: an immutable value, saved with the design but never undone."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from skinsource.errors import InvalidInputError
from skinsource.limb import N_OUTPUTS
from skinsource.projection import AXES, METHODS, Axes, Method

MapStyle = Literal["interpolated", "sensors"]
Layout = Literal["overlaid", "stacked"]
MAP_STYLES: tuple[MapStyle, ...] = get_args(MapStyle)
LAYOUTS: tuple[Layout, ...] = get_args(Layout)

Range = tuple[float, float]

# Beyond all that can be looked at, and below what a float can hold.
_FAR = 1e300


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """What is looked at.

    Attributes
    ----------
    axes, method
        See `skinsource.project_axes`.
    outputs
        Selected outputs, 1 to 72, in the order in which they were selected.
    selected_input
        Index of the selected input, or ``None``.
    map_style, sensors_shown
        Interpolated map or sensors only; whether sensors are marked on the interpolated map.
    map_range_db
        Levels of the ends of the colour bar; ``None``: the loudest output and 50 dB below it.
    traces_layout, spectra_layout
        ``"overlaid"`` or ``"stacked"``.
    log_frequency, log_magnitude
        Logarithmic axes of the spectra.
    delay_removed
        Whether time axes are shifted by the pre-trigger delay of the responses.
    time_range_s, frequency_range_hz
        Zoom of the plots; ``None``: everything.
    """

    axes: Axes = "xyz"
    method: Method = "pca"
    outputs: tuple[int, ...] = (29, 52)
    selected_input: int | None = 0
    map_style: MapStyle = "interpolated"
    sensors_shown: bool = True
    map_range_db: Range | None = None
    traces_layout: Layout = "overlaid"
    spectra_layout: Layout = "overlaid"
    log_frequency: bool = False
    log_magnitude: bool = True
    delay_removed: bool = False
    time_range_s: Range | None = None
    frequency_range_hz: Range | None = None

    def __post_init__(self) -> None:
        _check_member("axes", self.axes, AXES)
        _check_member("method", self.method, METHODS)
        _check_member("map_style", self.map_style, MAP_STYLES)
        _check_member("traces_layout", self.traces_layout, LAYOUTS)
        _check_member("spectra_layout", self.spectra_layout, LAYOUTS)
        if not (
            isinstance(self.outputs, tuple)
            and all(isinstance(output, int) and 1 <= output <= N_OUTPUTS for output in self.outputs)
            and len(set(self.outputs)) == len(self.outputs)
        ):
            raise InvalidInputError(
                f"outputs are {self.outputs}, expected different whole numbers 1 to {N_OUTPUTS}"
            )
        for name in ("sensors_shown", "log_frequency", "log_magnitude", "delay_removed"):
            if not isinstance(getattr(self, name), bool):
                raise InvalidInputError(
                    f"{name} is {getattr(self, name)!r}, expected True or False"
                )
        if self.selected_input is not None and not (
            isinstance(self.selected_input, int) and 0 <= self.selected_input < 2**31
        ):
            raise InvalidInputError(
                f"selected_input is {self.selected_input!r}, expected None or 0, 1, 2, …"
            )
        for name in ("map_range_db", "time_range_s", "frequency_range_hz"):
            object.__setattr__(self, name, _checked_range(name, getattr(self, name)))


def _check_member(name: str, value: str, allowed: tuple[str, ...]) -> None:
    if value not in allowed:
        raise InvalidInputError(f"{name} is {value!r}, expected one of {', '.join(allowed)}")


def _checked_range(name: str, value: Range | None) -> Range | None:
    if value is None:
        return None
    if isinstance(value, tuple) and len(value) == 2 and all(map(_is_ordinary, value)):
        low, high = float(value[0]), float(value[1])
        if low < high:
            return low, high
    raise InvalidInputError(f"{name} is {value!r}, expected None or two finite numbers, low < high")


def _is_ordinary(end: object) -> bool:
    return isinstance(end, int | float | np.floating) and bool(-_FAR < end < _FAR)
