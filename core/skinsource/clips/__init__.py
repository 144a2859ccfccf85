"""Clips: what a track plays from when on, and what stands beside it on the ruler."""

from skinsource.clips.clip import EFFECT_LIST, GAIN, ONSET, Clip
from skinsource.clips.fragment import Fragment, Lane
from skinsource.clips.ids import numbered
from skinsource.clips.marker import Marker

__all__ = ["EFFECT_LIST", "GAIN", "ONSET", "Clip", "Fragment", "Lane", "Marker", "numbered"]
