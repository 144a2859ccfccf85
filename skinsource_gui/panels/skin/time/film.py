"""Which instants a film of the skin map shows, and how large its frames are."""

from dataclasses import dataclass

from skinsource.base.errors import InvalidInputError
from skinsource.design.view import View
from skinsource.limbs.limb import LimbFacts
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.skin.time.pace import pace_of
from skinsource_gui.widgets.pictures.layouts import PER_INCH
from skinsource_gui.widgets.pictures.picture_options import PictureOptions

#: The most pixels on a side that encoders take.
MOST_PX = 4096
#: Ten minutes of a film.
MOST_FRAMES = 36_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Film:
    """Which instants are shown, and how fast.

    Attributes
    ----------
    begin_s, count
        The first instant, and how many there are.
    frames_per_s, slow_motion
        Of the film; how many times slower it runs than it happens.
    """

    begin_s: float
    count: int
    frames_per_s: int
    slow_motion: float

    def time_s(self, number: int) -> float:
        """Instant of a frame, from 0 on."""
        return self.begin_s + number / (self.frames_per_s * self.slow_motion)

    @property
    def duration_s(self) -> float:
        """How long it plays."""
        return self.count / self.frames_per_s


def film_of(view: View, settings: SkinSettings, end_s: float, per_s: int, limb: LimbFacts) -> Film:
    """The film of what the time axes show, of all of it where they are not zoomed.

    Raises
    ------
    InvalidInputError
        It would be longer than ten minutes.
    """
    first_s, last_s = view.time_range_s or (0.0, end_s)
    first_s, last_s = min(max(first_s, 0.0), end_s), min(max(last_s, 0.0), end_s)
    pace = pace_of(view, settings, per_s, limb)
    # The last instant belongs to it, however its seconds are rounded.
    count = int((last_s - first_s) * per_s * pace + 1e-6) + 1
    if count > MOST_FRAMES:
        raise InvalidInputError(
            f"The animation from {first_s:g} s to {last_s:g} s at 1/{pace:g} has {count} frames, "
            f"expected at most {MOST_FRAMES}: {MOST_FRAMES / per_s / 60:g} minutes. Zoom the time "
            "axes to a shorter piece, or choose another speed."
        )
    return Film(begin_s=first_s, count=count, frames_per_s=per_s, slow_motion=pace)


def frame_size(options: PictureOptions) -> tuple[int, int]:
    """Width and height of a frame, px: even ones, as encoders want them.

    Raises
    ------
    InvalidInputError
        It is larger than encoders take.
    """
    scale = options.dpi / PER_INCH
    sides = [max(2 * round(one * scale / 2), 2) for one in (options.width_px, options.height_px)]
    if max(sides) > MOST_PX:
        raise InvalidInputError(
            f"The animation has {sides[0]} x {sides[1]} pixels, expected at most {MOST_PX} on a "
            "side. Choose a smaller size or resolution."
        )
    return sides[0], sides[1]
