"""What the user designs: plain immutable values, no arrays, no files."""

from dataclasses import dataclass, replace
from typing import Any

from skinsource import fields
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource.limb import check_input_location
from skinsource.response_scaling import Scaling, check_scaling
from skinsource.waveforms import Tone, Waveform

#: More inputs than places are allowed; a hundred of them are a mistake.
MAX_INPUTS = 100

AMPLITUDE = NumberSpec(
    label="Amplitude",
    minimum=-1000.0,
    maximum=1000.0,
    step=0.05,
    hint="A negative amplitude turns the polarity",
)
ONSET = NumberSpec(
    label="Onset", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="When the input starts"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Input:
    """A waveform placed at an input location.

    Attributes
    ----------
    location
        Input place, 1 to 20.
    waveform
        What it plays.
    amplitude
        Factor; its unit follows from the design's scaling, see `amplitude_unit`.
    onset_s
        When it starts.
    muted, solo
        A muted input is silent.  Where any input is solo, only solo inputs are heard.
    colour
        Number of its colour; kept for its life, so that the others keep theirs.
    """

    location: int
    waveform: Waveform = Tone()
    amplitude: float = fields.number(1.0, AMPLITUDE)
    onset_s: float = fields.number(0.0, ONSET)
    muted: bool = False
    solo: bool = False
    colour: int = 0

    def __post_init__(self) -> None:
        check_input_location(self.location)
        if not isinstance(self.waveform, Waveform):
            raise InvalidInputError(
                f"waveform is {self.waveform!r}, expected a recipe of skinsource.waveforms"
            )
        fields.check(self)
        if not (isinstance(self.muted, bool) and isinstance(self.solo, bool)):
            raise InvalidInputError(
                f"muted and solo are {self.muted!r} and {self.solo!r}, expected True or False"
            )
        if not isinstance(self.colour, int) or not 0 <= self.colour < 2**31:
            raise InvalidInputError(f"colour is {self.colour!r}, expected 0, 1, 2, …")


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """Everything that is saved, undone and redone.

    Each field is a source of the evaluation graph, under its own name.

    Attributes
    ----------
    limb
        Name of the limb, see `skinsource.load_limb`.
    inputs
        In the order in which they were placed.
    scaling
        ``"upstream"``, ``"relative"`` or ``"probe"``, see `skinsource.predict`.
    """

    limb: str
    inputs: tuple[Input, ...] = ()
    scaling: Scaling = "upstream"

    def __post_init__(self) -> None:
        check_scaling(self.scaling)
        if not isinstance(self.limb, str):
            raise InvalidInputError(f"limb is {self.limb!r}, expected the name of a limb")
        if not (
            isinstance(self.inputs, tuple) and all(isinstance(one, Input) for one in self.inputs)
        ):
            raise InvalidInputError(f"inputs are {self.inputs!r}, expected a tuple of Input")
        if len(self.inputs) > MAX_INPUTS:
            raise InvalidInputError(
                f"the design has {len(self.inputs)} inputs, expected at most {MAX_INPUTS}"
            )

    def with_input(self, index: int, **changes: Any) -> "Design":
        """Return a copy in which input ``index`` has ``changes`` applied."""
        inputs = list(self.inputs)
        inputs[index] = replace(inputs[index], **changes)
        return replace(self, inputs=tuple(inputs))

    def adding(self, new: Input) -> "Design":
        """Return a copy with one more input, in the first colour that is free."""
        taken = {present.colour for present in self.inputs}
        colour = next(k for k in range(MAX_INPUTS + 1) if k not in taken)
        return replace(self, inputs=(*self.inputs, replace(new, colour=colour)))

    def without_input(self, index: int) -> "Design":
        """Return a copy without input ``index``."""
        inputs = list(self.inputs)
        del inputs[index]
        return replace(self, inputs=tuple(inputs))


def audible_indices(inputs: tuple[Input, ...]) -> tuple[int, ...]:
    """Places in ``inputs`` of those that are heard: the solo ones, if any, but no muted ones."""
    any_solo = any(one.solo for one in inputs)
    return tuple(
        index for index, one in enumerate(inputs) if not one.muted and (one.solo or not any_solo)
    )


def audible_inputs(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Inputs that are heard."""
    return tuple(inputs[index] for index in audible_indices(inputs))


def amplitude_unit(scaling: Scaling) -> str:
    """Unit of an input's amplitude: m/s², or × for a plain factor."""
    return "×" if scaling == "relative" else "m/s²"


def start_design(limb: str) -> Design:
    """Design of the first window: a 100 Hz tone on the pad of digit II (input 7)."""
    return Design(limb=limb, inputs=(Input(location=7, waveform=Tone(frequency_hz=100.0)),))
