"""Every quantity that the studio can show.  To add one, write one function in a file of rules.

The name of a function is the quantity that it computes; its parameters are the quantities that it
needs.  `sources` gives the fields of design and view that numbers depend on.
"""

from collections.abc import Callable
from functools import partial
from inspect import isfunction
from types import ModuleType
from typing import Any

import numpy as np

from skinsource.base.conventions import Band, Floats
from skinsource.base.job import Stop
from skinsource.design.design import Design, Input, View, audible_indices
from skinsource.design.panel_settings import SpectrogramSettings, settings_of
from skinsource.design.signal_path import Voice, placed_signal_path
from skinsource.engine import (
    analysis_rules,
    level_rules,
    time_rules,
    trace_rules,
    vibration_rules,
    voice_rules,
    window_rules,
)
from skinsource.engine.analysis_rules import place_noise
from skinsource.engine.gains import EngineMemory
from skinsource.engine.graph import Graph
from skinsource.engine.shared import Shared
from skinsource.engine.time_rules import block_of
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.own_limbs import facts_of
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.perception.thresholds import PerceptionSettings


def voices(
    remembered: EngineMemory, inputs: tuple[Input, ...], sample_rate_hz: float
) -> tuple[Voice, ...]:
    """What sounds where, from when, how strong, through what signal path: one for each input."""
    audible = set(audible_indices(inputs))
    made_from = {track.id: (track.clips, track.gain_curve, sample_rate_hz) for track in inputs}
    paths = remembered.signal_paths.of(made_from, placed_signal_path)
    return tuple(
        Voice(
            id=track.id,
            location=track.location,
            start=start,
            amplitude=track.amplitude,
            audible=index in audible,
            signal_path=signal_path,
        )
        for index, (track, (start, signal_path)) in enumerate(zip(inputs, paths, strict=True))
    )


def clip_waveforms(
    remembered: EngineMemory, inputs: tuple[Input, ...], sample_rate_hz: float, stop: Stop
) -> tuple[tuple[Floats | None, ...], ...]:
    """Samples of each clip of each input, muted or not, after its effects and before its gain.

    None for a clip that cannot be sampled.
    """
    made_from = {track.id: (track.clips, sample_rate_hz) for track in inputs}
    samples_of = partial(remembered.drives.clips.of_clips, stop=stop)
    return tuple(remembered.clip_waveforms.of(made_from, samples_of))


def limb_map(limb_data: Limb) -> LimbMap:
    """Outline of the limb, and positions on it."""
    return limb_data.map


def sample_rate_hz(limb_data: Limb) -> float:
    """Sample rate of drives and responses."""
    return limb_data.sample_rate_hz


def band_hz(limb_data: Limb) -> Band | None:
    """Frequencies at which the limb was measured; None where they are not known."""
    return limb_data.band_hz


def surface_levels_db(surface: SurfaceOperator, output_levels_db: Floats) -> Floats:
    """RMS level over the back of hand and arm, (rows, columns), dB; NaN outside the outline."""
    return surface.interpolate(output_levels_db)


def response_time_s(response_samples: int, driven_limb: Limb, delay_removed: bool) -> Floats:
    """Sampling instants of the response, (n_times,), in seconds."""
    shift_s = driven_limb.pre_trigger_delay_s if delay_removed else 0.0
    first = driven_limb.lead_samples
    return np.arange(-first, response_samples - first) / driven_limb.sample_rate_hz - shift_s


def _rules_of(module: ModuleType, *helpers: object) -> list[Callable[..., Any]]:
    """Return the functions that a module defines for others, but for its ``helpers``."""
    return [
        rule
        for name, rule in vars(module).items()
        if isfunction(rule) and rule.__module__ == module.__name__
        if not name.startswith("_") and rule not in helpers
    ]


#: All rules but those of `skinsource.engine.shared.Shared`.
RULES: tuple[Callable[..., Any], ...] = (
    voices,
    clip_waveforms,
    limb_map,
    sample_rate_hz,
    band_hz,
    surface_levels_db,
    response_time_s,
    *_rules_of(voice_rules),
    *_rules_of(vibration_rules),
    *_rules_of(level_rules),
    *_rules_of(trace_rules),
    *_rules_of(time_rules, block_of),
    *_rules_of(analysis_rules, place_noise),
    *_rules_of(window_rules),
)


def sources(
    design: Design, view: View, *, match_gain: float = 1.0, leave_out_unplayable: bool = False
) -> dict[str, Any]:
    """Return the given quantities, by name: all fields that some quantity depends on.

    Parameters
    ----------
    design, view
        The design that is predicted, and how it is viewed.
    match_gain
        Factor on the vibration, see `View.match_gain`; drives do not have it.
    leave_out_unplayable
        Whether inputs that cannot be played are left out and listed in ``unplayable_inputs``;
        otherwise they are an error.
    """
    return {
        "limb": design.limb,
        # A limb that is imported anew under the same name is another limb.
        "limb_digest": design.limb_digest or facts_of(design.limb).digest,
        "limb_mirrored": facts_of(design.limb).mirrored,
        "inputs": design.inputs,
        "scaling": design.scaling,
        "actuation": design.actuated,
        "chosen_actuation": design.actuation,
        "rig": design.rig,
        "match_gain": match_gain,
        "leave_out_unplayable": leave_out_unplayable,
        "axes": view.axes,
        "method": view.method,
        "span": view.span,
        "outputs": view.outputs,
        "selected_input": view.selected_input,
        "edited_input": view.selected_input,
        "delay_removed": view.delay_removed,
        "moving_block": block_of(view.playhead_s),
        "spectrogram_settings": settings_of(view, "spectrogram", SpectrogramSettings),
        "perception_settings": settings_of(view, "perception", PerceptionSettings),
        "windows_cut": view.windows_cut,
        "window_count": view.window_count,
        "window_s": view.window_s,
    }


def new_graph(shared: Shared | None = None) -> Graph:
    """Return a new graph of all quantities.

    Parameters
    ----------
    shared
        Values that it shares with other graphs of its thread; by default none.
    """
    return Graph(*RULES, *(shared or Shared()).rules())


def graphs_that_share() -> Callable[[], Graph]:
    """Return a function that makes graphs for one thread, which share values."""
    return partial(new_graph, Shared())
