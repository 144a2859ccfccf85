"""What is read out of a predicted response: how far it reaches, how strong, how fast, and when."""

from skinsource.analysis.extent import Extent, extent
from skinsource.analysis.windowed import windowed_rms

__all__ = ["Extent", "extent", "windowed_rms"]
