"""In which unit strengths of a stimulus are told, beside the amplitudes that they are set in."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class StrengthUnit:
    """Of strengths.

    Attributes
    ----------
    title, symbol
        What they are, with the unit, and the unit alone; empty: they have none.
    column
        Name of their column in a table.
    factor
        What an amplitude is multiplied with to be told.
    si_factor
        The same for a table, which is in SI.
    """

    title: str
    symbol: str
    column: str = "strength"
    factor: float = 1.0
    si_factor: float = 1.0

    @property
    def divided_by(self) -> str:
        """Unit of a response, in m/s², that is divided by a strength."""
        return f"m/s² per {self.symbol}" if self.symbol else "m/s²"


def of_amplitudes(unit: str) -> StrengthUnit:
    """Amplitudes in ``unit``; ``"×"`` is that of a plain factor."""
    return StrengthUnit(title=f"Strength ({unit})", symbol="" if unit == "×" else unit)


def of_velocities(m_per_s_each: float) -> StrengthUnit:
    """Velocities of a probe, of which an amplitude of 1 has so many m/s."""
    return StrengthUnit(
        title="Probe velocity (mm/s)",
        symbol="mm/s",
        column="probe_velocity_m_per_s",
        factor=1e3 * m_per_s_each,
        si_factor=m_per_s_each,
    )
