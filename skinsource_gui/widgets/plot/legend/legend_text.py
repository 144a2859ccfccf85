"""What a legend says."""

from dataclasses import dataclass, replace

from skinsource_gui.widgets.plot.curves import CurveName

#: In place of where curves are read: what is said of each is its peak.
PEAK = "peak"
_BETWEEN = "  "


@dataclass(frozen=True, slots=True, kw_only=True)
class LegendText:
    """What the strip says.

    Attributes
    ----------
    names
        Names of the curves, by rank.
    unit
        Of the readings.
    where, readings
        Where curves are read and what is read there; ``""`` and ``()`` where nothing is.
    where_room, reading_room, unit_room
        The longest of them, and of units; places stay while numbers change.
    by_axis
        Whether the names are those of axes, each with what all outputs read along it.
    relative
        Whether curves are relative to their peaks, which are said while nothing is read.
    """

    names: tuple[CurveName, ...] = ()
    unit: str = ""
    where: str = ""
    readings: tuple[str, ...] = ()
    where_room: str = ""
    reading_room: str = ""
    unit_room: str = ""
    by_axis: bool = False
    relative: bool = False

    @property
    def named(self) -> bool:
        """Whether names stand for the curves, and numbers do not."""
        return any(not name.number for name in self.names)

    @property
    def of_peaks(self) -> bool:
        """Whether nothing is read, and each curve has its peak beside it."""
        return self.where == PEAK

    def of_axes(self, axes: tuple[str, ...]) -> "LegendText":
        """The same where each name has a curve along each of some axes."""
        outputs = ", ".join(str(name.number) for name in self.names)
        return replace(
            self,
            names=tuple(
                CurveName(number=0, short=axis, full=f"along {axis} at {outputs}") for axis in axes
            ),
            reading_room=_BETWEEN.join((self.reading_room,) * len(self.names)),
            by_axis=True,
        )

    def lines(self) -> str:
        """All of it, one line for each curve."""
        lines = [self.where if self.of_peaks else f"at {self.where}"] if self.where else []
        for rank, name in enumerate(self.names):
            reading = f": {self.readings[rank]} {self.unit}" if self.readings else ""
            told = f"{name.number}  {name.full}" if name.number else f"{name.short}: {name.full}"
            lines.append(f"{told}{reading}")
        return "\n".join(lines)


def along_axes(readings: tuple[str, ...], n_axes: int) -> tuple[str, ...]:
    """What all outputs read along each axis, of readings along each axis of each output."""
    return tuple(_BETWEEN.join(readings[axis::n_axes]) for axis in range(n_axes))
