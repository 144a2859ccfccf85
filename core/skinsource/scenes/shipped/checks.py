"""Figs. 4 and 5: what the model predicts where the paper measured, and what linearity means."""

from math import pi

from skinsource.clips import Clip
from skinsource.design import Design, Input
from skinsource.scenes.paper_scene import Scene
from skinsource.scenes.shipped.making import MOVING, OWN_ROWS, MadeScene, at, made, played
from skinsource.waveforms import Chirp, Tone

_PREDICTED = Tone(frequency_hz=104.0, duration_s=10 / 104)
_PREDICTION_ONLY = "only the prediction: the measurement of the paper is not public"

_FRAMES = made(
    Scene(
        name="4A",
        title="A tone as it travels, predicted",
        sentence="Ten cycles of 104 Hz on the pad of digit III, quarter by quarter of a cycle: "
        "crests and troughs normal to the skin run towards the wrist.",
        inferred=(_PREDICTION_ONLY, "window of the tone", "which instants are shown"),
        panels=("skin", "traces"),
    ),
    played(1, *at([8], _PREDICTED)),
    turned="frequency",
    axes="z",
    outputs=(20, 24, 26, 27, 48),
    playhead_s=0.1,
    time_range_s=(0.04, 0.2),
    slow_motion=50.0,
    panels=MOVING,
)

_TRACES = made(
    Scene(
        name="4B",
        title="The same tone as traces, predicted",
        sentence="The same tone at outputs from the fingertip to the wrist.",
        inferred=(_PREDICTION_ONLY, "window of the tone", "which outputs are shown"),
        panels=("skin", "traces"),
    ),
    played(1, *at([8], _PREDICTED)),
    turned="frequency",
    axes="z",
    outputs=(20, 24, 26, 27, 48),
    time_range_s=(0.04, 0.2),
    panels=OWN_ROWS,
)

_SPEEDS_MM_PER_S = (5, 10, 20, 40, 80)
_TONES_HZ = (50.0, 150.0, 300.0)
_BY_CONSTRUCTION = "identical by construction: the model is linear"


def _tones(speed_mm_per_s: float) -> Input:
    """Three tones one after the other, of the same velocity."""
    clips = tuple(
        Clip(
            waveform=Tone(frequency_hz=frequency, duration_s=0.2),
            onset_s=0.4 * k,
            gain=frequency / _TONES_HZ[0],
        )
        for k, frequency in enumerate(_TONES_HZ)
    )
    slowest_m_per_s2 = 2.0 * pi * _TONES_HZ[0] * 1e-3 * speed_mm_per_s
    return Input(location=8, clips=clips, amplitude=slowest_m_per_s2)


def _overlay(name: str, limb: int) -> MadeScene:
    return made(
        Scene(
            name=name,
            title=f"Five strengths of three tones, limb {limb}",
            sentence="Tones of 50, 150 and 300 Hz at velocities from 5 to 80 mm/s, divided by "
            "their strength: where the skin is linear they lie on each other.",
            inferred=(_BY_CONSTRUCTION, "which outputs are shown", "lengths of the tones"),
            labels=tuple(f"{speed} mm/s" for speed in _SPEEDS_MM_PER_S),
            panels=("skin", "traces", "linearity"),
        ),
        *(played(limb, _tones(speed), scaling="probe") for speed in _SPEEDS_MM_PER_S),
        shown=4,
        turned="amplitude",
        axes="z",
        outputs=(20, 26),
        panels={"traces": {"layout": "stacked"}, "linearity": {"velocity": True}},
    )


_SWEEP = Chirp(start_hz=25.0, end_hz=600.0, duration_s=5.0)
_LEVELS = (0.75, 1.5, 3.0, 6.0)
_LEVEL_WORDS = "the four levels, 0.75 to 6 m/s²"


def _sweeps() -> tuple[Design, ...]:
    return tuple(played(1, *at([8], _SWEEP, level), scaling="probe") for level in _LEVELS)


def _fit(
    name: str, title: str, sentence: str, *inferred: str, every_output: bool = False
) -> MadeScene:
    return made(
        Scene(
            name=name,
            title=title,
            sentence=sentence,
            inferred=(_BY_CONSTRUCTION, _LEVEL_WORDS, *inferred),
            labels=tuple(f"{level:g} m/s²" for level in _LEVELS),
            panels=("skin", "traces", "linearity"),
        ),
        *_sweeps(),
        shown=3,
        turned="amplitude",
        axes="z",
        outputs=(20, 26),
        panels={
            "spectra": {"frequency_range_hz": (25.0, 600.0)},
            "linearity": {"bands": True, "every_output": every_output},
        },
    )


_LINE = _fit(
    "5D",
    "Output against input",
    "A sweep from 25 to 600 Hz at four levels: in each band of 2 Hz the output is a straight line "
    "of the input.",
    "which outputs and bands are shown",
)
_FITS = _fit(
    "5E",
    "How straight the lines are",
    "Adjusted R² of those lines over all outputs and bands: 1 where the skin is linear.",
    every_output=True,
)

# Some cycles in the middle of the sweep, as in the figure.
_CYCLES_S = (1.0, 1.05)

_SUPERPOSITION = made(
    Scene(
        name="5F",
        title="Separate and joint",
        sentence="The sweep on the pad and the base of digit III: what both cause together is the "
        "sum of what each causes alone.",
        inferred=("exact by construction: the model is linear", "level of the sweep, 3 m/s²"),
        labels=("Input 8", "Input 13", "Both"),
        panels=("skin", "traces", "linearity"),
    ),
    *(played(1, *at(places, _SWEEP, 3.0), scaling="probe") for places in ([8], [13], [8, 13])),
    shown=2,
    turned="amplitude",
    axes="z",
    outputs=(20, 26),
    time_range_s=_CYCLES_S,
)

CHECKS: tuple[MadeScene, ...] = (
    _FRAMES,
    _TRACES,
    _overlay("5A", 1),
    _overlay("5B", 2),
    _LINE,
    _FITS,
    _SUPERPOSITION,
)
