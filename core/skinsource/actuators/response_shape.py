"""What is known of an actuator whose constants nobody published: where it resonates."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from skinsource import fields
from skinsource.actuators import parameters
from skinsource.arguments import finite_array
from skinsource.arrays import Complexes


@dataclass(frozen=True, slots=True)
class ResponseShape:
    """A resonance without a scale: it shows a shape, and cannot be simulated in m/s².

    Attributes
    ----------
    resonance_hz, quality
        Of the moving mass on its spring, both above 0.
    """

    title: ClassVar[str] = "Response shape"

    resonance_hz: float = fields.field(parameters.positive("Resonance", "Hz"))
    quality: float = fields.field(parameters.positive("Quality", ""))

    def __post_init__(self) -> None:
        fields.check(self)

    def shape(self, frequency_hz: ArrayLike) -> Complexes:
        """Acceleration at equal force over that far above the resonance, without a unit.

        s² / (s² + s w / Q + w²), of the shape of ``frequency_hz``.
        """
        ratio = finite_array("frequency_hz", frequency_hz) / self.resonance_hz
        found: Complexes = np.asarray(
            -(ratio**2) / (1.0 - ratio**2 + 1j * ratio / self.quality), np.complex128
        )
        return found
