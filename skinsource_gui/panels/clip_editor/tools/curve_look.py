"""How a curve of breakpoints looks in the clip editor."""

from dataclasses import dataclass

from skinsource.design.effects import breakpoints as algebra


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveLook:
    """How a curve is painted and named.

    Attributes
    ----------
    colour
        Name of its colour in a theme.
    mirrored
        Whether it is painted upside down too, as an envelope is around a waveform.
    label, unit
        What its values are.
    highest
        No point goes higher.
    bends
        Whether a segment may be smooth, or held.
    how
        What is said while there is nothing but its start.
    """

    colour: str = "warning"
    mirrored: bool = True
    label: str = ""
    unit: str = ""
    highest: float = algebra.HIGHEST
    bends: bool = True
    how: str = ""
