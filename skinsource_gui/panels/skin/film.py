"""Which instants a film of the skin map shows, and how large its frames are."""

from dataclasses import dataclass, replace
from math import sqrt
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QSizeF
from PySide6.QtGui import QGuiApplication, QImage, QPainter

from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.base.published import N_OUTPUTS
from skinsource.base.published import axes_text as axis_words
from skinsource.design.design import Design, audible_inputs
from skinsource.design.labels import limb_word
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.engine.time_rules import block_of
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.video import frames_per_s, video_file
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import Findings, Judged, in_short
from skinsource.specs import fields
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.panels.skin.layout import ALL, HAND, VisiblePart
from skinsource_gui.panels.skin.painting import MapContent
from skinsource_gui.panels.skin.picture import Heading, heading_of, paint_picture
from skinsource_gui.panels.skin.settings import (
    MAGNITUDE,
    RMS,
    RMS_WINDOW,
    SKIN,
    STILL,
    SkinSettings,
    Z,
)
from skinsource_gui.panels.skin.time import NEEDS, PACES, Frames, slow_down_factor
from skinsource_gui.plots.colour_maps import DIVERGING
from skinsource_gui.plots.pictures import PER_INCH, PictureOptions, Remark, caption_of, with_caption
from skinsource_gui.plots.small_map import field_image
from skinsource_gui.qt.theme import Theme
from skinsource_gui.qt.wheel import WHOLE

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
    pace = slow_down_factor(view, settings, per_s, limb)
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


# What is asked before a film of the skin map is written; it begins with what the screen shows.

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

    def part_of(self, seen: VisiblePart) -> VisiblePart:
        """Which part of the map is filmed, where ``seen`` is in sight."""
        return seen if self.part == SEEN else VisiblePart(fit=self.part)

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
    pace = slow_down_factor(view, settings, last.frames_per_s, limb)
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


# How a film of the skin map is called, and what is to be known before it is written.

# In names of files.
_CALLED = {Z: "along-z", MAGNITUDE: "magnitude", RMS: "sliding-rms"}
# Bytes of a frame for each million pixels of the map at 1/20: fewer with this power of the speed,
# and for this quantity, more with more outputs.  And for how long the skin moves on.  As films of
# the published limbs came out, most within this factor: the least and the most of it are told.
_BYTES = {".mp4": 4500.0, ".webm": 5000.0, ".gif": 40_000.0}
_WITHIN = 2.0
_USUAL_PACE, _POWER = 20.0, 0.7
_OF_RMS, _AT_REST = 0.4, 0.1
_MOVES_ON_S = 0.15
# The map is so much higher than wide; what lies beside it, scale and words, costs less.
_MAP_SHAPE, _OF_BESIDE = 4 / 3, 0.25


def film_name(design: Design, view: View, options: FilmOptions) -> str:
    """``"skin-map-along-z-1-50.mp4"``: what it shows, and how much slower than it happens."""
    pace = _pace(design, view, options)
    return f"skin-map-{_CALLED[options.quantity]}-1-{pace:g}{options.kind}"


def film_remark(design: Design, view: View, options: FilmOptions) -> Remark:
    """How long it will be, how many frames and about how large; or why there is none."""
    shown = options.view_of(view)
    settings, limb = settings_of(shown, SKIN, SkinSettings), facts_of(design.limb)
    if options.quantity == Z and Z not in limb.axes:
        along = axis_words(limb.axes)
        words = f"This limb was measured along {along}, and not along z: choose another quantity."
        return Remark(words, refuses=True)
    try:
        frame_size(options)
        film = film_of(shown, settings, _end_s(design, view), options.frames_per_s, limb)
    except InvalidInputError as error:
        return Remark(str(error), refuses=True)
    # How long all of it is follows from the clips, and is known within a sample or two.
    about = "about " if view.time_range_s is None else ""
    said = [
        f"{_part_words(view)}: {about}{film.duration_s:.3g} s of film, {film.count} frames, "
        f"{_size_words(_bytes(film, design, options))}."
    ]
    if film.slow_motion != float(options.pace):
        said.append(
            f"It runs at 1/{film.slow_motion:g}: at 1/{options.pace} it would have fewer than two "
            "frames in a period of its fastest waves, and show waves that there are not."
        )
    if view.time_range_s is None:
        said.append("Zoom the traces to film a part.")
    return Remark(" ".join(said))


def _pace(design: Design, view: View, options: FilmOptions) -> float:
    shown = options.view_of(view)
    settings = settings_of(shown, SKIN, SkinSettings)
    return slow_down_factor(shown, settings, options.frames_per_s, facts_of(design.limb))


def _moves_s(design: Design) -> tuple[float, float]:
    """From when until when clips play; what they play is not computed for it."""
    tracks = audible_inputs(design.inputs)
    heard = [clip for track in tracks for clip in track.clips if not clip.muted]
    begin_s = min((clip.onset_s for clip in heard), default=0.0)
    return begin_s, max((clip.end_s for clip in heard), default=0.0)


def _end_s(design: Design, view: View) -> float:
    """When the response ends on the time axis."""
    limb = facts_of(design.limb)
    removed_s = limb.pre_trigger_delay_s if view.delay_removed else 0.0
    end_s = _moves_s(design)[1] + (limb.n_taps - 1) / limb.sample_rate_hz
    return max(end_s - removed_s, 0.0)


def _part_words(view: View) -> str:
    if view.time_range_s is None:
        return "All of the response"
    first_s, last_s = view.time_range_s
    return f"{1e3 * first_s:.0f} to {1e3 * last_s:.0f} ms of the response"


def _bytes(film: Film, design: Design, options: FilmOptions) -> float:
    width, height = frame_size(options)
    map_px = min(width * height, width * width * _MAP_SHAPE, height * height / _MAP_SHAPE)
    counted_px = map_px + _OF_BESIDE * (width * height - map_px)
    begin_s, end_s = _moves_s(design)
    seen_s = min(film.time_s(film.count), end_s + _MOVES_ON_S) - max(film.begin_s, begin_s)
    moving = min(max(seen_s, 0.0) * film.frames_per_s * film.slow_motion, film.count)
    frames = moving + _AT_REST * (film.count - moving)
    each = _BYTES[options.kind] * (_OF_RMS if options.quantity == RMS else 1.0)
    each *= sqrt(facts_of(design.limb).n_outputs / N_OUTPUTS)
    return frames * each * counted_px / 1e6 * (_USUAL_PACE / film.slow_motion) ** _POWER


def _size_words(n_bytes: float) -> str:
    """``"0.5 to 2 MB"``: from the least to the most that is likely, with one digit each."""
    least, most = n_bytes / _WITHIN, n_bytes * _WITHIN
    unit, words = (1e6, "MB") if most >= 0.95e6 else (1e3, "kB")
    told = [float(f"{one / unit:.1g}") for one in (least, most)]
    if unit < 1e6:
        told = [max(one, 1.0) for one in told]
    return f"{told[0]:g} to {told[1]:g} {words}"


# The skin map in time as a file: MP4, WebM or GIF.

#: Width and height of a frame unless another size is asked for, px.
SIZE_PX = (900, 1200)


def export_animation(
    path: Path,
    design: Design,
    view: View,
    *,
    options: FilmOptions | None = None,
    seen: VisiblePart = ALL,
    progress: Progress = silent,
    stop: Stop = never,
    largest_error: float = np.inf,
) -> None:
    """Write the skin map in time, each frame computed at its instant, the stimulus below it.

    ``options`` say what is shown and how slowly, how large and on which ground; what the skin panel
    shows unless given.  The piece is that of the time axes, the colours are those of the panel, and
    ``seen`` is the part of the map that is in sight.

    Raises
    ------
    MissingExtraError
        The extra ``video`` is not installed.
    InvalidInputError
        It would be too long or too large, or the ending of the name is that of no animation.
    StorageError, Stopped
        As `skinsource.export.video`.
    """
    # Frames are no numbers that anyone computes with.
    del largest_error
    options = options or film_options(design, view, _usual_size())
    view = options.view_of(view)
    settings = settings_of(view, SKIN, SkinSettings)
    per_s = frames_per_s(path)
    exported = ExportedDesign(design, view, progress, stop)
    camera = _Camera(exported, settings, options, options.part_of(seen))
    film = film_of(view, settings, camera.end_s, per_s, facts_of(design.limb))
    about = f"SkinSource studio, {camera.words(film)}"
    with video_file(path, camera.size, about, stop) as add:
        for number in range(film.count):
            add(camera.frame(film, number))
            progress(number + 1, film.count, "Drawing frames")


def _usual_size() -> PictureOptions:
    return PictureOptions(width_px=SIZE_PX[0], height_px=SIZE_PX[1])


class _Camera:
    """Draws one frame after another."""

    def __init__(
        self,
        exported: ExportedDesign,
        settings: SkinSettings,
        options: PictureOptions | None = None,
        seen: VisiblePart = ALL,
    ) -> None:
        self._seen = seen
        self._exported, self._settings = exported, settings
        self._options = options or _usual_size()
        self.size = frame_size(self._options)
        findings: Findings = exported.value("validity")
        self._caption = _caption_of(exported, findings)
        self._frames = Frames()
        self._family = QGuiApplication.font().family()
        interpolated = settings.map_style == "interpolated"
        found = exported.values({"limb_map", *({"surface"} if interpolated else ())})
        self._surface = found.get("surface")
        limb = exported.limb
        self._content = MapContent(
            limb_map=found["limb_map"],
            field=None if self._surface is None else field_image(self._surface, limb),
            outputs=exported.view.outputs,
            sensors_shown=settings.sensors_shown,
            px_per_mm=limb.map.hand_length_px / limb.hand_length_mm,
            noisy=next((one.outputs for one in findings if one.name == "noise"), ()),
            synthetic=limb.synthetic,
        )
        self._image = QImage(*self.size, QImage.Format.Format_RGB888)
        self._look(exported.view)

    @property
    def end_s(self) -> float:
        """When the response ends, on the time axis."""
        return self._frames.end_s(self._exported.view)

    def words(self, film: Film) -> str:
        """How fast time runs, and of whom this is."""
        limb = limb_word(self._exported.design.limb).title
        return f"{limb} · 1/{film.slow_motion:g} of real time"

    def frame(self, film: Film, number: int) -> NDArray[np.uint8]:
        """One frame, (rows, columns, 3)."""
        view = replace(self._exported.view, playhead_s=film.time_s(number))
        if self._frames.runs_out(view) or not self._frames.has(view):
            self._look(view)
        shown = self._frames.frame(view, self._settings)
        signed = shown.quantity.signed
        content = replace(
            self._content,
            values=shown.values,
            field_values=None if self._surface is None else self._surface.interpolate(shown.values),
            quantity=shown.quantity,
            value_range=self._frames.value_range(self._settings),
            colours=DIVERGING if signed else self._settings.colours,
        )
        heading = heading_of(self._exported.design, view, shown.quantity)
        pace = f"1/{film.slow_motion:g} of real time"
        heading = replace(heading, details=f"{heading.details} · {pace}")
        self._draw(content, heading)
        rows, columns = self._image.height(), self._image.width()
        lines = np.frombuffer(self._image.constBits(), np.uint8)
        return lines.reshape(rows, self._image.bytesPerLine())[:, : 3 * columns].reshape(
            rows, columns, 3
        )

    def _draw(self, content: MapContent, heading: Heading) -> None:
        options = self._options

        def draw(painter: QPainter, width: int, height: int, theme: Theme) -> None:
            size = QSizeF(width, height)
            paint_picture(painter, size, content, heading, theme, self._family, self._seen)

        painter = QPainter(self._image)
        width, height = self.size
        painter.scale(width / options.width_px, height / options.height_px)
        font = painter.font()
        font.setFamily(self._family)
        painter.setFont(font)
        with_caption(draw, self._caption)(
            painter, options.width_px, options.height_px, options.theme
        )
        painter.end()

    def _look(self, view: View) -> None:
        name = self._settings.quantity
        block = block_of(view.playhead_s)
        found = self._exported.values({NEEDS[name]}, moving_block=block)
        self._frames.take(found, name, view)


def _caption_of(exported: ExportedDesign, findings: Findings) -> str:
    """Stimulus, limb, and conditions of the measurement that are not kept."""
    design, note = exported.design, exported.limb.note
    judged = Judged(label=limb_word(design.limb).title, note=note, findings=findings)
    return caption_of(design, notes=in_short([judged]))
