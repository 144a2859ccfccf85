"""The shipped scenes; their design files lie in the data folder.

``python -m skinsource.studies.scenes`` writes the files anew; the list of data files follows with
``python tests/core/test_shipped_files.py``.  To add a scene, describe it here, and draw its figure
in `skinsource.studies.figures.figures`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import Any

from skinsource.design.clips import Clip
from skinsource.design.comparing import NUMBERS, Snapshot
from skinsource.design.design import Design, Input, track
from skinsource.design.design_file import DesignFile
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.pulses import Impulse, Noise, Tap
from skinsource.design.waveforms.tones import Chirp, Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.limbs.scaling import Scaling
from skinsource.studies.scenes.opened_scene import Scene, design_title

#: The panel that changes numbers in front of an audience.
CONTROLS = "frequency_and_amplitude"
#: The skin as it moves along z, slowed down: for scenes on travelling waves.
MOVING = {"skin": {"quantity": "z"}}
#: A row for each output, relative to its own peak: for scenes with strong and weak outputs.
OWN_ROWS = {"traces": {"layout": "stacked", "relative": True}}
#: Spectra along each axis in a row for each output, relative to its own peak, as amplitudes.
OWN_SPECTRA = {
    "spectra": {
        "layout": "axes",
        "log_magnitude": False,
        "relative": True,
        "frequency_range_hz": (25.0, 600.0),
    }
}
#: The same with each magnitude the mean over ten bins: for noise.
OWN_MEAN_SPECTRA = {"spectra": {**OWN_SPECTRA["spectra"], "averaged": True}}
#: Maps of all designs of a scene, each relative to its own loudest output.
EACH_TO_ITS_MAXIMUM = {"compare": {"own_maximum": True}}
#: Whether outputs grow in proportion to inputs, and whether inputs add up.
LINEARITY = {"analysis": {"shown": "linearity"}}
#: Maps of the design along each axis.
EACH_AXIS = {"compare": {"of": "axes"}}


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeScene:
    """A scene and the content of its file."""

    scene: Scene
    content: DesignFile


def design_on(
    limb: int,
    *inputs: Input,
    scaling: Scaling = "upstream",
) -> Design:
    """Return a design on one of the measured limbs."""
    return Design(limb=f"measured-{limb}", inputs=inputs, scaling=scaling)


def tracks_at(
    places: Sequence[int], waveform: Waveform, amplitude: float = 1.0
) -> tuple[Input, ...]:
    """Return tracks that play the same waveform at some places, at once."""
    return tuple(
        track(place, waveform, amplitude=amplitude, colour=rank)
        for rank, place in enumerate(places)
    )


def made_scene(
    scene: Scene,
    *designs: Design,
    shown: int = 0,
    control: str = "all",
    panels: Mapping[str, Mapping[str, Any]] | None = None,
    **view: Any,
) -> MadeScene:
    """Return a scene and the content of its file.

    Parameters
    ----------
    scene
        Description of the scene; it has a label for each design.
    designs
        Designs that it compares, in the order of the figure: snapshots, and one more where there
        is no number left for it.
    shown
        Index of the design that the window opens; that without a number, if there is one.
    control
        The number that the scene is about, of those that the panel for presenting can show.
    panels
        Settings of panels, by their names.
    view
        Fields of `View`.
    """
    if len(designs) != len(scene.labels):
        raise ValueError(f"{scene.name}: {len(designs)} designs, {len(scene.labels)} labels")
    if len(designs) > len(NUMBERS) and shown != len(designs) - 1 == len(NUMBERS):
        raise ValueError(f"{scene.name}: of {len(designs)} designs the last one must be shown")
    titled = tuple(_titled(scene, design, k) for k, design in enumerate(designs))
    snapshots: tuple[Snapshot, ...] = ()
    if len(titled) > 1:
        # The latest snapshot is the one that the window shows.
        ordered = sorted(range(len(titled)), key=lambda k: k == shown)
        snapshots = tuple(
            Snapshot(number=NUMBERS[k], design=titled[k]) for k in ordered if k < len(NUMBERS)
        )
    settings = {**(panels or {}), CONTROLS: {"control": control}}
    stored = tuple((name, tuple(setting.items())) for name, setting in settings.items())
    opened = View(snapshots=snapshots, panels=stored, **view)
    return MadeScene(scene=scene, content=DesignFile(design=titled[shown], view=opened))


def _titled(scene: Scene, design: Design, rank: int) -> Design:
    return replace(design, title=design_title(scene, scene.labels[rank]), notes=scene.notes)


# Figs. 4 and 5: what the model predicts where the paper measured, and what linearity means.

_PREDICTED = Tone(frequency_hz=104.0, duration_s=10 / 104)
_PREDICTION_ONLY = "only the prediction: the measurement of the paper is not public"

_FRAMES = made_scene(
    Scene(
        name="4A",
        title="A tone as it travels, predicted",
        sentence="Ten cycles of 104 Hz on the pad of digit III, quarter by quarter of a cycle: "
        "crests and troughs normal to the skin run towards the wrist.",
        inferred=(_PREDICTION_ONLY, "window of the tone", "which instants are shown"),
        panels=("skin", "traces"),
    ),
    design_on(1, *tracks_at([8], _PREDICTED)),
    control="frequency",
    axes="z",
    outputs=(20, 24, 26, 27, 48),
    playhead_s=0.1,
    time_range_s=(0.04, 0.2),
    slow_motion=50.0,
    panels=MOVING,
)

_TRACES = made_scene(
    Scene(
        name="4B",
        title="The same tone as traces, predicted",
        sentence="The same tone at outputs from the fingertip to the wrist.",
        inferred=(_PREDICTION_ONLY, "window of the tone", "which outputs are shown"),
        panels=("skin", "traces"),
    ),
    design_on(1, *tracks_at([8], _PREDICTED)),
    control="frequency",
    axes="z",
    outputs=(20, 24, 26, 27, 48),
    time_range_s=(0.04, 0.2),
    panels=OWN_ROWS,
)

_SPEEDS_MM_PER_S = (5, 10, 20, 40, 80)
_TONES_HZ = (50.0, 150.0, 300.0)
_BY_CONSTRUCTION = "identical by construction: the model is linear"


def _tones(speed_mm_per_s: float) -> Input:
    """Return a track with three tones one after the other, of the same velocity."""
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
    return made_scene(
        Scene(
            name=name,
            title=f"Five strengths of three tones, limb {limb}",
            sentence="Tones of 50, 150 and 300 Hz at velocities from 5 to 80 mm/s, divided by "
            "their strength: where the skin is linear they lie on each other.",
            inferred=(_BY_CONSTRUCTION, "which outputs are shown", "lengths of the tones"),
            labels=tuple(f"{speed} mm/s" for speed in _SPEEDS_MM_PER_S),
            panels=("skin", "traces", "analysis"),
        ),
        *(design_on(limb, _tones(speed), scaling="probe") for speed in _SPEEDS_MM_PER_S),
        shown=4,
        control="amplitude",
        axes="z",
        outputs=(20, 26),
        panels={
            "traces": {"layout": "stacked"},
            "linearity": {"velocity": True},
            **LINEARITY,
        },
    )


_SWEEP = Chirp(start_hz=25.0, end_hz=600.0, duration_s=5.0)
_LEVELS = (0.75, 1.5, 3.0, 6.0)
_LEVELS_TEXT = "the four levels, 0.75 to 6 m/s²"


def _sweeps() -> tuple[Design, ...]:
    return tuple(design_on(1, *tracks_at([8], _SWEEP, level), scaling="probe") for level in _LEVELS)


def _fit(
    name: str, title: str, sentence: str, *inferred: str, every_output: bool = False
) -> MadeScene:
    return made_scene(
        Scene(
            name=name,
            title=title,
            sentence=sentence,
            inferred=(_BY_CONSTRUCTION, _LEVELS_TEXT, *inferred),
            labels=tuple(f"{level:g} m/s²" for level in _LEVELS),
            panels=("skin", "traces", "analysis"),
        ),
        *_sweeps(),
        shown=3,
        control="amplitude",
        axes="z",
        outputs=(20, 26),
        panels={
            "spectra": {"frequency_range_hz": (25.0, 600.0)},
            "linearity": {"bands": True, "every_output": every_output},
            **LINEARITY,
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

_SUPERPOSITION = made_scene(
    Scene(
        name="5F",
        title="Separate and joint",
        sentence="The sweep on the pad and the base of digit III: what both cause together is the "
        "sum of what each causes alone.",
        inferred=("exact by construction: the model is linear", "level of the sweep, 3 m/s²"),
        labels=("Input 8", "Input 13", "Both"),
        panels=("skin", "traces", "analysis"),
    ),
    *(
        design_on(1, *tracks_at(places, _SWEEP, 3.0), scaling="probe")
        for places in ([8], [13], [8, 13])
    ),
    shown=2,
    control="amplitude",
    axes="z",
    outputs=(20, 26),
    panels=LINEARITY,
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


# Fig. 1: what the skin does after a single pulse.

_ALONG_DIGIT_III = (20, 24, 26, 27, 48, 49, 72)
_PULSE = Impulse()


_IMPULSE_RESPONSES_TRACES = made_scene(
    Scene(
        name="1C",
        title="A pulse runs down the hand",
        sentence="A pulse on the pad of digit III arrives later and longer at outputs along the "
        "back of the hand and arm; within 3 ms it leaves the finger.",
        inferred=("each trace relative to its own peak",),
        panels=("skin", "traces"),
    ),
    design_on(4, *tracks_at([8], _PULSE), scaling="relative"),
    control="onset",
    axes="z",
    outputs=_ALONG_DIGIT_III,
    time_range_s=(0.045, 0.15),
    slow_motion=100.0,
    playhead_s=0.055,
    panels={**OWN_ROWS, **MOVING},
)

_SPECTRA = made_scene(
    Scene(
        name="1D",
        title="High frequencies stay near the finger",
        sentence="Spectra of the same responses: the farther from the pulse, the less is left of "
        "high frequencies.",
        panels=("skin", "spectra"),
    ),
    design_on(4, *tracks_at([8], _PULSE), scaling="relative"),
    control="amplitude",
    axes="z",
    outputs=_ALONG_DIGIT_III,
    panels=OWN_SPECTRA,
)

_AXES = made_scene(
    Scene(
        name="1E",
        title="One pulse, three axes",
        sentence="A pulse along digit III moves the skin on all three axes of the sensors, each "
        "with a pattern of its own.",
        inferred=("one colour scale for the three maps",),
        arrangement="design",
        panels=("skin", "compare"),
    ),
    design_on(3, *tracks_at([3], _PULSE), scaling="relative"),
    control="amplitude",
    axes="z",
    panels=EACH_AXIS,
)

_PLACES = made_scene(
    Scene(
        name="1F",
        title="Where the pulse is given",
        sentence="The same pulse at the pad of digit III, at its base and on the palm reaches "
        "other parts of the hand.",
        inferred=("which three places: 8, 13 and 18",),
        labels=("Pad 8", "Base 13", "Palm 18"),
        arrangement="design",
        panels=("skin", "compare"),
    ),
    *(design_on(1, *tracks_at([place], _PULSE), scaling="relative") for place in (8, 13, 18)),
    control="amplitude",
    panels=EACH_TO_ITS_MAXIMUM,
    method="mag",
)

_PEOPLE = made_scene(
    Scene(
        name="1G",
        title="Four people",
        sentence="The same pulse on the pad of digit III of four people: hands differ in how far "
        "they carry it.",
        labels=("Limb 1", "Limb 2", "Limb 3", "Limb 4"),
        arrangement="design",
        panels=("skin", "compare"),
    ),
    *(design_on(limb, *tracks_at([8], _PULSE), scaling="relative") for limb in (1, 2, 3, 4)),
    control="amplitude",
    panels=EACH_TO_ITS_MAXIMUM,
    method="mag",
)

IMPULSE_RESPONSES: tuple[MadeScene, ...] = (
    _IMPULSE_RESPONSES_TRACES,
    _SPECTRA,
    _AXES,
    _PLACES,
    _PEOPLE,
)


# Fig. 2: stimuli, and what arrives of them.

# Ten cycles of 200 Hz, 65 samples; and 200 ms, 260 samples, whatever the frequency.
_TEN_CYCLES = Tone(frequency_hz=200.0, duration_s=0.05)
_FREQUENCIES_HZ = (50.0, 100.0, 200.0, 400.0)
_NOISE = Noise(seed=2024, duration_s=1000 / 1300, low_hz=25.0, high_hz=600.0, window="none")
_NOISE_OUTPUTS = (1, 6, 8, 9, 48, 49, 72)
_OWN_NOISE = (
    "the noise is of this studio's own seed, from 25 to 600 Hz",
    "which outputs are shown",
)

_STIMULI_TRACES = made_scene(
    Scene(
        name="2A",
        title="A tone on a fingertip",
        sentence="Ten cycles of 200 Hz on the pad of digit II run over the hand as a travelling "
        "wave: farther outputs move later and less.",
        inferred=("length and window of the tone", "which outputs are shown"),
        panels=("skin", "traces"),
    ),
    design_on(1, *tracks_at([7], _TEN_CYCLES)),
    control="frequency",
    axes="z",
    outputs=(28, 30, 33, 35, 38, 52, 57),
    time_range_s=(0.04, 0.18),
    slow_motion=50.0,
    playhead_s=0.08,
    panels={**OWN_ROWS, **MOVING},
)

_FREQUENCIES = made_scene(
    Scene(
        name="2B",
        title="Low frequencies reach farther",
        sentence="A tone of 50 Hz on the pad of digit II moves the whole hand, one of 400 Hz "
        "little more than the finger.",
        labels=tuple(f"{frequency:g} Hz" for frequency in _FREQUENCIES_HZ),
        arrangement="design",
        panels=("skin", "compare"),
    ),
    *(
        design_on(1, *tracks_at([7], Tone(frequency_hz=frequency, duration_s=0.2)))
        for frequency in _FREQUENCIES_HZ
    ),
    control="frequency",
    method="mag",
    outputs=(30, 43),
)

_NOISE_TRACES = made_scene(
    Scene(
        name="2C",
        title="Noise on the little finger",
        sentence="White noise along the little finger arrives as a slower, softer noise at outputs "
        "farther away.",
        inferred=_OWN_NOISE,
        panels=("skin", "traces"),
    ),
    design_on(2, *tracks_at([5], _NOISE)),
    control="amplitude",
    axes="z",
    outputs=_NOISE_OUTPUTS,
    panels=OWN_ROWS,
)

_NOISE_SPECTRA = made_scene(
    Scene(
        name="2D",
        title="Noise, as spectra",
        sentence="Of the same noise the skin passes on low frequencies more than high ones.",
        inferred=_OWN_NOISE,
        panels=("skin", "spectra"),
    ),
    design_on(2, *tracks_at([5], _NOISE)),
    control="amplitude",
    axes="x",
    outputs=_NOISE_OUTPUTS,
    panels=OWN_MEAN_SPECTRA,
)

_TAPS = made_scene(
    Scene(
        name="2E",
        title="Four fingers tapped at once",
        sentence="Taps on the pads of digits II to V at the same time reach the whole hand, in "
        "each person differently.",
        inferred=("the same four places for every person",),
        labels=("Limb 2", "Limb 3", "Limb 4"),
        arrangement="design",
        panels=("skin", "compare"),
    ),
    *(design_on(limb, *tracks_at([7, 8, 9, 10], Tap())) for limb in (2, 3, 4)),
    shown=1,
    control="onset",
    method="mag",
    outputs=(19, 43),
)

_INTERFERENCE = made_scene(
    Scene(
        name="2F",
        title="Two inputs interfere",
        sentence="The same tone on the pad and the base of digit III cancels at output 19 and adds "
        "up at output 21.",
        labels=("Input 8", "Input 13", "Both"),
        arrangement="design",
        panels=("skin", "traces", "compare"),
    ),
    *(design_on(3, *tracks_at(places, _TEN_CYCLES)) for places in ([8], [13], [8, 13])),
    shown=2,
    control="onset",
    axes="x",
    outputs=(19, 21, 24, 32),
    time_range_s=(0.0, 0.16),
    panels={"traces": {"layout": "stacked"}},
)

_CONTRACTION = made_scene(
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
        panels=("traces", "analysis"),
    ),
    design_on(4, *tracks_at([7], WaveletTrain())),
    control="amplitude",
    method="mag",
    outputs=(30, 33, 52),
    panels={"analysis": {"shown": "windowed"}},
    windows_cut="length",
    window_s=0.12,
)

STIMULI: tuple[MadeScene, ...] = (
    _STIMULI_TRACES,
    _FREQUENCIES,
    _NOISE_TRACES,
    _NOISE_SPECTRA,
    _TAPS,
    _INTERFERENCE,
    _CONTRACTION,
)


SHIPPED: tuple[MadeScene, ...] = (*IMPULSE_RESPONSES, *STIMULI, *CHECKS)
