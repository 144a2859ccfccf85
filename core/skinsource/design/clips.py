"""Clips: what a track plays from when on, and what stands beside it on the ruler."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.published import MOST_PLACES
from skinsource.base.quoting import quoted
from skinsource.design.effects import effect_kinds
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.playing import LONGEST_S, placed, played, played_s
from skinsource.design.waveform import Waveform, first_kind, known_kinds
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec
from skinsource.specs.spec import SwitchSpec, TextSpec

# A waveform on a track: from when on, how strong, through which effects.

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
WAVEFORM = ModelSpec(label="Waveform", kinds=known_kinds)
EFFECT_LIST = ListSpec(
    label="Effects",
    of=ModelSpec(label="Effect", kinds=effect_kinds),
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


# A piece of a design: some clips of some tracks, to be put in elsewhere.

#: Clips of one track, and tracks of one design.
MAX_CLIPS, MAX_TRACKS = 1000, 100

PLACE = NumberSpec(label="Place", minimum=1, maximum=MOST_PLACES, whole=True)
AMPLITUDE = NumberSpec(label="Amplitude", minimum=-1000.0, maximum=1000.0)
OFFSET = NumberSpec(label="Tracks below the first", minimum=0, maximum=MAX_TRACKS, whole=True)
CLIPS = ListSpec(
    label="Clips", of=ModelSpec(label="Clip", kinds=lambda: (Clip,)), fewest=1, most=MAX_CLIPS
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """Clips that lie on one track of a fragment.

    Attributes
    ----------
    location, amplitude
        Those of the track that they were on, for a new one where there is none.
    offset
        How many tracks below the first of the fragment.
    clips
        Their onsets count from the earliest of the fragment.
    """

    location: int = fields.field(PLACE)
    amplitude: float = fields.number(1.0, AMPLITUDE)
    offset: int = fields.number(0, OFFSET)
    clips: tuple[Clip, ...] = fields.field(CLIPS)

    def __post_init__(self) -> None:
        fields.check(self)


LANES = ListSpec(
    label="Lanes",
    of=ModelSpec(label="Lane", kinds=lambda: (Lane,)),
    fewest=1,
    most=MAX_TRACKS,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Fragment:
    """Clips on one or more tracks, as they lie to each other.

    Attributes
    ----------
    lanes
        Track by track, from the top.
    """

    lanes: tuple[Lane, ...] = fields.field(LANES)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """From the earliest onset to the last end."""
        return max(clip.end_s for lane in self.lanes for clip in lane.clips)


# Ids that tell things of a design apart.


def numbered(ids: Sequence[int], what: str) -> tuple[int, ...]:
    """Return ``ids`` with the smallest free numbers where they are 0.

    Raises
    ------
    InvalidInputError
        Two of them are equal; ``what`` they belong to is named.
    """
    given_ids = [number for number in ids if number]
    used = set(given_ids)
    if len(used) < len(given_ids):
        doubled = next(number for number in given_ids if given_ids.count(number) > 1)
        raise InvalidInputError(
            f"ids of the {what} are {quoted(given_ids)}, {doubled} twice; expected different ones"
        )
    if len(given_ids) == len(ids):
        return tuple(ids)
    free = (number for number in count(1) if number not in used)
    return tuple(number or next(free) for number in ids)


# A name for a time.

#: No clip begins later than 600 s, and none without effects plays longer than that.
LATEST_S = 1200.0

TIME = NumberSpec(label="Time", unit="s", minimum=0.0, maximum=LATEST_S, step=0.005)
NAME = TextSpec(label="Name", longest=100, one_line=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker:
    """A name for a time of a design.

    Attributes
    ----------
    time_s
        When.
    name
        What stands there; it may be empty.
    """

    time_s: float = fields.field(TIME)
    name: str = fields.text("", NAME)

    def __post_init__(self) -> None:
        fields.check(self)
