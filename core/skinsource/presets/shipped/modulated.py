"""Sweeps, roughness, vibrato and ramps: what changes while it lasts."""

from skinsource.clips import Clip
from skinsource.effects import Envelope
from skinsource.fields import Breakpoint
from skinsource.presets.preset import Preset
from skinsource.presets.shipped.making import preset
from skinsource.waveforms import AmplitudeModulated, Chirp, FrequencyModulated, Tone

_BAND = "25 to 600 Hz is the band that the impulse responses are measured for; the rest is ours."
_ROUGH = (
    "How well modulation is felt, by its frequency: Weisenberger, Sensitivity to "
    "amplitude-modulated vibrotactile signals, J. Acoust. Soc. Am. 80, 1986. Carrier and length "
    "are our choice."
)


def _roughness(modulator_hz: float, words: str) -> Preset:
    return preset(
        f"Roughness {modulator_hz:g} Hz",
        "roughness, modulated, AM, texture",
        f"200 Hz, swelling {modulator_hz:g} times a second down to silence. {words}",
        AmplitudeModulated(200.0, modulator_hz, duration_s=0.6, window="tukey"),
        source=_ROUGH,
    )


def _shaped(*points: Breakpoint) -> Clip:
    tone = Tone(150.0, duration_s=0.6, window="none")
    return Clip(waveform=tone, effects=(Envelope(points),))


MODULATED: tuple[Preset, ...] = (
    preset(
        "Sweep 25 to 600 Hz, even",
        "sweep, chirp, test",
        "One second through the measured band, each hertz for the same time.",
        Chirp(25.0, 600.0, 1.0),
        source=_BAND,
    ),
    preset(
        "Sweep 25 to 600 Hz, by octaves",
        "sweep, chirp, test, logarithmic",
        "One second through the measured band, each octave for the same time.",
        Chirp(25.0, 600.0, 1.0, "logarithmic"),
        source=_BAND,
    ),
    preset(
        "Sweep 600 to 25 Hz, by octaves",
        "sweep, chirp, falling, logarithmic",
        "One second down through the measured band: it spreads as it goes on.",
        Chirp(600.0, 25.0, 1.0, "logarithmic"),
        source=_BAND,
    ),
    _roughness(5.0, "Felt as single swells."),
    _roughness(20.0, "Felt as rough."),
    _roughness(40.0, "Felt as finely rough."),
    _roughness(70.0, "Nearly smooth."),
    preset(
        "Vibrato",
        "modulated, FM, wobble",
        "150 Hz that goes up and down by 40 Hz, eight times a second.",
        FrequencyModulated(150.0, 8.0, 40.0, 0.75, window="tukey"),
    ),
    preset(
        "Ramp up",
        "ramp, envelope, rising",
        "150 Hz that grows evenly over 0.6 s and stops.",
        _shaped((0.0, 0.0, "straight"), (0.59, 1.0, "straight"), (0.6, 0.0, "straight")),
    ),
    preset(
        "Ramp down",
        "ramp, envelope, falling, fade",
        "150 Hz that starts at once and fades evenly over 0.6 s.",
        _shaped((0.0, 0.0, "straight"), (0.01, 1.0, "straight"), (0.6, 0.0, "straight")),
    ),
    preset(
        "Swell",
        "ramp, envelope, breath",
        "150 Hz that comes and goes smoothly.",
        _shaped((0.0, 0.0, "smooth"), (0.3, 1.0, "smooth"), (0.6, 0.0, "straight")),
    ),
)
