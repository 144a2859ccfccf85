"""Which sample is full scale."""

import numpy as np

from skinsource.stimulus.stimulus import Stimulus, peaks


def full_scale_factor(stimulus: Stimulus) -> float:
    """One factor for all channels that brings the largest sample to 1; 1 where all are silent.

    Channels that drive no actuator play no part.
    """
    rows = list(stimulus.driving)
    peak = float(peaks(stimulus.samples)[rows].max(initial=0.0)) if rows else 0.0
    if peak == 0.0:
        return 1.0
    factor = 1.0 / peak
    # Rounded down, so that the largest sample is 1 and not the next number above it.
    return float(np.nextafter(factor, 0.0)) if peak * factor > 1.0 else factor


def scaled(stimulus: Stimulus, factor: float) -> Stimulus:
    """Multiply the channels that drive an actuator with ``factor``."""
    if factor == 1.0:
        return stimulus
    factors = np.ones((len(stimulus.channels), 1))
    factors[list(stimulus.driving)] = factor
    return stimulus.with_samples(stimulus.samples * factors)
