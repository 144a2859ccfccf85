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
from skinsource.design import Design
from skinsource.graph import Graph
from skinsource.limb import Limb, LimbMap
from skinsource.rendering import rules, trace_rules
from skinsource.rendering.renderer import Renderer
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


def surface(limb_data: Limb) -> SurfaceOperator:
    """Operator from outputs to the pixels of the map."""
    return surface_operator(limb_data)


def surface_levels_db(surface: SurfaceOperator, output_levels_db: Floats) -> Floats:
    """RMS level over the back of hand and arm, (rows, columns), dB; NaN outside the outline."""
    return surface.interpolate(output_levels_db)


def response_time_s(response_samples: int, sample_rate_hz: float, delay_removed: bool) -> Floats:
    """Sampling instants of the response, (n_times,), in seconds."""
    shift_s = PRE_TRIGGER_DELAY_S if delay_removed else 0.0
    return np.arange(response_samples) / sample_rate_hz - shift_s


#: Rules without memory; `skinsource.rendering` holds those from inputs to levels and traces.
RULES: tuple[Callable[..., Any], ...] = (
    limb_data,
    limb_map,
    sample_rate_hz,
    surface,
    surface_levels_db,
    response_time_s,
    *rules.RULES,
    *trace_rules.RULES,
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
    return Graph(*RULES, *Renderer().rules())
