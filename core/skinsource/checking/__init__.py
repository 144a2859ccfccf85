"""A design held against a recording of it, and against what a linear model rests on."""

from skinsource.checking.condition import Recorded, condition_of
from skinsource.checking.pages import html_of, write_report

__all__ = ["Recorded", "condition_of", "html_of", "write_report"]
