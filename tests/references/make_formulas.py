"""Formulas at some of their samples, to 40 digits: ``formulas.json``.

python tests/references/make_formulas.py
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


#: Text, rate, shift, duration, and what it means.
Meaning = Callable[[mpf, mpf], mpf]
FORMULAS: tuple[tuple[str, float, float, float, Meaning], ...] = (
    (
        "sin(2*pi*250.1*t)",
        1300.0,
        0.0,
        3600.0,
        lambda t, _: mp.sin(2 * mp.pi * N(250.1) * t),
    ),
    (
        "cos(2*pi*600*t + 0.3)",
        1300.0,
        0.0004,
        600.0,
        lambda t, _: mp.cos(mp.pi * 1200 * t + N(0.3)),
    ),
    (
        "sin(500*t - 2)^3",
        48000.0,
        0.00001,
        40.0,
        lambda t, _: mp.sin(500 * t - 2) ** 3,
    ),
    (
        "sin(2*pi*100*t + 2*sin(2*pi*7*t))",
        44100.0,
        0.0,
        40.0,
        lambda t, _: mp.sin(200 * mp.pi * t + 2 * mp.sin(14 * mp.pi * t)),
    ),
    ("chirp(25, 600)", 1300.0, 0.0003, 600.0, lambda t, d: chirp(t, d, 25, 600)),
    (
        "sin(2*pi*(25 + 0.5*t)*t)",
        1300.0,
        0.0,
        600.0,
        lambda t, _: mp.sin(2 * mp.pi * (25 + t / 2) * t),
    ),
    ("mod(37*t, 1) - 0.5", 1300.0, 0.0, 600.0, lambda t, _: 37 * t - mp.floor(37 * t) - N(0.5)),
    ("tan(0.5*sin(9*t))", 1300.0, 0.0, 1.0, lambda t, _: mp.tan(mp.sin(9 * t) / 2)),
    (
        "exp(-t/0.05) * sin(2*pi*120*t) * hann()",
        1300.0,
        0.0001,
        0.4,
        lambda t, d: mp.exp(-t / N(0.05)) * mp.sin(240 * mp.pi * t) * hann(t, d),
    ),
    ("window()*tukey(0.3)", 1300.0, 0.0, 0.4, lambda t, d: hann(t, d) * tukey(t, d, N(0.3))),
    ("tukey()", 8000.0, 0.0, 0.1, lambda t, d: tukey(t, d, N(0.25))),
    (
        "gauss(0.1, 0.02) - 2*pulse(0.05, 0.1)*step(0.12)",
        1300.0,
        0.0,
        0.3,
        lambda t, _: (
            mp.exp(-(((t - N(0.1)) / N(0.02)) ** 2) / 2)
            - 2 * yes(0.05 <= t < 0.15) * yes(t >= 0.12)
        ),
    ),
    (
        "(t < 0.1)*t^2 + (t >= 0.1)*sqrt(t)/duration",
        1300.0,
        0.0,
        0.3,
        lambda t, d: t**2 if t < 0.1 else mp.sqrt(t) / d,
    ),
    (
        "clip(3*sin(80*t), -1, 0.5) + min(t, 0.1, 1) + max(t, 0.2)",
        1300.0,
        0.0,
        0.3,
        lambda t, _: (
            max(mpf(-1), min(N(0.5), 3 * mp.sin(80 * t))) + min(t, N(0.1)) + max(t, N(0.2))
        ),
    ),
    (
        "log(1+t) + abs(sin(40*t)) + sign(t-0.1) + tanh(3*t)",
        1300.0,
        0.0,
        0.3,
        lambda t, _: mp.log(1 + t) + abs(mp.sin(40 * t)) + mp.sign(t - N(0.1)) + mp.tanh(3 * t),
    ),
    (
        "floor(9.5*t) + ceil(9.5*t)*10 + round(9.5*t)*100",
        1300.0,
        0.0001,
        0.5,
        lambda t, _: (
            mp.floor(N(9.5) * t) + mp.ceil(N(9.5) * t) * 10 + mp.floor(N(9.5) * t + N(0.5)) * 100
        ),
    ),
    ("2^-t^2 - -t^2", 1300.0, 0.0, 1.0, lambda t, _: mpf(2) ** (-(t**2)) + t**2),
)
POINTS = 60


def formulas() -> list[dict]:
    """Each formula with some of its samples; the last one is among them."""
    mp.dps = 40
    result = []
    for text, rate_hz, shift_s, duration_s, meaning in FORMULAS:
        first, last = (1 if shift_s else 0), int(duration_s * rate_hz) - 1
        numbers = sorted({first + k * (last - first) // (POINTS - 1) for k in range(POINTS)})
        instants = [mpf(k) / N(rate_hz) - N(shift_s) for k in numbers]
        result.append(
            {
                "text": text,
                "sample_rate_hz": rate_hz,
                "shift_s": shift_s,
                "duration_s": duration_s,
                "numbers": numbers,
                "values": [float(meaning(t, N(duration_s))).hex() for t in instants],
            }
        )
    return result


def main() -> None:
    """Write the file beside this script."""
    path = Path(__file__).with_name("formulas.json")
    path.write_text(json.dumps(formulas(), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
