"""Clips on tracks, fragments of several tracks, and markers of times."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

from skinsource.base.conventions import MOST_LOCATIONS, Floats
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.design.effects import effect_kinds
from skinsource.design.effects.effect import Effect
from skinsource.design.effects.playing import LONGEST_S, placed, played, played_s
from skinsource.design.waveform import Waveform, first_kind, known_kinds
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, ModelSpec, NumberSpec
from skinsource.specs.spec import SwitchSpec, TextSpec

#: Most effects of one clip.
MAX_EFFECTS = 32

ONSET = NumberSpec(
    label="Onset", unit="s", minimum=0.0, maximum=600.0, step=0.005, hint="When the clip starts"
)
GAIN = NumberSpec(
    label="Gain",
    minimum=-1000.0,
    maximum=1000.0,
    step=0.05,
    hint="Gain relative to other clips of the track; negative inverts polarity",
)
WAVEFORM = ModelSpec(label="Waveform", kinds=known_kinds)
EFFECT_LIST = ListSpec(
    label="Effects",
    of=ModelSpec(label="Effect", kinds=effect_kinds),
    most=MAX_EFFECTS,
)
MUTED = SwitchSpec(label="Mute", hint="A muted clip is silent")
LABEL = TextSpec(label="Label", longest=200, one_line=True)
ID = NumberSpec(label="Id", minimum=0, maximum=2**31 - 1, whole=True, editable=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Clip:
    """A waveform on a track.

    Attributes
    ----------
    onset_s
        Exact start: a clip can start between two samples.
    gain
        Factor relative to the other clips of the track.
    waveform
        Its waveform; by default a tone.
    effects
        Effects on the waveform, one after the other.
    muted
        A muted clip is silent.
    label
        Text of the user.
    id
        Number that is unique among the clips of a design, from 1; 0: the design gives it one.
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
                f"Clip lasts {self.duration_s:g} s, expected at most {LONGEST_S:g} s; repeat it "
                "less often, or stretch it less"
            )

    @property
    def duration_s(self) -> float:
        """Length after its effects."""
        return played_s(self.waveform, self.effects)

    @property
    def end_s(self) -> float:
        """Time of its end."""
        return self.onset_s + self.duration_s

    def sampled(self, sample_rate_hz: float, shift_s: float = 0.0) -> tuple[int, Floats]:
        """Return the sample at or before its onset, and its samples from there on, before its gain.

        ``shift_s`` delays it by less than a sample.
        """
        first, own_shift_s = placed(
            self.waveform, self.effects, self.onset_s + shift_s, sample_rate_hz
        )
        return first, played(self.waveform, self.effects, sample_rate_hz, own_shift_s)


#: Most clips of one lane, and most lanes of a fragment.
MAX_CLIPS, MAX_TRACKS = 1000, 100

# Whether a limb has the place is checked when the limb is used.
PLACE = NumberSpec(label="Place", minimum=1, maximum=MOST_LOCATIONS, whole=True)
AMPLITUDE = NumberSpec(label="Amplitude", minimum=-1000.0, maximum=1000.0)
OFFSET = NumberSpec(label="Tracks below the first", minimum=0, maximum=MAX_TRACKS, whole=True)
CLIPS = ListSpec(
    label="Clips", of=ModelSpec(label="Clip", kinds=lambda: (Clip,)), fewest=1, most=MAX_CLIPS
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane(fields.CheckedModel):
    """The clips on one track of a fragment.

    Attributes
    ----------
    location, amplitude
        Those of the track that the clips were on, in case a new track has to be made.
    offset
        Number of tracks below the first track of the fragment.
    clips
        Their onsets count from the earliest clip of the fragment.
    """

    location: int = fields.field(PLACE)
    amplitude: float = fields.number(1.0, AMPLITUDE)
    offset: int = fields.number(0, OFFSET)
    clips: tuple[Clip, ...] = fields.field(CLIPS)


LANES = ListSpec(
    label="Lanes",
    of=ModelSpec(label="Lane", kinds=lambda: (Lane,)),
    fewest=1,
    most=MAX_TRACKS,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Fragment(fields.CheckedModel):
    """Clips of one or more tracks, to be placed elsewhere; lanes are in the order of tracks."""

    lanes: tuple[Lane, ...] = fields.field(LANES)

    @property
    def duration_s(self) -> float:
        """Time from the earliest onset to the last end."""
        return max(clip.end_s for lane in self.lanes for clip in lane.clips)


def numbered(ids: Sequence[int], what: str) -> tuple[int, ...]:
    """Return ``ids`` with the smallest free numbers in place of 0.

    Raises
    ------
    InvalidInputError
        Two ids are equal; the message names ``what`` they belong to.
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


#: A clip begins at 600 s at the latest, and without effects lasts at most as long.
LATEST_S = 1200.0

TIME = NumberSpec(label="Time", unit="s", minimum=0.0, maximum=LATEST_S, step=0.005)
NAME = TextSpec(label="Name", longest=100, one_line=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Marker(fields.CheckedModel):
    """A name, which may be empty, for a time of a design."""

    time_s: float = fields.field(TIME)
    name: str = fields.text("", NAME)
