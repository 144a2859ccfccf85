"""Levels and outputs in words."""

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.labels import span_words
from skinsource.limbs.locations import output_words


def minus(text: str) -> str:
    """``text`` with real minus signs."""
    return text.replace("-", "−")


def level_text(level_db: float, span: str) -> str:
    """A level in dB and as an acceleration, and what it is the RMS over."""
    if level_db <= FLOOR_DB:
        return "silent"
    acceleration = 10.0 ** (level_db / 20.0)
    if acceleration >= 0.1:
        amount = f"{acceleration:.3g} m/s²"
    elif acceleration >= 1e-4:
        amount = f"{acceleration * 1e3:.3g} mm/s²"
    else:
        amount = f"{acceleration:.2e} m/s²"
    return minus(f"{level_db:z.1f} dB re 1 m/s²  ({amount} RMS, {span_words(span)})")


def output_text(number: int, limb: str = "") -> str:
    """Number and place of an output."""
    place = output_words(number, limb)
    if place.name == f"Output {number}":
        return place.name
    name = place.name if place.kind or limb else place.short_name
    return f"Output {number}, {name}"
