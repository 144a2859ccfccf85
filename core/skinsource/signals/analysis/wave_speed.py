"""How fast a wave travels along a line of outputs, and how much it loses on the way."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.base.conventions import Booleans, Floats
from skinsource.base.decibels import decibels
from skinsource.base.job import Stop, never, stop_if

#: Least similarity of two signals between which a delay means something.
LEAST_ALIKE = 0.5
#: Least share of the variance of delays that the distance must explain (r²) for a speed.
LEAST_EXPLAINED = 0.5
#: Least distance of the ends of a line, as a share of its length, for a speed.
LEAST_STRAIGHT = 0.5
# What moves more than this share of its peak before its group delay does not arrive then.
_EARLY = 0.2
_MM_PER_CM = 10.0


def vertex(neighbours: Floats) -> float:
    """Return the position of the vertex of a parabola through three points, in steps.

    Parameters
    ----------
    neighbours : (3,)
        The middle one, from which steps count, is not below the others; 0 where all are equal.
    """
    left, middle, right = (float(value) for value in neighbours)
    bend = left - 2.0 * middle + right
    return 0.0 if bend >= 0.0 else float(np.clip(0.5 * (left - right) / bend, -0.5, 0.5))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TravellingWave:
    """Delays and levels along a line, and the straight lines through them.

    Attributes
    ----------
    distance_m : (n_points,)
        Along the line, from its first point.
    delay_s : (n_points,)
        Delay of a point to the first one, at the maximum of the envelope of their
        cross-correlation; NaN: silent.
    alike : (n_points,)
        That maximum, as a share of the one of two signals of the same shape, 0 to 1.
    level_db : (n_points,)
        RMS, dB re 1 m/s².
    counted : (n_points,) of bool
        Points whose levels count: neither silent nor mostly noise.
    timed : (n_points,) of bool
        Points of those whose delays count: similar enough to the first one.
    speed_m_per_s, speed_deviation_m_per_s
        Group speed, one over the slope of the delays, and its standard deviation, first order.
        NaN: fewer than two points, delays that do not grow, less than `LEAST_EXPLAINED` of the
        variance of the delays explained, or a line less straight than `LEAST_STRAIGHT`.
    attenuation_db_per_cm, attenuation_deviation_db_per_cm
        Minus the slope of the levels; spreading included.
    explained
        Share of the variance of the delays that a linear fit over the distance explains, r², 0 to
        1; NaN: fewer than two points, or delays that are all the same.
    straight
        Distance of the ends of the line, as a share of its length, 0 to 1.
    """

    distance_m: Floats
    delay_s: Floats
    similarity: Floats
    level_db: Floats
    counted: Booleans
    timed: Booleans
    speed_m_per_s: float
    speed_deviation_m_per_s: float
    attenuation_db_per_cm: float
    attenuation_deviation_db_per_cm: float
    explained: float
    straight: float = 1.0


def travelling_wave(
    signals: Floats,
    distance_mm: Floats,
    sample_rate_hz: float,
    trusted: Booleans | None = None,
    stop: Stop = never,
    *,
    straight: float = 1.0,
) -> TravellingWave:
    """Return delays, levels, speed and attenuation of a wave along a line.

    Parameters
    ----------
    signals : (n_points, n_times)
        Along one axis that means the same everywhere (z), m/s².
    distance_mm : (n_points,)
        Along the line.
    sample_rate_hz
        Rate of the signals.
    trusted : (n_points,) of bool
        Points that are more than noise; default: all.  Silent ones never count.
    stop
        Called before each point.
    straight
        The `straightness` of the line: there is no speed along a line to and fro.

    Raises
    ------
    Stopped
        ``stop`` returned True.
    """
    distance = distance_mm * 1e-3
    level_db = decibels(np.sqrt(np.mean(np.square(signals), axis=-1)))
    delay_s, alike = group_delays(signals, sample_rate_hz, stop)
    counted = np.isfinite(delay_s)
    if trusted is not None:
        counted &= trusted
    timed = counted & (alike >= LEAST_ALIKE)
    slowness, slowness_deviation = _slope(distance[timed], delay_s[timed])
    slope, slope_deviation = _slope(distance[counted], level_db[counted])
    explained = _explained(distance[timed], delay_s[timed])
    has_speed = slowness > 0.0 and explained >= LEAST_EXPLAINED and straight >= LEAST_STRAIGHT
    return TravellingWave(
        distance_m=distance,
        delay_s=delay_s,
        similarity=alike,
        level_db=level_db,
        counted=counted,
        timed=timed,
        speed_m_per_s=1.0 / slowness if has_speed else np.nan,
        speed_deviation_m_per_s=slowness_deviation / slowness**2 if has_speed else np.nan,
        attenuation_db_per_cm=-slope / 1e3 * _MM_PER_CM,
        attenuation_deviation_db_per_cm=slope_deviation / 1e3 * _MM_PER_CM,
        explained=explained,
        straight=straight,
    )


def line_distances_mm(places: Floats, mm_per_unit: float) -> Floats:
    """Return the distance of each point along a polygon, (n_points,), mm.

    ``places`` (n_points, 2) are in units of ``mm_per_unit``.
    """
    steps = np.hypot(*np.diff(places, axis=0).T) * mm_per_unit
    return np.concatenate([[0.0], np.cumsum(steps)])


def straightness(places: Floats) -> float:
    """Return the distance of the ends of a polygon, as a share of its length, 0 to 1.

    ``places`` (n_points, 2) are in any unit.  1: straight, or without length.  It is one over
    the arc-chord ratio, the simplest measure of tortuosity (Bullitt et al. 2003, "distance
    metric").
    """
    length = float(np.hypot(*np.diff(places, axis=0).T).sum())
    return float(np.hypot(*(places[-1] - places[0]))) / length if length else 1.0


def group_delays(data: Floats, rate: float, stop: Stop = never) -> tuple[Floats, Floats]:
    """Return group delays to the first signal in s, and the similarity of the shapes."""
    n_times = data.shape[-1]
    n_fft = scipy.fft.next_fast_len(2 * n_times, real=False)
    first = scipy.fft.rfft(data[0], n_fft)
    norm = float(np.linalg.norm(data[0]))
    delay_s, alike = np.full(len(data), np.nan), np.zeros(len(data))
    for k, signal in enumerate(data):
        stop_if(stop)
        size = norm * float(np.linalg.norm(signal))
        if size == 0.0:
            continue
        cross = scipy.fft.rfft(signal, n_fft) * np.conj(first)
        envelope = np.abs(scipy.signal.hilbert(scipy.fft.irfft(cross, n_fft)))
        top = int(np.argmax(envelope))
        lag = top + vertex(envelope[[top - 1, top, (top + 1) % n_fft]])
        delay_s[k] = (lag if lag < n_fft / 2 else lag - n_fft) / rate
        alike[k] = min(envelope[top] / size, 1.0)
    return delay_s, alike


def arrivals(data: Floats, rate: float, onset_s: float) -> Floats:
    """Return group delays to the first signal in s, where they are arrivals; NaN: they are not.

    Signals of another shape have none, nor those that move before the delay after ``onset_s`` has
    passed, as near a notch of a response.
    """
    delay_s, alike = group_delays(data, rate)
    reached, samples = np.maximum.accumulate(np.abs(data), axis=-1), np.arange(data.shape[-1])
    pairs = zip(rate * (onset_s + delay_s), reached, strict=True)
    early = np.array([np.interp(at, samples, peaks) for at, peaks in pairs])
    arrives = (alike >= LEAST_ALIKE) & (early <= _EARLY * reached[:, -1])
    return np.where(arrives, delay_s, np.nan)


def _explained(x: Floats, y: Floats) -> float:
    """Return the share of the variance of ``y`` that a linear fit over ``x`` explains, r²."""
    if x.size < 2 or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return np.nan
    return float(np.corrcoef(x, y)[0, 1] ** 2)


def _slope(x: Floats, y: Floats) -> tuple[float, float]:
    """Return the slope of a linear fit by least squares, and its standard deviation."""
    if x.size < 2 or np.ptp(x) == 0.0:
        return np.nan, np.nan
    centred = x - x.mean()
    spread = float(centred @ centred)
    slope = float(centred @ (y - y.mean())) / spread
    residual = y - y.mean() - slope * centred
    if x.size == 2:
        return slope, np.nan
    return slope, float(np.sqrt(residual @ residual / (x.size - 2) / spread))
