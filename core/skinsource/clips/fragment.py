"""A piece of a design: some clips of some tracks, to be put in elsewhere."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.clips.clip import Clip
from skinsource.fields import ListSpec, NumberSpec, RecipeSpec
from skinsource.limb import MOST_PLACES

#: Clips of one track, and tracks of one design.
MAX_CLIPS, MAX_TRACKS = 1000, 100

PLACE = NumberSpec(label="Place", minimum=1, maximum=MOST_PLACES, whole=True)
AMPLITUDE = NumberSpec(label="Amplitude", minimum=-1000.0, maximum=1000.0)
OFFSET = NumberSpec(label="Tracks below the first", minimum=0, maximum=MAX_TRACKS, whole=True)
CLIPS = ListSpec(
    label="Clips", of=RecipeSpec(label="Clip", kinds=lambda: (Clip,)), fewest=1, most=MAX_CLIPS
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
    of=RecipeSpec(label="Lane", kinds=lambda: (Lane,)),
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
