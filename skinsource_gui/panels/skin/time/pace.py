"""How slowly a film of the skin map runs."""

from collections.abc import Iterator
from itertools import count as counted

from skinsource.design.view import View
from skinsource.limbs.limb import LimbFacts
from skinsource_gui.panels.skin.map_quantity import MAGNITUDE, RMS, Z
from skinsource_gui.panels.skin.settings import SkinSettings

#: How many times slower it can be chosen to run.
PACES = (1, 2, 5, 10, 20, 50, 100, 200)


def pace_of(view: View, settings: SkinSettings, per_s: int, limb: LimbFacts) -> float:
    """How many times slower it is shown: as the view says, or as slowly as it can be followed.

    Fewer than two instants in a period of the fastest motion would show waves that there are not:
    of a limb that is sampled quickly a film runs more slowly than the window plays.
    """
    highest_hz = limb.band_hz[1] if limb.band_hz else limb.sample_rate_hz / 2.0
    # A length of a vector moves twice as fast.
    fastest_hz = {Z: highest_hz, MAGNITUDE: 2.0 * highest_hz, RMS: 1.0 / settings.rms_window_s}
    needed = 2.0 * fastest_hz[settings.quantity] / per_s
    if view.slow_motion >= needed:
        return view.slow_motion
    return next(pace for pace in _paces() if pace >= needed)


def _paces() -> Iterator[float]:
    """Round ones, 1, 2, 5, 10, 20, 50 and so on, without end."""
    return (digit * 10.0**power for power in counted() for digit in (1.0, 2.0, 5.0))
