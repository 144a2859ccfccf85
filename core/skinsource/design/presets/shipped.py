"""The presets that the library ships.

``python -m skinsource.design.presets`` writes their files to the data folder; then update the list
of data files with ``python tests/core/test_shipped_files.py``.
"""

from collections.abc import Iterable

from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.design import Design, Input
from skinsource.design.edits.clips import fragment_of
from skinsource.design.effects.level import Envelope
from skinsource.design.motions import (
    Alternation,
    ApparentMotion,
    Motion,
    Phantom,
    Sweep,
    TapSequence,
    TravellingPhase,
)
from skinsource.design.presets.presets import Preset, tags_of
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.periodic import PulseTrain
from skinsource.design.waveforms.pulses import CentredTap, DampedSine, Noise, Tap
from skinsource.design.waveforms.tones import AmplitudeModulated, Chirp, FrequencyModulated, Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.design.waveforms.wavelets import Chirplet, Gabor, Morlet, Ricker
from skinsource.specs.breakpoints import Breakpoint

#: Source of presets whose numbers are in no publication.
_OURS = "Our choice."
#: Location of presets of one track: the pad of digit II, as for the first input of a new design.
_PAD_OF_II = 7


def _preset(
    name: str, tags: str, description: str, *clips: Clip | Waveform, source: str = _OURS
) -> Preset:
    """Return a preset of one track."""
    lane = Lane(location=_PAD_OF_II, clips=tuple(map(_as_clip, clips)))
    return Preset(
        name=name,
        tags=tags_of(tags),
        source=source,
        description=description,
        fragment=Fragment(lanes=(lane,)),
    )


def _preset_of_tracks(
    name: str, tags: str, description: str, tracks: Iterable[Input], source: str = _OURS
) -> Preset:
    """Return a preset of several tracks."""
    design = Design(limb="", inputs=tuple(tracks))
    fragment = fragment_of(design, (clip.id for clip in design.clips))
    if fragment is None:
        raise ValueError(f"{name} has no clips")
    return Preset(
        name=name, tags=tags_of(tags), source=source, description=description, fragment=fragment
    )


def _as_clip(clip_or_waveform: Clip | Waveform) -> Clip:
    return (
        clip_or_waveform if isinstance(clip_or_waveform, Clip) else Clip(waveform=clip_or_waveform)
    )


# Sweeps, roughness, vibrato and ramps.

_BAND = "25 to 600 Hz is the band that the impulse responses are measured for; the rest is ours."
_ROUGH = (
    "How well modulation is felt, by its frequency: Weisenberger, Sensitivity to "
    "amplitude-modulated vibrotactile signals, J. Acoust. Soc. Am. 80, 1986. Carrier and length "
    "are our choice."
)


def _roughness(modulator_hz: float, sentence: str) -> Preset:
    return _preset(
        f"Roughness {modulator_hz:g} Hz",
        "roughness, modulated, AM, texture",
        f"200 Hz, swelling {modulator_hz:g} times a second down to silence. {sentence}",
        AmplitudeModulated(200.0, modulator_hz, duration_s=0.6, window="tukey"),
        source=_ROUGH,
    )


def _shaped(*points: Breakpoint) -> Clip:
    tone = Tone(150.0, duration_s=0.6, window="none")
    return Clip(waveform=tone, effects=(Envelope(points),))


MODULATED: tuple[Preset, ...] = (
    _preset(
        "Sweep 25 to 600 Hz, even",
        "sweep, chirp, test",
        "One second through the measured band, each hertz for the same time.",
        Chirp(25.0, 600.0, 1.0),
        source=_BAND,
    ),
    _preset(
        "Sweep 25 to 600 Hz, by octaves",
        "sweep, chirp, test, logarithmic",
        "One second through the measured band, each octave for the same time.",
        Chirp(25.0, 600.0, 1.0, "logarithmic"),
        source=_BAND,
    ),
    _preset(
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
    _preset(
        "Vibrato",
        "modulated, FM, wobble",
        "150 Hz that goes up and down by 40 Hz, eight times a second.",
        FrequencyModulated(150.0, 8.0, 40.0, 0.75, window="tukey"),
    ),
    _preset(
        "Ramp up",
        "ramp, envelope, rising",
        "150 Hz that grows evenly over 0.6 s and stops.",
        _shaped((0.0, 0.0, "straight"), (0.59, 1.0, "straight"), (0.6, 0.0, "straight")),
    ),
    _preset(
        "Ramp down",
        "ramp, envelope, falling, fade",
        "150 Hz that starts at once and fades evenly over 0.6 s.",
        _shaped((0.0, 0.0, "straight"), (0.01, 1.0, "straight"), (0.6, 0.0, "straight")),
    ),
    _preset(
        "Swell",
        "ramp, envelope, breath",
        "150 Hz that comes and goes smoothly.",
        _shaped((0.0, 0.0, "smooth"), (0.3, 1.0, "smooth"), (0.6, 0.0, "straight")),
    ),
)


# Motions over several tracks.

_BURST = Tone(200.0, duration_s=0.1)
_FINGERTIPS = (2, 3, 4, 5)


def _moving(name: str, tags: str, sentence: str, motion: Motion) -> Preset:
    return _preset_of_tracks(
        name,
        f"motion, several places, {tags}",
        f"{sentence} {motion.law} Edit > Motion… makes others.",
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


# Steady tones and noise.

_LENGTH_S = 0.5
_TALBOT = (
    "Flutter and vibration: Talbot, Darian-Smith, Kornhuber and Mountcastle, The sense of "
    "flutter-vibration, J. Neurophysiology 31, 1968. Length and edges are our choice."
)
_BOLANOWSKI = (
    "Pacinian channel: Bolanowski, Gescheider, Verrillo and Checkosky, Four channels mediate the "
    "mechanical aspects of touch, J. Acoust. Soc. Am. 84, 1988. Length and edges are our choice."
)
_TEXTURE = (
    "That fine textures are felt by the spectrum of the vibration they evoke: Manfredi et al., "
    "Natural scenes in tactile texture, J. Neurophysiology 111, 2014. The bands are our choice."
)


def _tone(hz: float, sentence: str, source: str, tags: str = "") -> Preset:
    return _preset(
        f"Tone {hz:g} Hz",
        f"tone, steady, {tags}",
        f"Half a second of a sine of {hz:g} Hz with soft edges. {sentence}",
        Tone(hz, duration_s=_LENGTH_S),
        source=source,
    )


def _texture(name: str, seed: int, low_hz: float, high_hz: float, sentence: str) -> Preset:
    return _preset(
        name,
        "noise, texture, steady",
        f"Noise of {low_hz:g} to {high_hz:g} Hz for half a second. {sentence}",
        Noise(seed, _LENGTH_S, low_hz, high_hz),
        source=_TEXTURE,
    )


STEADY: tuple[Preset, ...] = (
    _tone(30.0, "Felt as flutter.", _TALBOT, "flutter, low"),
    _tone(50.0, "Felt between flutter and vibration; it travels far.", _TALBOT, "low"),
    _tone(100.0, "Felt as vibration.", _TALBOT),
    _tone(150.0, "A usual frequency of small actuators.", _OURS),
    _tone(200.0, "Where the skin begins to be most sensitive.", _BOLANOWSKI),
    _tone(250.0, "About where the skin is most sensitive.", _BOLANOWSKI, "high"),
    _texture("Rough texture", 1, 25.0, 100.0, "As of coarse weave."),
    _texture("Medium texture", 2, 100.0, 250.0, "As of cloth."),
    _texture("Fine texture", 3, 250.0, 600.0, "As of paper."),
    _texture("Noise of the whole band", 4, 25.0, 600.0, "All that was measured, at once."),
)


# Taps, clicks, impacts, and signals of them.

_UPSTREAM = "The tap of the SkinSource dataset's own software; how many, and when, is our choice."
_IMPACT = (
    "Form of the vibration: Okamura, Cutkosky and Dennerlein, Reality-based models for vibration "
    "feedback in virtual environments, IEEE/ASME Trans. Mechatronics 6, 2001. The numbers are our "
    "choice."
)


def _at(*times: tuple[float, Waveform, float]) -> tuple[Clip, ...]:
    """Return clips of (onset in s, waveform, gain)."""
    return tuple(
        Clip(onset_s=onset, waveform=waveform, gain=gain) for onset, waveform, gain in times
    )


def _impact(name: str, sentence: str, hz: float, decay_s: float, duration_s: float) -> Preset:
    return _preset(
        name,
        "impact, contact, damped",
        f"{sentence} {hz:g} Hz that decay with {decay_s * 1e3:g} ms.",
        DampedSine(hz, decay_s, duration_s),
        source=_IMPACT,
    )


_LOW, _HIGH = DampedSine(45.0, 0.03, 0.18), DampedSine(60.0, 0.022, 0.14)

TOUCHES: tuple[Preset, ...] = (
    _preset("Tap", "tap, contact", "A pulse of 16 ms to one side.", Tap(), source=_UPSTREAM),
    _preset(
        "Centred tap",
        "tap, contact",
        "A pulse of 20 ms whose mean is 0, so that it leaves no movement behind.",
        CentredTap(),
    ),
    _preset(
        "Double tap",
        "tap, signal",
        "Two taps, 120 ms from start to start.",
        *_at((0.0, CentredTap(), 1.0), (0.12, CentredTap(), 1.0)),
    ),
    _preset(
        "Triple tap",
        "tap, signal",
        "Three taps, 120 ms from start to start.",
        *_at(*((0.12 * k, CentredTap(), 1.0) for k in range(3))),
    ),
    _preset(
        "Click",
        "click, button, short",
        "A very short burst about 200 Hz, as of a button.",
        Gabor(200.0, 1.0),
    ),
    _preset(
        "Tick train",
        "click, train, wheel",
        "Ticks of 4 ms, ten a second, as of a wheel with notches.",
        PulseTrain(10.0, 0.004, 1.0),
    ),
    _preset(
        "Heartbeat",
        "heart, pulse, rhythm, repeated",
        "Three beats at 60 a minute, each of a strong low thud and a weaker one 0.3 s later.",
        *_at(
            *(
                (k + delay_s, waveform, gain)
                for k in range(3)
                for delay_s, waveform, gain in ((0.0, _LOW, 1.0), (0.3, _HIGH, 0.6))
            )
        ),
    ),
    _impact("Soft impact", "As on rubber.", 60.0, 0.015, 0.12),
    _impact("Wooden impact", "As on wood.", 120.0, 0.012, 0.1),
    _impact("Hard impact", "As on metal.", 300.0, 0.03, 0.2),
    _preset(
        "Alert",
        "signal, notification, strong",
        "Three bursts of 200 Hz, 150 ms long with 100 ms between them.",
        *_at(*((0.25 * k, Tone(200.0, duration_s=0.15), 1.0) for k in range(3))),
    ),
    _preset(
        "Confirm",
        "signal, notification, rising",
        "A short low burst and a higher one.",
        *_at((0.0, Tone(100.0, duration_s=0.08), 0.7), (0.12, Tone(200.0, duration_s=0.12), 1.0)),
    ),
    _preset(
        "Refuse",
        "signal, notification, error, falling",
        "A short high burst and a longer low one.",
        *_at((0.0, Tone(200.0, duration_s=0.08), 0.8), (0.12, Tone(60.0, duration_s=0.25), 1.0)),
    ),
)


# Single wavelets, and trains of them.

_UP = (50.0, 84.1, 141.4, 237.8, 400.0)
_TRAIN = (
    "Dandu, Shao, Stanley and Visell, Spatiotemporal haptic effects from a single actuator via "
    "spectral control of cutaneous wave propagation, IEEE World Haptics Conference, 2019. These "
    "frequencies and slots are our choice."
)
_RICKER = "Ricker, The form and laws of propagation of seismic wavelets, Geophysics 18, 1953."
_GABOR = "Gabor, Theory of communication, Journal of the IEE 93, 1946. The frequency is our choice."
_MORLET = (
    "Grossmann and Morlet, Decomposition of Hardy functions into square integrable wavelets of "
    "constant shape, SIAM J. Math. Analysis 15, 1984. The frequency is our choice."
)
_CHIRPLET = (
    "Mann and Haykin, The chirplet transform: physical considerations, IEEE Trans. Signal "
    "Processing 43, 1995. The numbers are our choice."
)

WAVELETS: tuple[Preset, ...] = (
    _preset(
        "Ricker pulse",
        "wavelet, pulse, short",
        "The shortest pulse about 100 Hz that leaves no movement behind.",
        Ricker(100.0),
        source=f"{_RICKER} The frequency is our choice.",
    ),
    _preset(
        "Gabor 80 Hz",
        "wavelet, burst, low",
        "A burst that is narrow in time and frequency; low, so that it travels far.",
        Gabor(80.0),
        source=_GABOR,
    ),
    _preset(
        "Gabor 250 Hz",
        "wavelet, burst, high",
        "A burst that is narrow in time and frequency; high, so that it stays near.",
        Gabor(250.0),
        source=_GABOR,
    ),
    _preset(
        "Morlet 150 Hz",
        "wavelet, burst",
        "A burst of six cycles whose mean is 0.",
        Morlet(150.0),
        source=_MORLET,
    ),
    _preset(
        "Rising chirplet",
        "wavelet, chirp, rising",
        "A burst whose frequency rises through 150 Hz.",
        Chirplet(150.0, 1500.0, 0.03),
        source=_CHIRPLET,
    ),
    _preset(
        "Contracting train",
        "wavelet, train, contracting, single actuator",
        "Five wavelets from 50 up to 400 Hz: what is felt draws together about the actuator.",
        WaveletTrain(_UP),
        source=_TRAIN,
    ),
    _preset(
        "Expanding train",
        "wavelet, train, expanding, single actuator",
        "Five wavelets from 400 down to 50 Hz: what is felt spreads away from the actuator.",
        WaveletTrain(_UP[::-1]),
        source=_TRAIN,
    ),
    _preset(
        "Contracting train, equal energy",
        "wavelet, train, contracting, single actuator",
        "Five wavelets from 50 up to 400 Hz with the same energy each. Edit > Equal on the skin "
        "makes them equal where they are felt.",
        WaveletTrain(_UP, equalise="energy"),
        source=_TRAIN,
    ),
    _preset(
        "Breathing train",
        "wavelet, train, expanding, contracting, single actuator",
        "Nine wavelets, from 400 down to 50 Hz and back: what is felt spreads and draws together.",
        WaveletTrain((*_UP[::-1], *_UP[1:])),
        source=_TRAIN,
    ),
)


SHIPPED: tuple[Preset, ...] = (*STEADY, *MODULATED, *TOUCHES, *WAVELETS, *MOVING)
