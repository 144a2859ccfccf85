"""What is asked before a film of the skin map is written; it begins with what the screen shows."""

from dataclasses import dataclass, replace
from pathlib import Path

from skinsource.design.design import Design
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.export.video import frames_per_s
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs import fields
from skinsource.specs.fields import ChoiceSpec
from skinsource_gui.panels.skin.map_quantity import MAGNITUDE, RMS, STILL, Z
from skinsource_gui.panels.skin.settings import RMS_WINDOW, SKIN, SkinSettings
from skinsource_gui.panels.skin.stage.map_layout import HAND, SeenPart
from skinsource_gui.panels.skin.time.pace import PACES, pace_of
from skinsource_gui.widgets.pan_zoom import WHOLE
from skinsource_gui.widgets.pictures.picture_options import PictureOptions

#: What a film can be written as, in words and as names of files end.
KINDS = (("MP4", ".mp4"), ("WebM", ".webm"), ("GIF", ".gif"))
#: The part of the map that is in sight, whichever that is.
SEEN = "seen"

KIND = ChoiceSpec(
    label="Format",
    options=tuple((ending, words) for words, ending in KINDS),
    hint="MP4 plays nearly everywhere; a GIF is far larger, with 50 frames per second, not 60",
)
SHOWN = ChoiceSpec(
    label="Shown",
    options=((Z, "Along z"), (MAGNITUDE, "Magnitude"), (RMS, "Sliding RMS")),
    hint="The acceleration along z with its sign, the length of the acceleration, or its RMS over "
    "a window",
)
PART = ChoiceSpec(
    label="Part",
    options=((SEEN, "As on screen"), (HAND, "Hand"), (WHOLE, "Hand and arm")),
    hint="What part of the map is seen",
)
PACE = ChoiceSpec(
    label="Speed",
    options=tuple((f"{pace}", f"1/{pace}") for pace in PACES),
    hint="How fast time runs in the film",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmOptions(PictureOptions):
    """What a film shows, how slowly, and as which kind of file.

    Attributes
    ----------
    quantity, rms_window_s
        What is shown: `Z`, `MAGNITUDE` or `RMS`; what the RMS is taken over.
    part
        `SEEN`, `HAND` or `WHOLE`.
    pace
        How many times slower it shall run than it happens.
    kind
        How its name ends.
    """

    quantity: str = fields.choice(Z, SHOWN)
    rms_window_s: float = fields.number(0.02, RMS_WINDOW)
    part: str = fields.choice(SEEN, PART)
    pace: str = fields.choice("20", PACE)
    kind: str = fields.choice(".mp4", KIND)

    @property
    def unused(self) -> frozenset[str]:
        return frozenset() if self.quantity == RMS else frozenset({"rms_window_s"})

    @property
    def frames_per_s(self) -> int:
        """Of a film of this kind."""
        return frames_per_s(Path(f"film{self.kind}"))

    def part_of(self, seen: SeenPart) -> SeenPart:
        """Which part of the map is filmed, where ``seen`` is in sight."""
        return seen if self.part == SEEN else SeenPart(fit=self.part)

    def view_of(self, view: View) -> View:
        """The view that shows what is filmed."""
        shown = replace(
            settings_of(view, SKIN, SkinSettings),
            quantity=self.quantity,
            rms_window_s=self.rms_window_s,
        )
        return with_settings(replace(view, slow_motion=float(self.pace)), SKIN, shown)


def film_options(design: Design, view: View, sizes: PictureOptions) -> FilmOptions:
    """What the screen shows, as large as ``sizes`` say and of the kind that was chosen last.

    Where the screen shows what is the same at any time, it is the motion along z, or its magnitude
    on a limb that is not measured along z; faster than its waves can be followed, as fast as they
    can.
    """
    limb = facts_of(design.limb)
    settings = settings_of(view, SKIN, SkinSettings)
    if settings.quantity in STILL:
        settings = replace(settings, quantity=Z if Z in limb.axes else MAGNITUDE)
    last = sizes if isinstance(sizes, FilmOptions) else FilmOptions()
    pace = pace_of(view, settings, last.frames_per_s, limb)
    return replace(
        last,
        layout=sizes.layout,
        width_px=sizes.width_px,
        height_px=sizes.height_px,
        dpi=sizes.dpi,
        colours=sizes.colours,
        quantity=settings.quantity,
        rms_window_s=settings.rms_window_s,
        part=SEEN,
        pace=next((f"{one}" for one in PACES if one >= pace), f"{PACES[-1]}"),
    )
