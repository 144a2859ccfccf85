"""What a linear model rests on: a design held against a recording of it, designs against others."""

from skinsource.checking.condition import Recorded, condition_of
from skinsource.checking.linearity import (
    Proportion,
    Straightness,
    Superposition,
    joint_of,
    proportion,
    straightness,
    strengths_of,
    superposition,
)
from skinsource.checking.report import html_of, write_report

__all__ = [
    "Proportion",
    "Recorded",
    "Straightness",
    "Superposition",
    "condition_of",
    "html_of",
    "joint_of",
    "proportion",
    "straightness",
    "strengths_of",
    "superposition",
    "write_report",
]
