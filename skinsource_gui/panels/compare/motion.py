"""Maps that move together: loops of several designs, in one scale and equally slow."""

from collections.abc import Sequence
from dataclasses import replace
from math import isclose

from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer, Signal

from skinsource.base.conventions import Floats
from skinsource.design.comparing import gain_text
from skinsource.engine.loops import (
    PICTURES_PER_PERIOD,
    SHOWN_HZ,
    Loop,
    common_turns,
    first_onset_s,
    is_sequence,
    loop_of,
    moving_axis,
    moving_name,
    shown_part,
)
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.units import minus
from skinsource_gui.panels.compare.content import ALL_AXES, Cell, Names, along
from skinsource_gui.plots.colour_maps import DIVERGING, VIRIDIS
from skinsource_gui.plots.ranges import SteadyRange
from skinsource_gui.plots.small_map import ColourScale, Range, small_map_of
from skinsource_gui.state.compared import Compared

# Colours reach their ends at this share of the largest acceleration, which under the actuator is
# far larger than elsewhere.
_SHARE_OF_LARGEST = 0.1
#: A motion that would take longer to see is shown in its loudest part alone, s.
MOST_S = 30.0
# Clips one after another, as from place to place, are seen in this time, s, and therefore up to so
# many times faster; at a chosen speed they are whole up to this time of the skin, s.
_CLIPS_S, _FASTER, _MOST_OF_CLIPS_S = 18.0, 9.0, 2.0
_PICTURES_PER_S = SHOWN_HZ * PICTURES_PER_PERIOD
# Of a faster motion a period has up to so many times fewer pictures, and a late one goes on by at
# most so many of them: with two a period, waves would seem to run backwards.
_FEWER, _LATER = 4.0, 1.2


def rounded(value: float) -> str:
    """Return a number as a person would write it: "0.76", "130"."""
    return f"{float(f'{value:.2g}'):g}"


class MovingMaps:
    """Makes the maps of a motion, which share one clock; it goes on where designs change.

    Attributes
    ----------
    loops
        What moves, with the factor with which it is shown; None where nothing is known.  What
        passes begins and ends together.
    turns
        How often the longest loop was gone through, with the part of it that is shown.
    slow_motion
        How many times slower than it happens all of them are shown.
    passes
        Whether a tone is shown from its beginning to its end, not as if it had none.
    axes, chosen, delay_removed, matched
        Axes and slow motion of the view, which is followed where it is above 1, whether its times
        are without the pre-trigger delay, and how much louder the design is shown.
    unit
        Unit of what moves, along which axis it does, and whether it is matched.
    pictures_per_s
        How many pictures are needed for it.
    """

    def __init__(self) -> None:
        self.loops: list[tuple[Loop, float] | None] = []
        self.turns, self.passes = 0.0, False
        self.slow_motion, self.pictures_per_s = 1.0, _PICTURES_PER_S
        self.axes, self.chosen, self.matched, self.unit = "z", 0.0, "", "m/s²"
        self.delay_removed = True
        self._cells: tuple[Cell, ...] = ()
        self._compared: Sequence[Compared] = ()
        self._range = SteadyRange()

    @property
    def ran_s(self) -> float:
        """The time of the skin that all maps show, since the beginning of their loops."""
        return self.turns * self.longest_s

    @property
    def common_turns(self) -> tuple[int, bool]:
        """After how many turns all loops begin again, or nearly so, and whether they do.

        As many turns are seen within half a minute.
        """
        most = max(int(MOST_S / (self.longest_s * self.slow_motion)), 1)
        return common_turns([known[0].duration_s for known in self.loops if known], most)

    @property
    def repeats(self) -> bool:
        """Whether all is as at first after the longest loop."""
        times = [self.longest_s / known[0].duration_s for known in self.loops if known]
        return all(isclose(each, round(each), abs_tol=1e-6) for each in times)

    @property
    def longest_s(self) -> float:
        """Duration of the longest loop, s; 0: nothing moves."""
        return max((known[0].duration_s for known in self.loops if known), default=0.0)

    @property
    def begin_s(self) -> float:
        """The time of Traces at which loops begin; 0 of steady tones, which have no beginning."""
        return min(map(self._begin_s, self.passing), default=0.0)

    @property
    def clock_text(self) -> str:
        """When it is, and of which time."""
        common, closes = self.common_turns
        common_s = common * self.longest_s
        now_s, of = self.begin_s + self.ran_s % common_s, " ms"
        if self.passing:
            of = f" of {self.span_text}"
        elif closes:
            of = f" of {1e3 * common_s:.1f} ms{' of one period' * (common == 1)}"
        return minus(f"{1e3 * now_s:.1f}") + of

    @property
    def span_text(self) -> str:
        """From when to when the longest loop is."""
        end_s = self.begin_s + self.longest_s
        return minus(f"{round(1e3 * self.begin_s)} to {round(1e3 * end_s)} ms")

    def restart(self) -> None:
        """Begin again, and decide the next scale by its data alone."""
        self.turns = 0.0
        self._range.reset()

    def update(
        self, compared: Sequence[Compared], names: Sequence[Names], held: Range | None = None
    ) -> None:
        """Take over designs and how they are called; ``held``: ends of the scale that stays."""
        self._compared = compared
        self.loops = self._loops_of(compared, passes=self.passes)
        if self.passing:
            self._pass_together(compared)
        loops = [known for known in self.loops if known is not None]
        self.slow_motion = max((loop.slow_motion for loop, _ in loops), default=1.0)
        followed, self.pictures_per_s = self.slow_motion, _PICTURES_PER_S
        if self.chosen > 1.0:
            self.slow_motion = self.chosen
        part_s = MOST_S / self.slow_motion
        if self.longest_s and any(is_sequence(side.snapshot.design) for side in compared):
            part_s = max(part_s, _MOST_OF_CLIPS_S)
            if self.chosen <= 1.0:
                part_s = min(self.longest_s, _FASTER * _CLIPS_S / followed)
                self.slow_motion = min(followed, _CLIPS_S / part_s)
                self.pictures_per_s *= max(followed / self.slow_motion / _FEWER, 1.0)
        part, away_s = "", [0.0] * len(loops)
        if self.passing and self.longest_s > part_s:
            after_s, away_s = shown_part([loop for loop, _ in loops], part_s)
            self.loops = [pair and (pair[0].part(after_s, part_s), pair[1]) for pair in self.loops]
            part = self.span_text
            if len(loops) == 1 and loops[0][0].moving.is_whole:
                part = f"loudest {rounded(1e3 * part_s)} ms"
        largest = max((loop.largest * gain for loop, gain in loops), default=0.0)
        end = _SHARE_OF_LARGEST * largest
        signed = all(loop.signed for loop, _ in loops)
        shown = set(self._axes_of(compared))
        axis = shown.pop() if signed and len(shown) == 1 else ""
        direction = "along the axis of each map" if signed else ""
        if axis:
            direction = "normal to the skin" if axis == "z" else f"along {axis}"
        matched = "matched" if any(side.gain != 1.0 for side in compared) else self.matched
        self.unit = ", ".join(filter(None, (f"m/s² {direction}" if axis else "m/s²", matched)))
        slow = f"slow motion 1/{rounded(self.slow_motion)}"
        slow = ", ".join(filter(None, (slow, part, matched)))
        scale = ColourScale(
            range_db=held or self._range.follow(-end if signed else 0.0, end, "amplitude"),
            text_below=f"m/s² {direction}, {slow}" if direction else f"m/s², {slow}",
            shorter=(f"m/s², {slow}",),
            colours=DIVERGING if signed else VIRIDIS,
            signed=signed,
            reached_db=(-largest if signed else 0.0, largest),
            unit="m/s²",
        )
        away = iter(away_s)
        self._cells = tuple(
            self._cell(known, side, name, scale, next(away) if known else 0.0)
            for known, side, name in zip(self.loops, compared, names, strict=True)
        )

    def advance(self, seconds: float) -> None:
        """Go on by this time of the person who looks."""
        if longest_s := self.longest_s:
            if self.pictures_per_s > _PICTURES_PER_S:
                seconds = min(seconds, _LATER / self.pictures_per_s)
            self.turns += seconds / (self.slow_motion * longest_s)

    def cells(self) -> tuple[Cell, ...]:
        """Return the maps as they are now."""
        return tuple(self._frame(k) for k in range(len(self._cells)))

    def values(self, k: int) -> Floats | None:
        """Return the acceleration of all outputs of a map now, (n_outputs,), m/s²."""
        known = self.loops[k]
        if known is None:
            return None
        loop, gain = known
        return gain * loop.values(self.ran_s / loop.duration_s % 1.0)

    @property
    def passing(self) -> list[Loop]:
        """What passes; silence goes with anything."""
        loops = [known[0] for known in self.loops if known]
        return [loop for loop in loops if loop.phasors is None and loop.largest]

    def _axes_of(self, compared: Sequence[Compared]) -> list[str]:
        """Return along which axis each moves; all axes of each where one of them has no such."""
        limbs = [side.snapshot.design.limb for side in compared]
        chosen = [side.axes or self.axes for side in compared]
        axes = list(map(moving_axis, limbs, chosen))
        together = any(len(each) > 1 for each in axes)
        return [facts_of(limb).axes for limb in limbs] if together else axes

    def _loops_of(
        self, compared: Sequence[Compared], *, passes: bool
    ) -> list[tuple[Loop, float] | None]:
        axes = self._axes_of(compared)
        return [_loop(side, axis, passes=passes) for side, axis in zip(compared, axes, strict=True)]

    def _begin_s(self, loop: Loop) -> float:
        return loop.begin_s - self.delay_removed * loop.moving.delay_s

    def _pass_together(self, compared: Sequence[Compared]) -> None:
        """Have all loops begin with the first one that sounds, and end with the last."""
        if len(self.passing) < sum(known is not None for known in self.loops):
            self.loops = self._loops_of(compared, passes=True)
        times_s = [(self._begin_s(loop), loop.duration_s) for loop in self.passing]
        begin_s = min(time_s for time_s, _ in times_s)
        lasts_s = max(time_s + loop_s for time_s, loop_s in times_s) - begin_s
        self.loops = [
            known and (known[0].part(begin_s - self._begin_s(known[0]), lasts_s), known[1])
            for known in self.loops
        ]

    def _cell(
        self,
        known: tuple[Loop, float] | None,
        side: Compared,
        names: Names,
        scale: ColourScale,
        away_s: float,
    ) -> Cell:
        """Return the map of a side, whose loudest part lies so far away from what is shown."""
        design = side.snapshot.design
        cell = Cell(headings=names, limb=design.limb, text=side.problem, stale=side.is_stale)
        if known is None or side.values is None:
            return cell
        loop, gain = known
        moving = loop.moving
        if loop.largest and not moving.signals.any():
            # Of a long response a part is held, in which this one does not move.
            away_s = first_onset_s(design) - moving.first / moving.sample_rate_hz
        value, matched = f"{rounded(loop.largest * gain)} m/s²", gain_text(gain)
        whole = f"up to {value}{f' after matching, {matched}' if matched else ''}"
        short = (f"{value}, matched {matched}", f"matched {matched}") if matched else (value,)
        if away_s:
            outside = f"moves {'before' if away_s < 0.0 else 'after'} this part"
            whole, short = f"{whole}, {outside}", (f"{value}, {outside}", outside)
        return replace(
            cell,
            small=small_map_of(side.values),
            scale=scale,
            design=design,
            synthetic=bool(side.values["limb_data"].synthetic),
            reaches=(whole, *short),
        )

    def _frame(self, k: int) -> Cell:
        cell, values, side = self._cells[k], self.values(k), self._compared[k].values
        if cell.small is None or values is None or side is None:
            return cell
        field = side["surface"].interpolate(values) if cell.small.field is not None else None
        small = replace(cell.small, levels_db=values, field_levels_db=field)
        return replace(cell, small=small)


def _loop(side: Compared, axis: str, *, passes: bool) -> tuple[Loop, float] | None:
    """Return what moves along an axis; of several axes, the length of the vector."""
    design, values = side.snapshot.design, side.values or {}
    name = moving_name(design.limb, axis) if len(axis) == 1 else ALL_AXES
    moving = values.get(name, values.get(ALL_AXES))
    if moving is None:
        return None
    if moving.signals.shape[1] > 1 and len(axis) == 1:
        moving = along(moving, facts_of(design.limb).axes.index(axis))
    return loop_of(design, moving, passes=passes), side.gain


class Clock(QObject):
    """Ticks once for each picture of a motion while it runs.

    Attributes
    ----------
    held
        Whether the motion stands still.
    """

    #: How long the last picture was shown, s.
    ticked = Signal(float)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._timer = QTimer(self, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick)
        self._elapsed = QElapsedTimer()
        self.held = False

    def run(self, on: bool, pictures_per_s: float) -> None:
        """Begin or stop, or go on with other pictures per second."""
        self.held, interval_ms = self.held and on, round(1e3 / pictures_per_s)
        if (on, interval_ms) != (self._timer.isActive(), self._timer.interval()):
            self._elapsed.start()
            self._timer.setInterval(interval_ms)
            (self._timer.start if on else self._timer.stop)()

    def _tick(self) -> None:
        seconds = self._elapsed.restart() / 1e3
        if not self.held:
            self.ticked.emit(seconds)
