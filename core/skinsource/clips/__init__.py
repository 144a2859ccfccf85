"""Clips: what a track plays from when on, and what stands beside it on the ruler."""

# First: `skinsource.waveforms` needs the class `Clip` for one of its kinds.
import skinsource.waveforms  # noqa: F401  # isort: split
from skinsource.clips.clip import EFFECT_LIST, GAIN, ONSET, Clip
from skinsource.clips.fragment import Fragment, Lane
from skinsource.clips.marker import Marker
from skinsource.clips.numbering import numbered

__all__ = ["EFFECT_LIST", "GAIN", "ONSET", "Clip", "Fragment", "Lane", "Marker", "numbered"]
