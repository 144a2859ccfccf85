"""How an actuator moves."""

from dataclasses import dataclass

from skinsource.arrays import Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActuatorMotion:
    """Motion of what touches the skin, at the samples of the voltage.

    Attributes
    ----------
    acceleration, velocity, displacement : (n_times,)
        In m/s², m/s and m.
    current : (n_times,)
        Into the actuator, in A.
    """

    acceleration: Floats
    velocity: Floats
    displacement: Floats
    current: Floats
