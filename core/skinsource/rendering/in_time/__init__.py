"""The skin in time: what each output does at an instant, from signals that are kept."""

from skinsource.rendering.in_time.moving import Moving, SlidingEnergy
from skinsource.rendering.in_time.window import BLOCK_S, block_of

__all__ = ["BLOCK_S", "Moving", "SlidingEnergy", "block_of"]
