"""Beginning and end of a burst, and what it cannot hold at a sample rate."""

from skinsource.arguments import positive_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.signals import WindowName, window_between


def burst(samples: Floats, window: WindowName, sample_rate_hz: float, shift_s: float) -> Floats:
    """Window ``samples`` of a signal that knows no beginning, in place, (n_times,).

    Parameters
    ----------
    samples : (n_times,)
        From the instant -``shift_s`` on; with a shift one more than the burst is long.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``; the burst starts and ends with the window.
    """
    if window != "none" or shift_s:
        shift = shift_s * sample_rate_hz
        samples *= window_between(window, samples.size - (shift_s > 0.0), shift)
    return samples


def refuse_aliases(name: str, frequency_hz: float, sample_rate_hz: float) -> None:
    """Refuse a frequency that samples of this rate cannot hold.

    Raises
    ------
    InvalidInputError
        It is at or above half the sample rate.
    """
    half_hz = positive_number("sample_rate_hz", sample_rate_hz) / 2
    if frequency_hz >= half_hz:
        raise InvalidInputError(
            f"{name} is {frequency_hz:g}, expected less than {half_hz:g} Hz (half the sample rate "
            f"of {sample_rate_hz:g} Hz); it would alias"
        )
