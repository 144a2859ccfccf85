"""How strong parts of a clip arrive on the skin, so that they can be made alike."""

from skinsource.levelling.wavelet_levels import MEASURE, wavelet_levels_db

__all__ = ["MEASURE", "wavelet_levels_db"]
