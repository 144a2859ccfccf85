"""From strokes of a pen to samples: what is drawn is what is played."""

from skinsource.drawing.bounded import Bounded, bounded_to_band
from skinsource.drawing.stroke import Stroke, drawn_over, zeroed

__all__ = ["Bounded", "Stroke", "bounded_to_band", "drawn_over", "zeroed"]
