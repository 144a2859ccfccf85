"""The skin map in time as a file (MP4, WebM or GIF): its options and its frames."""

from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6 import QtGui
from PySide6.QtCore import QSizeF

from skinsource.base.conventions import axes_text
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.design.design import Design, View, played_clips
from skinsource.design.labels import limb_label
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.evaluation import evaluate
from skinsource.engine.loops import PICTURES_PER_PERIOD, SHOWN_HZ, first_onset_s, loop_of
from skinsource.engine.time_rules import block_of
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.video import frames_per_s, video_file
from skinsource.limbs.limb import LimbFacts
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import Findings, Judged, in_short, noisy_outputs
from skinsource.specs import fields
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.panels.skin.content import (
    MapContent,
    content_of,
    end_s,
    is_whole,
    needs_of,
    signals_name,
)
from skinsource_gui.panels.skin.layout import ALL, VisiblePart
from skinsource_gui.panels.skin.picture import Heading, heading_of, paint_picture
from skinsource_gui.panels.skin.settings import (
    MAGNITUDE,
    RMS,
    RMS_WINDOW,
    SKIN,
    SkinSettings,
    Z,
    in_motion,
)
from skinsource_gui.panels.skin.time import PACE as PLAY_PACE
from skinsource_gui.panels.skin.time import PACES, slow_down_factor
from skinsource_gui.plots.pictures import (
    OWN,
    PER_INCH,
    Draw,
    PictureOptions,
    Remark,
    caption_of,
    with_caption,
)
from skinsource_gui.qt.resources import choice_of
from skinsource_gui.qt.theme import Theme, letter_by_letter

#: The most pixels on a side that encoders take.
MOST_PX = 4096
#: The most frames of a film: ten minutes.
MOST_FRAMES = 36_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Film:
    """Which instants a film shows, and how fast.

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
        """Return the instant of a frame, counted from 0."""
        return self.begin_s + number / (self.frames_per_s * self.slow_motion)

    @property
    def duration_s(self) -> float:
        """Duration of the film."""
        return self.count / self.frames_per_s


def film_of(view: View, settings: SkinSettings, end_s: float, per_s: int, limb: LimbFacts) -> Film:
    """Return the film of the visible time range, of the whole response where it is not zoomed.

    Raises
    ------
    InvalidInputError
        It would be longer than ten minutes.
    """
    first_s, last_s = view.time_range_s or (0.0, end_s)
    first_s, last_s = min(max(first_s, 0.0), end_s), min(max(last_s, 0.0), end_s)
    pace = slow_down_factor(view, settings, per_s, limb)
    # The last instant belongs to the film, however its seconds are rounded.
    count = int((last_s - first_s) * per_s * pace + 1e-6) + 1
    if count > MOST_FRAMES:
        raise InvalidInputError(
            f"The animation from {first_s:g} s to {last_s:g} s at 1/{pace:g} has {count} frames, "
            f"expected at most {MOST_FRAMES}: {MOST_FRAMES / per_s / 60:g} minutes. Zoom the time "
            "axes to a shorter piece, or choose another speed."
        )
    return Film(begin_s=first_s, count=count, frames_per_s=per_s, slow_motion=pace)


def frame_size(options: PictureOptions) -> tuple[int, int]:
    """Return width and height of a frame, px: even numbers, which encoders need.

    Raises
    ------
    InvalidInputError
        It is larger than encoders take.
    """
    scale = options.dpi / PER_INCH
    sides = [
        max(2 * round(side_px * scale / 2), 2) for side_px in (options.width_px, options.height_px)
    ]
    if max(sides) > MOST_PX:
        raise InvalidInputError(
            f"The animation has {sides[0]} x {sides[1]} pixels, expected at most {MOST_PX} on a "
            "side. Choose a smaller size or resolution."
        )
    return sides[0], sides[1]


#: Formats of a film: title and suffix.
KINDS = (("MP4", ".mp4"), ("WebM", ".webm"), ("GIF", ".gif"))
#: The part of the map that is visible on the screen.
ON_SCREEN = "seen"

KIND = ChoiceSpec(
    label="Format",
    options=tuple((ending, title) for title, ending in KINDS),
    hint="MP4 plays nearly everywhere; GIF is larger, at 50 frames per second",
)
SHOWN = choice_of("filmed")
PART = choice_of("filmed_part")
PACE = replace(PLAY_PACE, hint="Speed of the film, relative to real time")


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmOptions(PictureOptions):
    """What a film shows, how slowly, and in which format.

    Attributes
    ----------
    quantity, rms_window_s
        What is shown: `Z`, `MAGNITUDE` or `RMS`; what the RMS is taken over.
    part
        `ON_SCREEN`, `HAND` or `WHOLE`.
    pace
        How many times slower it shall run than it happens.
    kind
        How its name ends.
    """

    quantity: str = fields.choice(Z, SHOWN)
    rms_window_s: float = fields.number(0.02, RMS_WINDOW)
    part: str = fields.choice(ON_SCREEN, PART)
    pace: str = fields.choice("20", PACE)
    kind: str = fields.choice(".mp4", KIND)

    @property
    def unused(self) -> frozenset[str]:
        sides = {"width_px", "height_px"} if self.layout != OWN else set()
        return frozenset(sides if self.quantity == RMS else {*sides, "rms_window_s"})

    @property
    def frames_per_s(self) -> int:
        """Frames per second of this format."""
        return frames_per_s(Path(f"film{self.kind}"))

    def part_of(self, visible: VisiblePart) -> VisiblePart:
        """Return the filmed part of the map, where ``visible`` is on the screen."""
        return visible if self.part == ON_SCREEN else VisiblePart(fit=self.part)

    def view_of(self, view: View) -> View:
        """Return the view that shows what is filmed."""
        shown = replace(
            settings_of(view, SKIN, SkinSettings),
            quantity=self.quantity,
            rms_window_s=self.rms_window_s,
        )
        return with_settings(replace(view, slow_motion=float(self.pace)), SKIN, shown)


def film_options(design: Design, view: View, sizes: PictureOptions) -> FilmOptions:
    """Return options for what the screen shows, in the given size and the last chosen format.

    Where the screen shows levels, the film shows the motion along z, or its magnitude on a limb
    that was not measured along z. It runs as slowly as the stage shows these waves, or as slowly as
    the screen where that is slower, unless it would be too long.
    """
    limb = facts_of(design.limb)
    settings = settings_of(view, SKIN, SkinSettings)
    settings = in_motion(settings, limb.axes)
    last = sizes if isinstance(sizes, FilmOptions) else FilmOptions()
    least = slow_down_factor(view, settings, last.frames_per_s, limb)
    slow = max(least, _followed_at(design, view, settings.quantity))
    begin_s, end_s = view.time_range_s or (0.0, _end_s(design, view))
    most = MOST_FRAMES / last.frames_per_s / max(end_s - begin_s, 1e-3)
    pace = next((choice for choice in PACES if choice >= slow), PACES[-1])
    pace = max((choice for choice in PACES if least <= choice <= min(pace, most)), default=pace)
    return replace(
        last,
        layout=sizes.layout,
        width_px=sizes.width_px,
        height_px=sizes.height_px,
        dpi=sizes.dpi,
        colours=sizes.colours,
        quantity=settings.quantity,
        rms_window_s=settings.rms_window_s,
        part=ON_SCREEN,
        pace=f"{pace}",
    )


def _followed_at(design: Design, view: View, quantity: str) -> float:
    """Return the slow motion in which the stage shows what is filmed; 1 where nothing moves."""
    name = {Z: "moving_z", MAGNITUDE: "moving_vector"}.get(quantity, "")
    try:
        moving = evaluate(design, name, view=view)[name] if name else None
    except SkinSourceError:
        # The export says why it cannot be played.
        moving = None
    return loop_of(design, moving).slow_motion if moving and moving.largest else 1.0


# In names of files.
_FILE_NAMES = {Z: "along-z", MAGNITUDE: "magnitude", RMS: "sliding-rms"}


def film_name(design: Design, view: View, options: FilmOptions) -> str:
    """Return the name of the file, such as ``"skin-map-along-z-1-50.mp4"``."""
    pace = _pace(design, view, options)
    return f"skin-map-{_FILE_NAMES[options.quantity]}-1-{pace:g}{options.kind}"


def film_remark(design: Design, view: View, options: FilmOptions) -> Remark:
    """Return how long the film will be, or why it cannot be made."""
    shown = options.view_of(view)
    settings, limb = settings_of(shown, SKIN, SkinSettings), facts_of(design.limb)
    if options.quantity == Z and Z not in limb.axes:
        along = axes_text(limb.axes)
        sentence = (
            f"This limb was measured along {along}, and not along z: choose another quantity."
        )
        return Remark(sentence, refuses=True)
    try:
        frame_size(options)
        film = film_of(shown, settings, _end_s(design, view), options.frames_per_s, limb)
    except InvalidInputError as error:
        return Remark(str(error), refuses=True)
    # The duration of the whole response follows from the clips, within a sample or two.
    about = "about " if view.time_range_s is None else ""
    part = "All of the response"
    if view.time_range_s is not None:
        # The response, and so the film, may begin later or end earlier than the time axes.
        begin_ms, end_ms = 1e3 * film.begin_s, 1e3 * film.time_s(film.count - 1)
        part = f"{begin_ms:.0f} to {end_ms:.0f} ms of the response"
    sentences = [f"{part}: {about}{film.duration_s:.3g} s of film, {film.count} frames."]
    if film.slow_motion != float(options.pace):
        sentences.append(
            f"It runs at 1/{film.slow_motion:g}: at 1/{options.pace} it would have fewer than two "
            "frames in a period of its fastest waves, and show false waves."
        )
    followed = _followed_at(design, view, options.quantity)
    frames = options.frames_per_s * film.slow_motion / (SHOWN_HZ * followed)
    if followed > 1.0 and frames < PICTURES_PER_PERIOD:
        slower = next((pace for pace in PACES if pace >= followed), PACES[-1])
        sentences.append(
            f"It has {frames:.0f} frames in a period of its fastest strong waves, and flickers: "
            f"1/{slower} shows them travel."
        )
    if view.time_range_s is None:
        sentences.append("Zoom the traces to film a part.")
    return Remark(" ".join(sentences))


def _pace(design: Design, view: View, options: FilmOptions) -> float:
    shown = options.view_of(view)
    settings = settings_of(shown, SKIN, SkinSettings)
    return slow_down_factor(shown, settings, options.frames_per_s, facts_of(design.limb))


def _plays_until_s(design: Design) -> float:
    """Return when the last clip ends, without computing what clips play."""
    return max((clip.end_s for clip in played_clips(design)), default=0.0)


def _end_s(design: Design, view: View) -> float:
    """Return the end of the response on the time axis."""
    limb = facts_of(design.limb)
    removed_s = limb.pre_trigger_delay_s if view.delay_removed else 0.0
    end_s = _plays_until_s(design) + (_taps_from_0(design, limb) - 1) / limb.sample_rate_hz
    return max(end_s - removed_s, 0.0)


def _taps_from_0(design: Design, limb: LimbFacts) -> int:
    """Return how many samples from time 0 on an impulse of the drive rings, also in actuators."""
    if design.actuated is not None:
        with suppress(SkinSourceError):  # the export says why it cannot be played
            driven = evaluate(design, "driven_limb")["driven_limb"]
            return int(driven.n_taps - driven.lead_samples)
    return limb.n_taps


#: Usual width and height of a frame, px.
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
    # Nobody computes with the pixels of a frame.
    options = options or film_options(design, view, _usual_size())
    view = options.view_of(view)
    settings = settings_of(view, SKIN, SkinSettings)
    per_s = frames_per_s(path)
    exported = ExportedDesign(design, view, progress, stop)
    camera = _Camera(exported, settings, options, options.part_of(seen))
    film = film_of(view, settings, camera.end_s, per_s, facts_of(design.limb))
    comment = f"SkinSource studio, {camera.text(film)}"
    with video_file(path, camera.size, comment, stop) as add:
        for number in range(film.count):
            add(camera.frame(film, number))
            progress(number + 1, film.count, "Drawing frames")


def film_picture(
    design: Design, view: View, *, options: FilmOptions, seen: VisiblePart = ALL, stop: Stop = never
) -> QtGui.QImage:
    """Return the frame of a film in which the clips are half over; see `export_animation`."""
    view = options.view_of(view)
    settings, limb = settings_of(view, SKIN, SkinSettings), facts_of(design.limb)
    exported = ExportedDesign(design, view, stop=stop)
    camera = _Camera(exported, settings, options, options.part_of(seen))
    film = film_of(view, settings, camera.end_s, options.frames_per_s, limb)
    middle_s = (first_onset_s(design) + _plays_until_s(design)) / 2.0
    middle_s += 0.0 if view.delay_removed else limb.pre_trigger_delay_s
    number = round((middle_s - film.begin_s) * film.frames_per_s * film.slow_motion)
    frame = np.ascontiguousarray(camera.frame(film, min(max(number, 0), film.count - 1)))
    height, width, _ = frame.shape
    pixels = QtGui.QImage(frame.data, width, height, 3 * width, QtGui.QImage.Format.Format_RGB888)
    return pixels.copy()


def _usual_size() -> PictureOptions:
    return PictureOptions(width_px=SIZE_PX[0], height_px=SIZE_PX[1])


class _Camera:
    """Draws one frame after another."""

    def __init__(
        self,
        exported: ExportedDesign,
        settings: SkinSettings,
        options: PictureOptions,
        visible: VisiblePart = ALL,
    ) -> None:
        self._visible = visible
        self._exported, self._settings = exported, settings
        self._options, self.size = options, frame_size(options)
        findings: Findings = exported.value("validity")
        self._caption = _caption_of(exported, findings)
        self._noisy = noisy_outputs(findings)
        self._family = QtGui.QGuiApplication.font().family()
        self._image = QtGui.QImage(*self.size, QtGui.QImage.Format.Format_RGB888)
        self._read_signals(exported.view)

    @property
    def end_s(self) -> float:
        """End of the response on the time axis."""
        return end_s(self._results[signals_name(self._settings.quantity)], self._exported.view)

    def text(self, film: Film) -> str:
        """Return how fast time runs, and which limb is shown."""
        limb = limb_label(self._exported.design.limb).title
        return f"{limb} · 1/{film.slow_motion:g} of real time"

    def frame(self, film: Film, number: int) -> NDArray[np.uint8]:
        """Return one frame, (rows, columns, 3)."""
        view = replace(self._exported.view, playhead_s=film.time_s(number))
        signals = self._results[signals_name(self._settings.quantity)]
        if block_of(view.playhead_s) != self._block and not is_whole(signals):
            self._read_signals(view)
        design = self._exported.design
        content = content_of(self._results, self._settings, view, design, noisy=self._noisy)
        # A film has one range from its begin to its end, whoever chose it.
        content = replace(content, fixed=False)
        heading = heading_of(design, content.quantity)
        pace = f"1/{film.slow_motion:g} of real time"
        return self._draw(content, replace(heading, details=f"{heading.details} · {pace}"))

    def _draw(self, content: MapContent, heading: Heading) -> NDArray[np.uint8]:
        def draw(painter: QtGui.QPainter, width: int, height: int, theme: Theme) -> None:
            size = QSizeF(width, height)
            paint_picture(painter, size, content, heading, theme, self._family, self._visible)

        return painted_frame(self._image, self._options, draw, self._caption)

    def _read_signals(self, view: View) -> None:
        self._block = block_of(view.playhead_s)
        needed = needs_of(self._settings)
        self._results = self._exported.values(needed, moving_block=self._block)


def painted_frame(
    image: QtGui.QImage, options: PictureOptions, draw: Draw, caption: str
) -> NDArray[np.uint8]:
    """Draw a frame with its caption into ``image``; return its pixels, (rows, columns, 3)."""
    painter = QtGui.QPainter(image)
    rows, columns = image.height(), image.width()
    painter.scale(columns / options.width_px, rows / options.height_px)
    # A font of its own: a copy would share with those of the window, in another thread.
    font = letter_by_letter(QtGui.QFont(QtGui.QGuiApplication.font().family()))
    font.setPointSizeF(painter.font().pointSizeF())
    painter.setFont(font)
    with_caption(draw, caption)(painter, options.width_px, options.height_px, options.theme)
    painter.end()
    lines = np.frombuffer(image.constBits(), np.uint8)
    return lines.reshape(rows, image.bytesPerLine())[:, : 3 * columns].reshape(rows, columns, 3)


def _caption_of(exported: ExportedDesign, findings: Findings) -> str:
    """Return stimulus, limb, and the conditions of the measurement that are not met."""
    design, note = exported.design, exported.limb.note
    judged = Judged(label=limb_label(design.limb).title, note=note, findings=findings)
    return caption_of(design, notes=in_short([judged]))
