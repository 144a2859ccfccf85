"""How strong a drive is, and at which frequency, point by point: for devices without waveforms."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.arrays import Floats

# What is this far below the largest amplitude has no frequency of its own.
_SILENT = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Envelope:
    """Amplitude and frequency at equal steps.

    Attributes
    ----------
    time_s : (n_points,)
        Middles of the stretches; the first is 0, the last the end.
    amplitude : (n_points,)
        Of a sine that is as strong as the drive in that stretch, in parts of full scale.
    frequency_hz : (n_points,)
        Mean of the instantaneous frequency, weighted by power; that of the point before where
        it is silent.
    """

    time_s: Floats
    amplitude: Floats
    frequency_hz: Floats


def envelope_of(samples: Floats, rate_hz: float, step_s: float) -> Envelope:
    """Amplitude and frequency of a drive, every ``step_s`` and at its end.

    From the analytic signal: the root mean square of its length, and the mean turn from sample to
    sample, over one step about each point.  A steady sine has its own amplitude and frequency.

    Parameters
    ----------
    samples : (n_times,)
        The drive; silent before and after.
    rate_hz, step_s
        Its rate; at least one sample.
    """
    n = samples.size
    # Room for it: the transform goes round.
    analytic = scipy.signal.hilbert(np.concatenate((samples, np.zeros(n))))[:n]
    power = np.concatenate(([0.0], np.cumsum(np.abs(analytic) ** 2)))
    turns = np.concatenate(([0.0, 0.0], np.cumsum(analytic[1:] * analytic[:-1].conj())))
    end_s = n / rate_hz
    n_points = max(int(np.ceil(end_s / step_s - 1e-9)), 1) + 1
    time_s = np.minimum(np.arange(n_points) * step_s, end_s)
    first = np.clip(np.round((time_s - step_s / 2) * rate_hz).astype(int), 0, n - 1)
    last = np.clip(np.round((time_s + step_s / 2) * rate_hz).astype(int), first + 1, n)
    amplitude = np.sqrt(np.maximum(power[last] - power[first], 0.0) / (last - first))
    turn = turns[last] - turns[np.minimum(first + 1, last)]
    frequency_hz = np.abs(np.angle(turn)) * rate_hz / (2.0 * np.pi)
    heard = amplitude > _SILENT * max(float(amplitude.max(initial=0.0)), 1e-300)
    if heard.any():
        # The first one that is heard, until another is.
        places = np.maximum.accumulate(np.where(heard, np.arange(n_points), -1))
        frequency_hz = frequency_hz[np.where(places < 0, int(np.argmax(heard)), places)]
    return Envelope(time_s=time_s, amplitude=amplitude, frequency_hz=frequency_hz)
