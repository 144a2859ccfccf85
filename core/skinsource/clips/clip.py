"""A waveform on a track: from when on, how strong, through which effects."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.effects import Effect, effect_kinds, placed, played, played_s
from skinsource.effects.places import LONGEST_S
from skinsource.errors import InvalidInputError
from skinsource.fields import ListSpec, NumberSpec, RecipeSpec, SwitchSpec, TextSpec
from skinsource.synthesis.kind_registry import first_kind, known_kinds
from skinsource.synthesis.waveform import Waveform

#: Effects in the chain of one clip.
MAX_EFFECTS = 32

ONSET = NumberSpec(
    label="Onset", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="When the clip starts"
)
GAIN = NumberSpec(
    label="Gain",
    minimum=-1000.0,
    maximum=1000.0,
    step=0.05,
    hint="How strong beside the other clips of its track; a negative gain turns the polarity",
)
WAVEFORM = RecipeSpec(label="Waveform", kinds=known_kinds)
EFFECT_LIST = ListSpec(
    label="Effects",
    of=RecipeSpec(label="Effect", kinds=effect_kinds),
    most=MAX_EFFECTS,
)
MUTED = SwitchSpec(label="Mute", hint="A muted clip is silent")
LABEL = TextSpec(label="Label", longest=200, one_line=True)
ID = NumberSpec(label="Id", minimum=0, maximum=2**31 - 1, whole=True, asked=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Clip:
    """A waveform on a track.

    Attributes
    ----------
    onset_s
        When it starts, exactly: it is sampled at its own instants, wherever samples lie.
    gain
        Factor beside the other clips of the track.
    waveform
        What it plays; a tone, unless told otherwise.
    effects
        What is done to that, one after the other.
    muted
        A muted clip is silent, and takes no part in anything.
    label
        Words of the user.
    id
        What tells it from the other clips of its design, 1, 2, 3, …; 0: not given yet, the design
        gives it one.
    """

    onset_s: float = fields.number(0.0, ONSET)
    gain: float = fields.number(1.0, GAIN)
    waveform: Waveform = fields.field(WAVEFORM, factory=first_kind)
    effects: tuple[Effect, ...] = fields.field(EFFECT_LIST, ())
    muted: bool = fields.switch(False, MUTED)
    label: str = fields.text("", LABEL)
    id: int = fields.number(0, ID)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.duration_s <= LONGEST_S:
            raise InvalidInputError(
                f"Clip plays {self.duration_s:g} s, expected at most {LONGEST_S:g} s; repeat it "
                "less often, or stretch it less"
            )

    @property
    def duration_s(self) -> float:
        """How long it plays, after its effects."""
        return played_s(self.waveform, self.effects)

    @property
    def end_s(self) -> float:
        """When it ends."""
        return self.onset_s + self.duration_s

    def sampled(self, sample_rate_hz: float, shift_s: float = 0.0) -> tuple[int, Floats]:
        """Sample at or before its onset, and what it plays from there on, before its gain.

        ``shift_s`` later than it says: less than a sample.
        """
        first, own_shift_s = placed(
            self.waveform, self.effects, self.onset_s + shift_s, sample_rate_hz
        )
        return first, played(self.waveform, self.effects, sample_rate_hz, own_shift_s)
