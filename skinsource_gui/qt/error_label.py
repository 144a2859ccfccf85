"""The estimated error of the traces on the screen, as a text."""

import math

import numpy as np

from skinsource.engine.gains import TraceError

#: The error that the engine promises, and a visible one, relative to the largest sample.
PROMISED, VISIBLE = 1e-14, 1e-3


def error_text(error: TraceError) -> str:
    """Return a short text of estimate and bound."""
    return f"error ≈ {rounded_up(error.estimate)}, at most {rounded_up(error.bound)}"


def rounded_up(error: float) -> str:
    """Return ``error`` rounded up to one digit, so that it never looks smaller than it is."""
    # No error in float64 is smaller than one rounding.
    error = max(error, float(np.finfo(np.float64).eps))
    exponent = math.floor(math.log10(error))
    digit = math.ceil(error / 10.0**exponent - 1e-9)
    return f"{digit}e{exponent}" if digit < 10 else f"1e{exponent + 1}"
