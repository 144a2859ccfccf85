"""What the skin does at an instant, from signals that are kept."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.design.labels import signal_words
from skinsource.design.view import View
from skinsource.engine.time_rules import Moving, SlidingEnergy, block_of
from skinsource.signals.map_range import map_range_db
from skinsource_gui.panels.skin.map_quantity import MAGNITUDE, RMS, MapQuantity, Z
from skinsource_gui.panels.skin.scale.level_range import Range
from skinsource_gui.panels.skin.settings import SkinSettings

#: What each quantity is made from.
NEEDS = {Z: "moving_z", MAGNITUDE: "moving_vector", RMS: "moving_energy"}
# Along z colours reach their ends at this part of the largest acceleration anywhere: under the
# actuator it is far larger than elsewhere.
_SHARE_OF_LARGEST = 0.25


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Frame:
    """The skin at an instant.

    Attributes
    ----------
    quantity
        What the values are.
    values : (n_outputs,)
        m/s² along z, else dB.
    """

    quantity: MapQuantity
    values: Floats


class Frames:
    """Makes frames; transforms nothing.

    Attributes
    ----------
    made
        How many were made.
    """

    def __init__(self) -> None:
        self.made = 0
        self._kept: Moving | SlidingEnergy | None = None
        self._name = ""
        self._block = 0

    def take(self, results: Mapping[str, Any], name: str, view: View) -> None:
        """Take over signals for the quantity ``name``, computed for ``view``."""
        self._kept, self._name = results[NEEDS[name]], name
        self._block = block_of(view.playhead_s)

    def forget(self) -> None:
        """There are none any more."""
        self._kept = None

    @property
    def known(self) -> bool:
        """Whether there are signals."""
        return self._kept is not None

    @property
    def largest(self) -> float:
        """The largest acceleration of the whole response, m/s²; 0 where nothing is known."""
        return 0.0 if self._kept is None else self._kept.largest

    def end_s(self, view: View) -> float:
        """When the response ends, on the time axis of ``view``; 0 where nothing is known."""
        kept = self._kept
        if kept is None:
            return 0.0
        return max((kept.response_samples - 1) / kept.sample_rate_hz - _removed_s(view, kept), 0.0)

    def has(self, view: View) -> bool:
        """Whether the signals around the playhead of ``view`` are kept."""
        kept = self._kept
        if kept is None:
            return False
        at = response_time_s(view, kept.delay_s) * kept.sample_rate_hz
        return at >= kept.response_samples or kept.first <= at <= max(kept.end, 1)

    def runs_out(self, view: View) -> bool:
        """Whether others should be asked for: soon these will not do."""
        kept = self._kept
        if kept is None or (kept.first == 0 and kept.end >= kept.response_samples):
            return False
        return block_of(view.playhead_s) != self._block

    def frame(self, view: View, settings: SkinSettings) -> Frame:
        """The skin at the playhead of ``view``."""
        kept = self._kept
        if kept is None:
            raise LookupError("there are no signals to make a frame of")
        at_s = response_time_s(view, kept.delay_s)
        self.made += 1
        quantity = MapQuantity(
            name=self._name,
            span=view.span,
            signal=signal_words(view.axes, view.method),
            window_s=settings.rms_window_s,
            time_s=view.playhead_s,
        )
        if isinstance(kept, SlidingEnergy):
            values = decibels(kept.rms(at_s, settings.rms_window_s))
        else:
            is_z = self._name == Z
            values = kept.acceleration(at_s)[:, 0] if is_z else decibels(kept.magnitude(at_s))
        return Frame(quantity=quantity, values=values)

    def value_range(self, settings: SkinSettings) -> Range:
        """Values of the lowest and the highest colour: the same at each instant."""
        if settings.quantity == Z:
            return settings.z_limits or self._usual_limits()
        return settings.moving_range_db or self._usual_range_db()

    def _usual_limits(self) -> Range:
        limit = _round_up(self.largest * _SHARE_OF_LARGEST) if self.largest > 0.0 else 1.0
        return -limit, limit

    def _usual_range_db(self) -> Range:
        return map_range_db(decibels(np.array([self.largest])))


def response_time_s(view: View, delay_s: float) -> float:
    """Where the playhead is in the response, which contains the pre-trigger delay."""
    return view.playhead_s + (delay_s if view.delay_removed else 0.0)


def _removed_s(view: View, kept: Moving | SlidingEnergy) -> float:
    return kept.delay_s if view.delay_removed else 0.0


def _round_up(value: float) -> float:
    """The next number that begins with 1, 2 or 5."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value))
