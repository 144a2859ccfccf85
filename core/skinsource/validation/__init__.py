"""Predictions held against measurements, and the checks that a linear model rests on."""

from skinsource.validation.agreement import Agreement, agreement, aligned
from skinsource.validation.linearity import linear_fit, superposition_correlation
from skinsource.validation.recorded import open_recorded

__all__ = [
    "Agreement",
    "agreement",
    "aligned",
    "linear_fit",
    "open_recorded",
    "superposition_correlation",
]
