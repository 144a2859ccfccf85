"""Fig. 1: what the skin does after a single pulse."""

from skinsource.scenes.paper_scene import Scene
from skinsource.scenes.shipped.making import (
    AXES_BESIDE,
    EACH_TO_ITS_MAXIMUM,
    MOVING,
    OWN_ROWS,
    OWN_SPECTRA,
    MadeScene,
    at,
    made,
    played,
)
from skinsource.waveforms import Impulse

_ALONG_DIGIT_III = (20, 24, 26, 27, 48, 49, 72)
_PULSE = Impulse()


_TRACES = made(
    Scene(
        name="1C",
        title="A pulse runs down the hand",
        sentence="A pulse on the pad of digit III arrives later and longer at outputs along the "
        "back of the hand and arm; within 3 ms it leaves the finger.",
        inferred=("each trace relative to its own peak",),
        panels=("skin", "traces"),
    ),
    played(4, *at([8], _PULSE), scaling="relative"),
    turned="onset",
    axes="z",
    outputs=_ALONG_DIGIT_III,
    time_range_s=(0.045, 0.15),
    slow_motion=100.0,
    playhead_s=0.055,
    panels={**OWN_ROWS, **MOVING},
)

_SPECTRA = made(
    Scene(
        name="1D",
        title="High frequencies stay near the finger",
        sentence="Spectra of the same responses: the farther from the pulse, the less is left of "
        "high frequencies.",
        panels=("skin", "spectra"),
    ),
    played(4, *at([8], _PULSE), scaling="relative"),
    turned="amplitude",
    axes="z",
    outputs=_ALONG_DIGIT_III,
    panels=OWN_SPECTRA,
)

_AXES = made(
    Scene(
        name="1E",
        title="One pulse, three axes",
        sentence="A pulse along digit III moves the skin on all three axes of the sensors, each "
        "with a pattern of its own.",
        inferred=("one colour scale for the three maps",),
        arrangement="design",
        panels=("skin", "side_by_side"),
    ),
    played(3, *at([3], _PULSE), scaling="relative"),
    turned="amplitude",
    axes="z",
    panels=AXES_BESIDE,
)

_PLACES = made(
    Scene(
        name="1F",
        title="Where the pulse is given",
        sentence="The same pulse at the pad of digit III, at its base and on the palm reaches "
        "other parts of the hand.",
        inferred=("which three places: 8, 13 and 18",),
        labels=("Pad 8", "Base 13", "Palm 18"),
        arrangement="design",
        panels=("skin", "side_by_side"),
    ),
    *(played(1, *at([place], _PULSE), scaling="relative") for place in (8, 13, 18)),
    turned="amplitude",
    panels=EACH_TO_ITS_MAXIMUM,
    method="mag",
)

_PEOPLE = made(
    Scene(
        name="1G",
        title="Four people",
        sentence="The same pulse on the pad of digit III of four people: hands differ in how far "
        "they carry it.",
        labels=("Limb 1", "Limb 2", "Limb 3", "Limb 4"),
        arrangement="design",
        panels=("skin", "side_by_side"),
    ),
    *(played(limb, *at([8], _PULSE), scaling="relative") for limb in (1, 2, 3, 4)),
    turned="amplitude",
    panels=EACH_TO_ITS_MAXIMUM,
    method="mag",
)

IMPULSE_RESPONSES: tuple[MadeScene, ...] = (_TRACES, _SPECTRA, _AXES, _PLACES, _PEOPLE)
