"""How a film of the skin map is called, and what is to be known before it is written."""

from math import sqrt

from skinsource.base.errors import InvalidInputError
from skinsource.base.published import N_OUTPUTS
from skinsource.base.published import words as axis_words
from skinsource.design.design import Design, audible_inputs
from skinsource.design.panel_settings import settings_of
from skinsource.design.view import View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panels.skin.map_quantity import MAGNITUDE, RMS, Z
from skinsource_gui.panels.skin.settings import SKIN, SkinSettings
from skinsource_gui.panels.skin.time.film import Film, film_of, frame_size
from skinsource_gui.panels.skin.time.film_options import FilmOptions
from skinsource_gui.panels.skin.time.pace import pace_of
from skinsource_gui.widgets.pictures.picture_options import Remark

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
    return pace_of(shown, settings, options.frames_per_s, facts_of(design.limb))


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
