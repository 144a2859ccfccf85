"""Stored samples of formulas are their meaning to 40 digits, rounded once: ``formulas.json``.

python tests/references/check_formulas.py
"""

import json
from collections.abc import Callable
from pathlib import Path

from mpmath import mp, mpf

#: Numbers are the floats that a text of them means.
N = mpf


def hann(t: mpf, duration: mpf) -> mpf:
    """Hann window over the duration."""
    return (1 - mp.cos(2 * mp.pi * t / duration)) / 2


def tukey(t: mpf, duration: mpf, share: mpf) -> mpf:
    """Tukey window over the duration, of which a share is taper."""
    taper = share * duration / 2
    from_end = min(t, duration - t)
    return (1 - mp.cos(mp.pi * from_end / taper)) / 2 if from_end < taper else mpf(1)


def yes(condition: bool) -> mpf:
    """A comparison as a number."""
    return mpf(1 if condition else 0)


def chirp(t: mpf, duration: mpf, start: int, end: int) -> mpf:
    """Sine whose frequency rises linearly over the duration."""
    return mp.sin(2 * mp.pi * (start * t + (end - start) / (2 * duration) * t * t))


#: What a text means at a time, for a duration.
Meaning = Callable[[mpf, mpf], mpf]
MEANINGS: dict[str, Meaning] = {
    "sin(2*pi*250.1*t)": lambda t, _: mp.sin(2 * mp.pi * N(250.1) * t),
    "cos(2*pi*600*t + 0.3)": lambda t, _: mp.cos(mp.pi * 1200 * t + N(0.3)),
    "sin(500*t - 2)^3": lambda t, _: mp.sin(500 * t - 2) ** 3,
    "sin(2*pi*100*t + 2*sin(2*pi*7*t))": lambda t, _: mp.sin(
        200 * mp.pi * t + 2 * mp.sin(14 * mp.pi * t)
    ),
    "chirp(25, 600)": lambda t, d: chirp(t, d, 25, 600),
    "sin(2*pi*(25 + 0.5*t)*t)": lambda t, _: mp.sin(2 * mp.pi * (25 + t / 2) * t),
    "mod(37*t, 1) - 0.5": lambda t, _: 37 * t - mp.floor(37 * t) - N(0.5),
    "tan(0.5*sin(9*t))": lambda t, _: mp.tan(mp.sin(9 * t) / 2),
    "exp(-t/0.05) * sin(2*pi*120*t) * hann()": lambda t, d: (
        mp.exp(-t / N(0.05)) * mp.sin(240 * mp.pi * t) * hann(t, d)
    ),
    "window()*tukey(0.3)": lambda t, d: hann(t, d) * tukey(t, d, N(0.3)),
    "tukey()": lambda t, d: tukey(t, d, N(0.25)),
    "gauss(0.1, 0.02) - 2*pulse(0.05, 0.1)*step(0.12)": lambda t, _: (
        mp.exp(-(((t - N(0.1)) / N(0.02)) ** 2) / 2) - 2 * yes(0.05 <= t < 0.15) * yes(t >= 0.12)
    ),
    "(t < 0.1)*t^2 + (t >= 0.1)*sqrt(t)/duration": lambda t, d: t**2 if t < 0.1 else mp.sqrt(t) / d,
    "clip(3*sin(80*t), -1, 0.5) + min(t, 0.1, 1) + max(t, 0.2)": lambda t, _: (
        max(mpf(-1), min(N(0.5), 3 * mp.sin(80 * t))) + min(t, N(0.1)) + max(t, N(0.2))
    ),
    "log(1+t) + abs(sin(40*t)) + sign(t-0.1) + tanh(3*t)": lambda t, _: (
        mp.log(1 + t) + abs(mp.sin(40 * t)) + mp.sign(t - N(0.1)) + mp.tanh(3 * t)
    ),
    "floor(9.5*t) + ceil(9.5*t)*10 + round(9.5*t)*100": lambda t, _: (
        mp.floor(N(9.5) * t) + mp.ceil(N(9.5) * t) * 10 + mp.floor(N(9.5) * t + N(0.5)) * 100
    ),
    "2^-t^2 - -t^2": lambda t, _: mpf(2) ** (-(t**2)) + t**2,
}


def main() -> None:
    """Compare all stored values."""
    mp.dps = 40
    path = Path(__file__).with_name("formulas.json")
    for row in json.loads(path.read_text(encoding="utf-8")):
        meaning, duration = MEANINGS[row["text"]], N(row["duration_s"])
        for k, value in zip(row["numbers"], row["values"], strict=True):
            time = mpf(k) / N(row["sample_rate_hz"]) - N(row["shift_s"])
            assert float(meaning(time, duration)).hex() == value, (row["text"], k)


if __name__ == "__main__":
    main()
