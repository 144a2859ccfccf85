"""What the user designs: plain immutable values, no arrays, no files."""

from dataclasses import dataclass, replace
from typing import Any

from skinsource import choice_words, fields
from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, ListSpec, NumberSpec, RecipeSpec, SwitchSpec, TextSpec
from skinsource.limb import MOST_PLACES
from skinsource.quoting import quoted
from skinsource.scaling.response_scaling import Scaling
from skinsource.waveforms import Tone, Waveform, kinds

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


TITLE = TextSpec(label="Title", longest=200, one_line=True)
AUTHOR = TextSpec(label="Author", longest=200, one_line=True)
NOTES = TextSpec(label="Notes", longest=20_000)
LICENCE = TextSpec(label="Licence", longest=2_000)

# Which places there are is a matter of the limb, which says so when it is asked for one.
PLACE = NumberSpec(label="Place", minimum=1, maximum=MOST_PLACES, whole=True)
WAVEFORM = RecipeSpec(label="Waveform", kinds=kinds)
MUTED = SwitchSpec(label="Mute", hint="A muted input is silent")
SOLO = SwitchSpec(label="Solo", hint="Where any input is solo, only solo inputs are heard")
_MOST = 2**31 - 1
COLOUR = NumberSpec(label="Colour", minimum=0, maximum=_MOST, whole=True)
ID = NumberSpec(label="Id", minimum=0, maximum=_MOST, whole=True)

LIMB = TextSpec(label="Limb", longest=200, one_line=True)
INPUTS = ListSpec(
    label="Inputs", of=RecipeSpec(label="Input", kinds=lambda: (Input,)), most=MAX_INPUTS
)
SCALING = ChoiceSpec(
    label="Scaling", options=tuple((word.name, word.title) for word in choice_words.SCALINGS)
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Input:
    """A waveform placed at an input location.

    Attributes
    ----------
    location
        Input place, from 1; the limb says which places it has, see `Limb.n_inputs`.
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
    id
        What tells it from the other inputs of its design, 1, 2, 3, …; 0: not given yet, the
        design gives it one.
    """

    location: int = fields.field(PLACE)
    waveform: Waveform = fields.field(WAVEFORM, Tone())
    amplitude: float = fields.number(1.0, AMPLITUDE)
    onset_s: float = fields.number(0.0, ONSET)
    muted: bool = fields.switch(False, MUTED)
    solo: bool = fields.switch(False, SOLO)
    colour: int = fields.number(0, COLOUR)
    id: int = fields.number(0, ID)

    def __post_init__(self) -> None:
        fields.check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """Everything that is saved, undone and redone.

    Attributes
    ----------
    limb
        Name of the limb, see `skinsource.load_limb`; it need not be available here.
    inputs
        In the order in which they are listed.  Those without an id get one.
    scaling
        ``"upstream"``, ``"relative"`` or ``"probe"``, see `skinsource.predict`.
    title, author, notes, licence
        Words about the design; nothing is computed from them.
    """

    limb: str = fields.field(LIMB)
    inputs: tuple[Input, ...] = fields.field(INPUTS, ())
    scaling: Scaling = fields.choice("upstream", SCALING)
    title: str = fields.text("", TITLE)
    author: str = fields.text("", AUTHOR)
    notes: str = fields.text("", NOTES)
    licence: str = fields.text("", LICENCE)

    def __post_init__(self) -> None:
        fields.check(self)
        object.__setattr__(self, "inputs", _with_ids(self.inputs))

    @property
    def ids(self) -> tuple[int, ...]:
        """Ids of the inputs, in their order."""
        return tuple(one.id for one in self.inputs)

    def input(self, id: int) -> Input:
        """The input with this id."""
        return self.inputs[self.index_of(id)]

    def index_of(self, id: int) -> int:
        """Where in `inputs` the input with this id is."""
        for index, one in enumerate(self.inputs):
            if one.id == id:
                return index
        known = ", ".join(map(str, self.ids)) or "none"
        raise InvalidInputError(f"no input has the id {quoted(id)}; there are {known}")

    def with_input(self, index: int, **changes: Any) -> "Design":
        """Return a copy in which input ``index`` has ``changes`` applied."""
        inputs = list(self.inputs)
        inputs[index] = replace(inputs[index], **changes)
        return replace(self, inputs=tuple(inputs))

    def adding(self, new: Input) -> "Design":
        """Return a copy with one more input, with an id and a colour of its own."""
        taken = {present.colour for present in self.inputs}
        colour = next(k for k in range(MAX_INPUTS + 1) if k not in taken)
        return replace(self, inputs=(*self.inputs, replace(new, colour=colour, id=0)))

    def without_input(self, index: int) -> "Design":
        """Return a copy without input ``index``."""
        inputs = list(self.inputs)
        del inputs[index]
        return replace(self, inputs=tuple(inputs))


def _with_ids(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Return ``inputs`` with the smallest free ids where there were none; refuse doubles."""
    given = [one.id for one in inputs if one.id]
    if len(set(given)) < len(given):
        raise InvalidInputError(f"ids of the inputs are {given}, expected different ones")
    if len(given) == len(inputs):
        return inputs
    taken = set(given)
    free = (number for number in range(1, 2 * MAX_INPUTS + 1) if number not in taken)
    return tuple(one if one.id else replace(one, id=next(free)) for one in inputs)


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
