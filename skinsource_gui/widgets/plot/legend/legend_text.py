"""What a legend says."""

from dataclasses import dataclass

from skinsource_gui.widgets.plot.curves import CurveName

#: In place of where curves are read: what is said of each is its peak.
PEAK = "peak"


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
    where_room, reading_room
        The longest of them; places stay while numbers change.
    """

    names: tuple[CurveName, ...] = ()
    unit: str = ""
    where: str = ""
    readings: tuple[str, ...] = ()
    where_room: str = ""
    reading_room: str = ""

    @property
    def named(self) -> bool:
        """Whether names stand for the curves, and numbers do not."""
        return any(not name.number for name in self.names)

    def lines(self) -> str:
        """All of it, one line for each curve."""
        lines = [self.where if self.where == PEAK else f"at {self.where}"] if self.where else []
        for rank, name in enumerate(self.names):
            reading = f": {self.readings[rank]} {self.unit}" if self.readings else ""
            told = f"{name.number}  {name.full}" if name.number else f"{name.short}: {name.full}"
            lines.append(f"{told}{reading}")
        return "\n".join(lines)
