"""What the spectra show of results: which quantity, in which unit, and what is said of it."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.base.published import Band
from skinsource.design.comparing import match_words
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.loudest_window import HOLD_WINDOW_S, LOUDEST_WINDOW_S, Span
from skinsource.signals.spectra import MEAN_OF_BINS, mean_of_bins
from skinsource_gui.panels.spectra.settings import SpectraSettings
from skinsource_gui.widgets.plot.curves import LEVEL_WORDS, Curves, output_names
from skinsource_gui.widgets.plot.provenance import heading_of, lines_later
from skinsource_gui.widgets.plot.ranges import Kind

_HOLD, _LOUDEST = (f"{one * 1e3:.0f} ms" for one in (HOLD_WINDOW_S, LOUDEST_WINDOW_S))
# What the height of a curve means, longest first.
_SCALINGS = {
    "record": ("amplitude over the whole record", "over the whole record", "whole record"),
    "loudest": (
        # Levels say another time, and nobody would guess why.
        f"amplitude in the loudest {_HOLD} of each frequency, which tell "
        f"{1 / HOLD_WINDOW_S:.0f} Hz apart; the {_LOUDEST} of levels would tell "
        f"{1 / LOUDEST_WINDOW_S:.0f} Hz",
        f"amplitude in the loudest {_HOLD} of each frequency",
        f"loudest {_HOLD}",
        "loudest",
    ),
}
_QUANTITIES = {"record": "selected_spectra", "loudest": "selected_peak_spectra"}
_OF_AXES = {"record": "selected_axis_spectra", "loudest": "selected_axis_peak_spectra"}
_RECTIFIED = (
    "spectrum of a magnitude: rectified, shows doubled frequencies",
    "of a magnitude: rectified, doubled frequencies",
    "rectified: doubled frequencies",
    "rectified",
)
_RELATIVE_LEVEL_WORDS = "dB re its peak"
_AVERAGED = f"mean of {MEAN_OF_BINS} bins"


def quantity_of(settings: SpectraSettings, span: Span) -> str:
    """Name of what is drawn."""
    return (_OF_AXES if settings.layout == "axes" else _QUANTITIES)[span]


def curves_of(results: Mapping[str, Any], settings: SpectraSettings) -> Curves:
    """The curves of ``results``, which hold what `quantity_of` names."""
    span, limb = results["span"], facts_of(results["limb"])
    frequency_hz, magnitude = results[quantity_of(settings, span)]
    each_axis = settings.layout == "axes"
    axes = tuple(limb.axes) if each_axis else ()
    # (n_outputs, n_curves of each, n_bins)
    drawn = magnitude if each_axis else magnitude[:, None]
    if settings.averaged:
        drawn = mean_of_bins(drawn, MEAN_OF_BINS)
    first, seen = (
        [f"spectrum: {_SCALINGS[span][-3]}{_averaged_words(settings, frequency_hz)}"],
        None,
    )
    peaks: tuple[float, ...] = ()
    if settings.relative:
        within = _inside(frequency_hz, limb.band_hz)
        found = drawn[..., within].max(axis=(-2, -1))
        peaks = tuple(found.tolist())
        # Silence has no peak to be relative to.
        drawn = drawn / np.where(found > 0.0, found, 1.0)[:, None, None]
        measured = _drawn(drawn[..., within], settings)
        seen = float(measured.min()), float(measured.max())
        first.append("each output relative to its largest magnitude in the measured band")
    columns = settings.relative and settings.log_magnitude
    return Curves(
        x=frequency_hz,
        y=_drawn(drawn, settings).reshape(-1, frequency_hz.size),
        names=output_names(results["outputs"], results["limb"]),
        axes=axes,
        kind=_kind(settings),
        span=seen,
        level_words=_RELATIVE_LEVEL_WORDS if settings.relative else LEVEL_WORDS,
        scaling=_scaling(settings, span),
        columns=_columns(results["outputs"], axes) if columns else (),
        about=lines_later(results, *first, each_axis=each_axis),
        heading=heading_of(results, each_axis=each_axis),
        peaks=peaks,
        matched=match_words(results["match_gain"]),
    )


def notes_of(results: Mapping[str, Any], settings: SpectraSettings) -> tuple[str, ...]:
    """What should be known of the curves, longest first."""
    rectified = results["method"] == "mag" and len(results["axes"]) > 1
    return _RECTIFIED if rectified and settings.layout != "axes" else ()


def _scaling(settings: SpectraSettings, span: Span) -> tuple[str, ...]:
    """What heights mean, longest first."""
    if not settings.averaged:
        return _SCALINGS[span]
    return tuple(f"{words}, {_AVERAGED}" for words in _SCALINGS[span])


def _averaged_words(settings: SpectraSettings, frequency_hz: Floats) -> str:
    """Over which frequencies a mean is, where each magnitude is one."""
    if not settings.averaged or frequency_hz.size < 2:
        return ""
    return f", {_AVERAGED}, {MEAN_OF_BINS * float(frequency_hz[1] - frequency_hz[0]):.3g} Hz"


def _kind(settings: SpectraSettings) -> Kind:
    if settings.log_magnitude:
        return "level"
    return "relative" if settings.relative else "amplitude"


def _columns(outputs: tuple[int, ...], axes: tuple[str, ...]) -> tuple[str, ...]:
    """Titles of levels that are relative to peaks."""
    return tuple(
        f"output_{output}{axis and f'_{axis}'}_db_re_its_peak"
        for output in outputs
        for axis in axes or ("",)
    )


def _drawn(magnitude: Floats, settings: SpectraSettings) -> Floats:
    return decibels(magnitude) if settings.log_magnitude else magnitude


def _inside(frequency_hz: Floats, band_hz: Band | None) -> NDArray[np.bool_]:
    """Which frequencies were measured: below them is what sensors drift, not what skin does."""
    low_hz, high_hz = band_hz or (0.0, np.inf)
    found = (frequency_hz >= low_hz) & (frequency_hz <= high_hz)
    # A band between two frequencies holds none: then all count.
    return found if found.any() else ~found
