"""From what is written down of a voice to the samples it plays: the one place drives come from."""

from skinsource.chain.chain import Chain, Curve, Part
from skinsource.chain.drive import LARGEST, Drive, drive_of, drive_played, first_unusable
from skinsource.chain.placing import placed_chain

__all__ = [
    "LARGEST",
    "Chain",
    "Curve",
    "Drive",
    "Part",
    "drive_of",
    "drive_played",
    "first_unusable",
    "placed_chain",
]
