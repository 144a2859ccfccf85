"""What a film of the skin map shows, and how it is called."""

from dataclasses import replace
from pathlib import Path

from skinsource.design import Design
from skinsource.export.video import frames_per_s
from skinsource.own_limbs import facts_of
from skinsource.panel_settings import settings_of
from skinsource.view import View
from skinsource_gui.panels.skin.map_quantity import MAGNITUDE, RMS, STILL, Z
from skinsource_gui.panels.skin.settings import SKIN, SkinSettings
from skinsource_gui.panels.skin.time.pace import pace_of

_USUAL = Path("film.mp4")
# In names of files, and in words.
_CALLED = {
    Z: ("along-z", "acceleration along z"),
    MAGNITUDE: ("magnitude", "magnitude of acceleration"),
    RMS: ("sliding-rms", "sliding RMS"),
}


def filmed(view: View) -> SkinSettings:
    """The settings of a film: where what is shown is the same at any time, of motion along z."""
    settings = settings_of(view, SKIN, SkinSettings)
    return replace(settings, quantity=Z) if settings.quantity in STILL else settings


def film_name(design: Design, view: View) -> str:
    """``"skin-map-along-z-1-50.mp4"``: what it shows, and how much slower than it happens."""
    settings = filmed(view)
    called, _ = _CALLED[settings.quantity]
    return f"skin-map-{called}-1-{_pace(design, view, settings):g}{_USUAL.suffix}"


def film_words(design: Design, view: View) -> str:
    """What it shows, which part and how slowly; and where that is chosen."""
    settings = filmed(view)
    _, called = _CALLED[settings.quantity]
    pace = _pace(design, view, settings)
    part = "all of the response"
    if view.time_range_s is not None:
        first_s, last_s = view.time_range_s
        part = f"{1e3 * first_s:.0f} to {1e3 * last_s:.0f} ms, {(last_s - first_s) * pace:.0f} s"
    return (
        f"Shows {called} at 1/{pace:g} of real time: {part}. Choose what and how slowly above the "
        "skin map, and zoom the traces to a part."
    )


def _pace(design: Design, view: View, settings: SkinSettings) -> float:
    return pace_of(view, settings, frames_per_s(_USUAL), facts_of(design.limb))
