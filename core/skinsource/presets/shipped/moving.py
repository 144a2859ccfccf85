"""Clips on several tracks that are felt as something that moves."""

from skinsource.motions import (
    Alternation,
    ApparentMotion,
    Motion,
    Phantom,
    Sweep,
    TapSequence,
    TravellingPhase,
)
from skinsource.presets.preset import Preset
from skinsource.presets.shipped.making import preset_of_tracks
from skinsource.waveforms import CentredTap, Tone

_BURST = Tone(200.0, duration_s=0.1)
_FINGERTIPS = (2, 3, 4, 5)


def _moving(name: str, tags: str, words: str, motion: Motion) -> Preset:
    return preset_of_tracks(
        name,
        f"motion, several places, {tags}",
        f"{words} {motion.law} Edit > Motion… makes others.",
        motion.tracks(),
        source=motion.source,
    )


MOVING: tuple[Preset, ...] = (
    _moving(
        "Apparent motion, a pair",
        "apparent motion",
        "Two bursts that are felt as one that moves.",
        ApparentMotion(path=(16, 18), waveform=_BURST),
    ),
    _moving(
        "Apparent motion across the palm",
        "apparent motion, stroke",
        "Three bursts that are felt as a stroke.",
        ApparentMotion(path=(16, 18, 20), waveform=_BURST),
    ),
    _moving(
        "Phantom between two places",
        "phantom, illusion",
        "A tone at two places at once, felt between them.",
        Phantom(path=(17, 19)),
    ),
    _moving(
        "Hopping taps",
        "tap, rabbit, illusion",
        "Three taps at each of three places, evenly spaced.",
        TapSequence(path=(16, 18, 20), waveform=CentredTap()),
    ),
    _moving(
        "Alternating pair",
        "alternation, rhythm",
        "Bursts here and there in turn, four times.",
        Alternation(path=(7, 9), waveform=_BURST),
    ),
    _moving(
        "Stroke over the fingertips",
        "sweep, stroke, fingers",
        "One tone that runs from fingertip to fingertip.",
        Sweep(path=_FINGERTIPS, waveform=Tone(200.0, duration_s=0.8)),
    ),
    _moving(
        "Travelling wave",
        "phase, wave",
        "100 Hz at three places, each later in its phase.",
        TravellingPhase(path=(16, 18, 20)),
    ),
)
