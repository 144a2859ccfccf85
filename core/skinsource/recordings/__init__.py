"""Recordings from foreign files: what a file holds, what is taken of it, and what comes of that.

>>> from skinsource import recordings
>>> list(recordings.UNITS)
['full scale', 'm/s²', 'g', 'mm/s', 'µm', 'N', 'V']
"""

from skinsource.recordings.choice import ImportChoice, suggested
from skinsource.recordings.found import Found, Series
from skinsource.recordings.importing import look, take
from skinsource.recordings.taking import Taken, taken
from skinsource.recordings.units import UNITS

__all__ = [
    "UNITS",
    "Found",
    "ImportChoice",
    "Series",
    "Taken",
    "look",
    "suggested",
    "take",
    "taken",
]
