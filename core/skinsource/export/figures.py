"""What an export says of itself: what it shows, how that was computed, how wrong it can be."""

import hashlib
import math

import numpy as np
import scipy

from skinsource.design import audible_inputs
from skinsource.errors import TooInaccurateError
from skinsource.export.description import describe_levels, describe_played, describe_projection
from skinsource.export.exported_design import ExportedDesign
from skinsource.limb import axes_of
from skinsource.rendering.check import ESTIMATE_FACTOR, N_SAMPLES, TraceError
from skinsource.validity.finding import words_of
from skinsource.version import __version__


def about_design(exported: ExportedDesign) -> list[str]:
    """Lines on limb, scaling, and what is played."""
    design = exported.design
    lines = ["SkinSource studio"]
    if exported.limb.synthetic:
        lines.append("SYNTHETIC LIMB: computed responses, not measured ones")
    lines += describe_played(
        design.limb, exported.limb.note, design.scaling, design.inputs, design.actuated
    )
    return [*lines, *words_of(exported.value("validity"))]


def about_axes(exported: ExportedDesign) -> str:
    """Line on the axes and how they become one signal."""
    axes = axes_of(exported.limb.axes, exported.view.axes)
    return describe_projection(axes, exported.view.method)


def about_levels(exported: ExportedDesign) -> str:
    """Line on what levels are the RMS over."""
    return describe_levels(exported.view.span)


def about_method(exported: ExportedDesign) -> list[str]:
    """Lines on versions, method, and the data that went in."""
    audible = audible_inputs(exported.design.inputs)
    how = (
        "cached spectra"
        if exported.streamed is None
        else f"overlap-save {exported.streamed.cut.n_fft}"
    )
    return [
        f"computed by: skinsource {__version__}, numpy {np.__version__}, scipy {scipy.__version__}",
        f"precision and method: float64, {how}",
        f"inputs heard: {len(audible)} of {len(exported.design.inputs)}",
        *_about_data(exported, sorted({one.location for one in audible})),
    ]


def about_error(error: TraceError | None, what: str) -> str:
    """Line on the error of ``what``, as far as it is known."""
    if error is None:
        return f"error of {what}: there is nothing to check"
    return (
        f"error of {what}, relative to the largest sample: about {error.estimate!r} "
        f"({ESTIMATE_FACTOR:g} x the worst of {N_SAMPLES} samples computed again exactly), at most "
        f"{error.bound!r} (theory)"
    )


def listed(outputs: tuple[int, ...]) -> str:
    """Words for some outputs."""
    return f"outputs {', '.join(map(str, outputs))}"


def refuse_if_worse(error: TraceError | None, largest_error: float) -> None:
    """Raise `TooInaccurateError` where the estimate is not at most ``largest_error``."""
    if error is not None and not error.estimate <= largest_error and largest_error < math.inf:
        raise TooInaccurateError(
            f"The result may be wrong by {error.estimate:.1e} of its largest sample, more than "
            f"{largest_error:g}. Nothing was written. Look for inputs that cancel each other."
        )


def _about_data(exported: ExportedDesign, places: list[int]) -> list[str]:
    if not places:
        return []
    digest = hashlib.sha256()
    for place in places:
        digest.update(np.ascontiguousarray(exported.limb.response_to(place), "<f8").data)
    numbers = ", ".join(map(str, places))
    return [f"responses to places {numbers}: SHA-256 {digest.hexdigest()}"]
