"""Fig. 2: stimuli, and what arrives of them."""

from skinsource.scenes.paper_scene import Scene
from skinsource.scenes.shipped.making import (
    BESIDE,
    MOVING,
    OWN_MEAN_SPECTRA,
    OWN_ROWS,
    MadeScene,
    at,
    made,
    played,
)
from skinsource.waveforms import Noise, Tap, Tone, WaveletTrain

# Ten cycles of 200 Hz, 65 samples; and 200 ms, 260 samples, whatever the frequency.
_TEN_CYCLES = Tone(frequency_hz=200.0, duration_s=0.05)
_FREQUENCIES_HZ = (50.0, 100.0, 200.0, 400.0)
_NOISE = Noise(seed=2024, duration_s=1000 / 1300, low_hz=25.0, high_hz=600.0, window="none")
_NOISE_OUTPUTS = (1, 6, 8, 9, 48, 49, 72)
_OWN_NOISE = (
    "the noise is of this studio's own seed, from 25 to 600 Hz",
    "which outputs are shown",
)

_TRACES = made(
    Scene(
        name="2A",
        title="A tone on a fingertip",
        sentence="Ten cycles of 200 Hz on the pad of digit II run over the hand as a travelling "
        "wave: farther outputs move later and less.",
        inferred=("length and window of the tone", "which outputs are shown"),
        panels=("skin", "traces"),
    ),
    played(1, *at([7], _TEN_CYCLES)),
    turned="frequency",
    axes="z",
    outputs=(28, 30, 33, 35, 38, 52, 57),
    time_range_s=(0.04, 0.18),
    slow_motion=50.0,
    playhead_s=0.08,
    panels={**OWN_ROWS, **MOVING},
)

_FREQUENCIES = made(
    Scene(
        name="2B",
        title="Low frequencies reach farther",
        sentence="A tone of 50 Hz on the pad of digit II moves the whole hand, one of 400 Hz "
        "little more than the finger.",
        labels=tuple(f"{frequency:g} Hz" for frequency in _FREQUENCIES_HZ),
        arrangement="design",
        panels=("skin", "side_by_side"),
    ),
    *(
        played(1, *at([7], Tone(frequency_hz=frequency, duration_s=0.2)))
        for frequency in _FREQUENCIES_HZ
    ),
    turned="frequency",
    method="mag",
    outputs=(30, 43),
    panels=BESIDE,
)

_NOISE_TRACES = made(
    Scene(
        name="2C",
        title="Noise on the little finger",
        sentence="White noise along the little finger arrives as a slower, softer noise at outputs "
        "farther away.",
        inferred=_OWN_NOISE,
        panels=("skin", "traces"),
    ),
    played(2, *at([5], _NOISE)),
    turned="amplitude",
    axes="z",
    outputs=_NOISE_OUTPUTS,
    panels=OWN_ROWS,
)

_NOISE_SPECTRA = made(
    Scene(
        name="2D",
        title="Noise, as spectra",
        sentence="Of the same noise the skin passes on low frequencies more than high ones.",
        inferred=_OWN_NOISE,
        panels=("skin", "spectra"),
    ),
    played(2, *at([5], _NOISE)),
    turned="amplitude",
    axes="x",
    outputs=_NOISE_OUTPUTS,
    panels=OWN_MEAN_SPECTRA,
)

_TAPS = made(
    Scene(
        name="2E",
        title="Four fingers tapped at once",
        sentence="Taps on the pads of digits II to V at the same time reach the whole hand, in "
        "each person differently.",
        inferred=("the same four places for every person",),
        labels=("Limb 2", "Limb 3", "Limb 4"),
        arrangement="design",
        panels=("skin", "side_by_side"),
    ),
    *(played(limb, *at([7, 8, 9, 10], Tap())) for limb in (2, 3, 4)),
    shown=1,
    turned="onset",
    method="mag",
    outputs=(19, 43),
    panels=BESIDE,
)

_INTERFERENCE = made(
    Scene(
        name="2F",
        title="Two inputs interfere",
        sentence="The same tone on the pad and the base of digit III cancels at output 19 and adds "
        "up at output 21.",
        labels=("Input 8", "Input 13", "Both"),
        arrangement="design",
        panels=("skin", "traces", "compare"),
    ),
    *(played(3, *at(places, _TEN_CYCLES)) for places in ([8], [13], [8, 13])),
    shown=2,
    turned="onset",
    axes="x",
    outputs=(19, 21, 24, 32),
    time_range_s=(0.0, 0.16),
    panels={"traces": {"layout": "stacked"}},
)

_CONTRACTION = made(
    Scene(
        name="2H",
        title="A sensation that contracts",
        sentence="Wavelets from 50 to 400 Hz, one after the other on the pad of digit II: window "
        "by window the vibration draws in towards the finger.",
        inferred=(
            "kind, frequencies, lengths and levels of the wavelets",
            "windows of 120 ms from the first arrival on",
        ),
        arrangement="analysis",
        panels=("traces", "windowed"),
    ),
    played(4, *at([7], WaveletTrain())),
    turned="amplitude",
    method="mag",
    outputs=(30, 33, 52),
    windows_cut="length",
    window_s=0.12,
)

STIMULI: tuple[MadeScene, ...] = (
    _TRACES,
    _FREQUENCIES,
    _NOISE_TRACES,
    _NOISE_SPECTRA,
    _TAPS,
    _INTERFERENCE,
    _CONTRACTION,
)
