"""What the editor shows."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF

from skinsource.base.arrays import Floats
from skinsource.design.clips import Clip
from skinsource_gui.widgets.time.time_scale import TimeScale

#: Values that can be seen at least, so that there is room to draw.
REACH = 1.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EditorContent:
    """One clip, and where it is painted.

    Attributes
    ----------
    clip
        The clip.
    drawn : (n_times,)
        Its waveform before any effect, or None while it is not known.
    played : (n_times,)
        What it plays after its effects, or None.
    sample_rate_hz
        Rate of both.
    scale
        From the clip's own time to pixels.
    area
        Where the curve is, px.
    reach
        The largest value that can be seen.
    """

    clip: Clip
    drawn: Floats | None
    played: Floats | None
    sample_rate_hz: float
    scale: TimeScale
    area: QRectF
    reach: float = REACH

    def y(self, value: float) -> float:
        """Where a value lies, px."""
        return self.area.center().y() - value / self.reach * self.area.height() / 2

    def value(self, y_px: float) -> float:
        """Value at a height."""
        return (self.area.center().y() - y_px) * 2 / self.area.height() * self.reach

    def at(self, time_s: float, value: float) -> QPointF:
        """Where a value at a time lies, px."""
        return QPointF(self.scale.x(time_s), self.y(value))

    def curve(self, times_s: Floats, values: Floats) -> tuple[Floats, Floats]:
        """Where values at times lie, (n,) each, px."""
        scale, area = self.scale, self.area
        x = scale.left_px + (times_s - scale.shown_s[0]) * scale.px_per_s
        return x, area.center().y() - values / self.reach * (area.height() / 2)

    def place(self, at: QPointF) -> tuple[float, float]:
        """Time and value at a place."""
        return self.scale.time(at.x()), self.value(at.y())


def reach_of(*signals: Floats | None) -> float:
    """The largest value that is to be seen: round, and never less than a peak of 1 needs."""
    peaks = [float(np.abs(one).max()) for one in signals if one is not None and one.size]
    peak = max(peaks, default=0.0)
    if peak <= 1.0:
        return REACH
    step = 10.0 ** np.floor(np.log10(peak)) / 2
    return float(np.ceil(peak * 1.02 / step) * step)
