"""What is read out of a predicted response: how far it reaches, how strong, how fast, and when."""

from skinsource.analysis.extent import Extent, extent
from skinsource.analysis.windowed import windowed_rms
from skinsource.analysis.windows import MOST_WINDOWS, Windows, windows_over

__all__ = ["MOST_WINDOWS", "Extent", "Windows", "extent", "windowed_rms", "windows_over"]
