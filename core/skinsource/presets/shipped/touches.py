"""Taps, clicks, impacts, and signals made of them."""

from skinsource.clips import Clip
from skinsource.presets.preset import Preset
from skinsource.presets.shipped.making import preset
from skinsource.waveforms import CentredTap, DampedSine, Gabor, PulseTrain, Tap, Tone, Waveform

_UPSTREAM = "The tap of the SkinSource dataset's own software; how many, and when, is our choice."
_IMPACT = (
    "Form of the vibration: Okamura, Cutkosky and Dennerlein, Reality-based models for vibration "
    "feedback in virtual environments, IEEE/ASME Trans. Mechatronics 6, 2001. The numbers are our "
    "choice."
)


def _at(*times: tuple[float, Waveform, float]) -> tuple[Clip, ...]:
    """Clips of (onset in s, waveform, gain)."""
    return tuple(Clip(onset_s=onset, waveform=one, gain=gain) for onset, one, gain in times)


def _impact(name: str, words: str, hz: float, decay_s: float, duration_s: float) -> Preset:
    return preset(
        name,
        "impact, contact, damped",
        f"{words} {hz:g} Hz that decay with {decay_s * 1e3:g} ms.",
        DampedSine(hz, decay_s, duration_s),
        source=_IMPACT,
    )


_LOW, _HIGH = DampedSine(45.0, 0.03, 0.18), DampedSine(60.0, 0.022, 0.14)

TOUCHES: tuple[Preset, ...] = (
    preset("Tap", "tap, contact", "A pulse of 16 ms to one side.", Tap(), source=_UPSTREAM),
    preset(
        "Centred tap",
        "tap, contact",
        "A pulse of 20 ms whose mean is 0, so that it leaves no movement behind.",
        CentredTap(),
    ),
    preset(
        "Double tap",
        "tap, signal",
        "Two taps, 120 ms from start to start.",
        *_at((0.0, CentredTap(), 1.0), (0.12, CentredTap(), 1.0)),
    ),
    preset(
        "Triple tap",
        "tap, signal",
        "Three taps, 120 ms from start to start.",
        *_at(*((0.12 * k, CentredTap(), 1.0) for k in range(3))),
    ),
    preset(
        "Click",
        "click, button, short",
        "A very short burst about 200 Hz, as of a button.",
        Gabor(200.0, 1.0),
    ),
    preset(
        "Tick train",
        "click, train, wheel",
        "Ticks of 4 ms, ten a second, as of a wheel with notches.",
        PulseTrain(10.0, 0.004, 1.0),
    ),
    preset(
        "Heartbeat",
        "heart, pulse, rhythm, repeated",
        "Three beats at 60 a minute, each of a strong low thud and a weaker one 0.3 s later.",
        *_at(
            *(
                (k + late, one, gain)
                for k in range(3)
                for late, one, gain in ((0.0, _LOW, 1.0), (0.3, _HIGH, 0.6))
            )
        ),
    ),
    _impact("Soft impact", "As on rubber.", 60.0, 0.015, 0.12),
    _impact("Wooden impact", "As on wood.", 120.0, 0.012, 0.1),
    _impact("Hard impact", "As on metal.", 300.0, 0.03, 0.2),
    preset(
        "Alert",
        "signal, notification, strong",
        "Three bursts of 200 Hz, 150 ms long with 100 ms between them.",
        *_at(*((0.25 * k, Tone(200.0, duration_s=0.15), 1.0) for k in range(3))),
    ),
    preset(
        "Confirm",
        "signal, notification, rising",
        "A short low burst and a higher one.",
        *_at((0.0, Tone(100.0, duration_s=0.08), 0.7), (0.12, Tone(200.0, duration_s=0.12), 1.0)),
    ),
    preset(
        "Refuse",
        "signal, notification, error, falling",
        "A short high burst and a longer low one.",
        *_at((0.0, Tone(200.0, duration_s=0.08), 0.8), (0.12, Tone(60.0, duration_s=0.25), 1.0)),
    ),
)
