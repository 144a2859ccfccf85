"""What the strip of windows shows."""

from dataclasses import dataclass, replace

from skinsource.base.arrays import Floats
from skinsource.design.design import Design, audible_inputs
from skinsource.limbs.extent import Extent
from skinsource.signals.analysis.windows import Windows
from skinsource_gui.widgets.fields.units import axis_unit
from skinsource_gui.widgets.map.level_look import USUAL_LOOK, LevelLook
from skinsource_gui.widgets.map.scale_row import Scale, scale_of_levels, with_matched
from skinsource_gui.widgets.map.small_map import SmallMap


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowedContent:
    """Maps of windows, and how far each of them reaches.

    Attributes
    ----------
    design
        Whose inputs are marked.
    small
        Outline, places and pixels that all maps share.
    windows, sample_rate_hz
        Where the windows lie.
    levels_db : (n_windows, n_outputs)
        Level of each output in each window.
    field_levels_db : (n_windows, rows, columns)
        The interpolated maps.
    extents
        Of each window; None where it is silent.
    noisy, in_noise
        Outputs of each window that are mostly noise, and whether all of it is: noise has no extent.
    synthetic
        Whether the responses are computed, not measured.
    traces_late_s
        How much later than here the traces show what is shown; 0 where they do not.
    matched
        By how much levels are louder or softer than they were stored, or "".
    look
        Colours and range that were chosen on the skin map.
    """

    design: Design
    small: SmallMap
    windows: Windows
    sample_rate_hz: float
    levels_db: Floats
    field_levels_db: Floats
    extents: tuple[Extent | None, ...]
    synthetic: bool
    noisy: tuple[tuple[int, ...], ...] = ()
    in_noise: tuple[bool, ...] = ()
    traces_late_s: float = 0.0
    matched: str = ""
    look: LevelLook = USUAL_LOOK

    @property
    def time_phrases(self) -> tuple[str, ...]:
        """What the times of the windows are, the longest first."""
        if not self.traces_late_s:
            return "Times of the stimulus, as in the traces", "Times of the stimulus"
        late = f"{self.traces_late_s * 1e3:.0f} ms"
        return (
            f"Times of the stimulus; the traces show it about {late} later",
            f"Stimulus time; traces {late} later",
            f"Traces: +{late}",
        )

    @property
    def begin_phrases(self) -> tuple[str, ...]:
        """What is said where windows have only their begins above them, the longest first."""
        length = length_words(self.windows.window_samples / self.sample_rate_hz)
        unit, _ = axis_unit(self.bounds_s[-1][1])
        plain = (
            f"Windows of {length}, begins in {unit}",
            f"{length} each, begins in {unit}",
            f"{length} each",
        )
        whole = f"Windows of {length}; above each when it begins, in {unit} of the stimulus"
        if not self.traces_late_s:
            return whole, *plain, unit
        late = f"{self.traces_late_s * 1e3:.0f} ms"
        return (
            f"{whole}; the traces show it about {late} later",
            f"{plain[0]}; traces {late} later",
            *(f"{one}; traces +{late}" for one in plain[1:]),
            *plain,
            unit,
        )

    @property
    def told_extents(self) -> tuple[Extent | None, ...]:
        """Extents of the windows that are more than noise."""
        if not any(self.in_noise):
            return self.extents
        pairs = zip(self.extents, self.in_noise, strict=True)
        return tuple(None if in_noise else one for one, in_noise in pairs)

    def extent_words(self, window: int) -> str:
        """The measures of a window, for a tooltip."""
        if self.in_noise and self.in_noise[window]:
            return "Mostly noise of the measurement: its extent means nothing"
        return _extent_words(self.extents[window], self.origin)

    @property
    def origin(self) -> str:
        """From where distances are."""
        places = {one.location for one in audible_inputs(self.design.inputs)}
        return "the nearest input" if len(places) > 1 else "the input"

    @property
    def scale(self) -> Scale:
        """What the colours of all maps mean."""
        return with_matched(scale_of_levels(self.levels_db, self.look), self.matched)

    @property
    def bounds_s(self) -> list[tuple[float, float]]:
        """Begin and end of each window, s from the begin of the stimulus."""
        return self.windows.bounds_s(self.sample_rate_hz)

    def map_of(self, window: int) -> SmallMap:
        """The map of one window."""
        return replace(
            self.small,
            levels_db=self.levels_db[window],
            field_levels_db=self.field_levels_db[window],
            noisy=self.noisy[window] if self.noisy else (),
        )

    def window_at(self, time_s: float) -> int | None:
        """The window in which an instant of the stimulus lies."""
        for window, (begin_s, end_s) in enumerate(self.bounds_s):
            if begin_s <= time_s < end_s:
                return window
        return None


def window_words(bounds_s: tuple[float, float], until_s: float) -> str:
    """``"0–120 ms"``; in s where the last window ends a second and more after 0."""
    begin, end = (time_number(one, until_s) for one in bounds_s)
    return f"{begin}–{end} {axis_unit(until_s)[0]}"


def time_number(time_s: float, until_s: float) -> str:
    """A time to the millisecond, in the unit of times up to another one."""
    return f"{time_s:.3f}".rstrip("0").rstrip(".") if _in_s(until_s) else f"{1e3 * time_s:.0f}"


def _in_s(until_s: float) -> bool:
    return axis_unit(until_s)[0] == "s"


def length_words(length_s: float) -> str:
    """How long a window is."""
    if _in_s(length_s):
        return f"{length_s:.4g} s"
    length_ms = 1e3 * length_s
    return f"{length_ms:.0f} ms" if length_ms >= 100.0 else f"{length_ms:.3g} ms"


def _extent_words(extent: Extent | None, origin: str) -> str:
    if extent is None:
        return "Silent: nothing has an extent"
    return (
        f"Mean distance from {origin} {extent.mean_distance_mm:.1f} mm\n"
        f"90 % of the energy within {extent.d90_mm:.1f} mm\n"
        f"Outputs less than 12 dB below the loudest {100 * extent.share_above_12_db:.0f} %, "
        f"20 dB {100 * extent.share_above_20_db:.0f} %\n"
        f"Participation {extent.participation:.1f} outputs"
    )
