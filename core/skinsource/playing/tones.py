"""A tone by which one finds the actuator of an output."""

import numpy as np

from skinsource.playing.mix import Mix, mix_of, rise

#: Strong in the skin, and audible where an actuator rattles.
FREQUENCY_HZ = 100.0
DURATION_S = 0.6
_FADE_S = 0.05


def tone_of(output: int, n_outputs: int, sample_rate_hz: int) -> Mix:
    """Return 0.6 s of 100 Hz on one output, from 1, of amplitude 1; silence on the others."""
    n = round(DURATION_S * sample_rate_hz)
    tone = np.sin(2.0 * np.pi * FREQUENCY_HZ * np.arange(n) / sample_rate_hz)
    fade = rise(round(_FADE_S * sample_rate_hz))
    tone[: fade.size] *= fade
    tone[-fade.size :] *= fade[::-1]
    return mix_of(
        tone[np.newaxis],
        sample_rate_hz,
        outputs=[output],
        titles=["test tone"],
        n_outputs=n_outputs,
    )
