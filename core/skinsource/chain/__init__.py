"""From what is written down of a voice to the samples it plays: the one place drives come from."""

from skinsource.chain.chain import Chain
from skinsource.chain.drive import LARGEST, Drive, drive_of, drive_played, first_unusable

__all__ = ["LARGEST", "Chain", "Drive", "drive_of", "drive_played", "first_unusable"]
