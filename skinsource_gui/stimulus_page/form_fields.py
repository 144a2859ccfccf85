"""What each field of the page of stimuli can be."""

from skinsource.actuators.catalog import names, profile
from skinsource.base.published import SAMPLE_RATE_HZ
from skinsource.design.amplitudes import ARBITRARY_UNIT
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.engine.stimulus import LONGEST_LEAD_IN_S
from skinsource.export.formats.formats import FORMATS
from skinsource.specs.fields import ChoiceSpec, NumberSpec

#: Rates that devices know; any other can be typed.
RATES_HZ = (round(SAMPLE_RATE_HZ), 2000, 8000, 44_100, 48_000, 96_000, 192_000)
OTHER = "other"

FORMAT = ChoiceSpec(
    label="Format",
    options=tuple((one.name, one.title) for one in FORMATS),
    hint="What the file is for",
)
RATE = ChoiceSpec(
    label="Rate",
    options=(
        *((str(rate), f"{rate:,} Hz".replace(",", " ")) for rate in RATES_HZ),
        (OTHER, "Other…"),
    ),
    hint="At the rate of its limb what is exported is what was predicted, "
    f"{SAMPLE_RATE_HZ:g} Hz of the published ones; another rate adds nothing above the measured "
    "band",
)
OTHER_RATE = NumberSpec(
    label="Other rate", unit="Hz", minimum=100, maximum=768_000, step=100, whole=True
)
CHANNELS = ChoiceSpec(
    label="Channels",
    options=(
        ("place", "One for each place"),
        ("input", "One for each track"),
        ("files", "One file for each track"),
    ),
    hint="Tracks at one place add up, unless each has a channel or file of its own",
)
FADE = NumberSpec(label="Fade", unit="s", minimum=0.0, maximum=10.0, step=0.005)
LEAD_IN = NumberSpec(
    label="Lead-in",
    unit="s",
    minimum=0.0,
    maximum=LONGEST_LEAD_IN_S,
    step=0.05,
    hint="Silence before the stimulus, in which it may ring",
)
SCALE = ChoiceSpec(
    label="Full scale",
    options=(("largest", "Largest sample"), ("own", "A drive of…")),
    hint="What the largest number that a device takes stands for; one value for a set of files "
    "keeps their ratio",
)
ACTUATOR = ChoiceSpec(
    label="Actuator",
    options=(("none", "None"), *((name, profile(name).title) for name in names())),
    hint="What stands at each place; starts with what the panel Actuator shows",
)
EQUALISER = ChoiceSpec(
    label="Equaliser",
    options=(
        ("none", "None"),
        ("linear", "Regularised inverse, linear phase"),
        ("minimum", "Regularised inverse, minimum phase"),
    ),
    hint="Makes of the accelerations of the design the volts that the actuators need",
)


def part_spec(design: Design, view: View) -> ChoiceSpec:
    """Which tracks and clips can be exported."""
    options = [("all", "All that is heard")]
    if view.selected_inputs:
        options.append(("tracks", "Selected tracks"))
    if view.selected_clips:
        options.append(("clips", "Selected clips"))
    return ChoiceSpec(label="Plays", options=tuple(options), hint="What takes part")


def time_spec(design: Design) -> ChoiceSpec:
    """Which part of the time can be exported."""
    options = [("whole", "Whole design")]
    if design.loop_s is not None:
        options.append(("loop", "Loop"))
    options.append(("part", "From … to …"))
    return ChoiceSpec(label="Time", options=tuple(options), hint="The part of the design")


def end_s(design: Design) -> float:
    """When the last clip ends."""
    return max((clip.end_s for clip in design.clips), default=1.0)


def time_number(label: str, design: Design) -> NumberSpec:
    """A time within the design."""
    return NumberSpec(label=label, unit="s", minimum=0.0, maximum=end_s(design), step=0.005)


def scale_number(unit: str) -> NumberSpec:
    """A drive, in its unit."""
    return NumberSpec(
        label="Drive at full scale",
        unit=unit if unit in ("V", "m/s²", ARBITRARY_UNIT) else "",
        minimum=0.001,
        maximum=1e6,
        step=0.1,
    )
