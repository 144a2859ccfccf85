"""Tones and noise: what is steady while it lasts."""

from skinsource.presets.preset import Preset
from skinsource.presets.shipped.making import preset
from skinsource.waveforms import Noise, Tone

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


def _tone(hz: float, words: str, source: str, tags: str = "") -> Preset:
    return preset(
        f"Tone {hz:g} Hz",
        f"tone, steady, {tags}",
        f"Half a second of a sine of {hz:g} Hz with soft edges. {words}",
        Tone(hz, duration_s=_LENGTH_S),
        source=source,
    )


def _texture(name: str, seed: int, low_hz: float, high_hz: float, words: str) -> Preset:
    return preset(
        name,
        "noise, texture, steady",
        f"Noise of {low_hz:g} to {high_hz:g} Hz for half a second. {words}",
        Noise(seed, _LENGTH_S, low_hz, high_hz),
        source=_TEXTURE,
    )


STEADY: tuple[Preset, ...] = (
    _tone(30.0, "Felt as flutter.", _TALBOT, "flutter, low"),
    _tone(50.0, "Felt between flutter and vibration; it travels far.", _TALBOT, "low"),
    _tone(100.0, "Felt as vibration.", _TALBOT),
    _tone(150.0, "A usual frequency of small actuators.", "Our choice."),
    _tone(200.0, "Where the skin begins to be most sensitive.", _BOLANOWSKI),
    _tone(250.0, "About where the skin is most sensitive.", _BOLANOWSKI, "high"),
    _texture("Rough texture", 1, 25.0, 100.0, "As of coarse weave."),
    _texture("Medium texture", 2, 100.0, 250.0, "As of cloth."),
    _texture("Fine texture", 3, 250.0, 600.0, "As of paper."),
    _texture("Noise of the whole band", 4, 25.0, 600.0, "All that was measured, at once."),
)
