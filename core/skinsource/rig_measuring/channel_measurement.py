"""What was measured of one channel of a rig."""

from dataclasses import dataclass, replace
from datetime import date

import numpy as np

from skinsource.actuators import MeasuredResponse
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.rigs import Rig

# A phase further from what a delay explains says little; about 30 degrees.
_DOUBTFUL_RAD = 0.5
# What less is, a sweep hardly tells; and it turns the phase by nothing.
_SAME_CLOCK_PPM = 0.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChannelMeasurement:
    """The response of one channel, and how far it can be trusted.

    Attributes
    ----------
    place
        Input place of the channel.
    response
        Acceleration for each volt at the actuator, without the delay.
    error : (n_points,)
        Standard error of each of its points, relative to the gain.
    n_left_out
        Points of the band that the noise covers, and that are left out.
    delay_s
        From a sample that is played to the one that is recorded of it: out of the device, through
        actuator and sensor, and in again; with two devices also when each of them began.
    delay_by_wire
        Whether a loop-back said so; else the phase did.
    played_on, recorded_from
        Names of the devices.
    clock_ppm
        How much quicker the clock of the inputs is than that of the outputs, in millionths; None:
        both are one device.
    inverted
        Whether the sensor moves against the voltage.
    misfit_rad
        Root mean square of the phase that neither gain nor delay explain.
    noise_m_per_s2
        RMS while nothing was played.
    peak_m_per_s2
        Largest acceleration that was recorded.
    peak_input_db
        The same at the input, dB of full scale.
    level_db
        Of the sweep, dB of full scale.
    measured_on
        Date.
    """

    place: int
    response: MeasuredResponse
    error: Floats
    n_left_out: int
    delay_s: float
    delay_by_wire: bool
    played_on: str
    recorded_from: str
    clock_ppm: float | None
    inverted: bool
    misfit_rad: float
    noise_m_per_s2: float
    peak_m_per_s2: float
    peak_input_db: float
    level_db: float
    measured_on: date

    @property
    def lines(self) -> tuple[str, ...]:
        """What there is to tell, a sentence each."""
        points = self.response.points
        by = "the loop-back" if self.delay_by_wire else "the phase"
        typical, worst = 100.0 * np.median(self.error), 100.0 * np.max(self.error)
        left_out = f"; {self.n_left_out} under the noise are left out" if self.n_left_out else ""
        told = [
            f"Place {self.place}: {len(points)} points from {points[0][0]:.4g} to "
            f"{points[-1][0]:.4g} Hz{left_out}.",
            f"Their standard error is {typical:.2g} % in the middle, at most {worst:.2g} %.",
            f"The delay from output to input is {self.delay_s * 1e3:.2f} ms, told from {by}; the "
            "response is without it.",
            *self._clocks,
            f"At the input: peak {self.peak_m_per_s2:.3g} m/s² ({self.peak_input_db:z.1f} dB of "
            f"full scale), noise {self.noise_m_per_s2:.2g} m/s² RMS.".replace("-", "\u2212"),
        ]
        if self.inverted:
            told.append(
                "It moves against the voltage: set the polarity to the other, or turn the sensor, "
                "and measure again."
            )
        if self.misfit_rad > _DOUBTFUL_RAD:
            told.append(
                f"Its phase is doubtful: {np.degrees(self.misfit_rad):.0f} degrees of it are "
                "explained by neither gain nor delay. Wire a loop-back, or look at the sensor."
            )
        return tuple(told)

    @property
    def _clocks(self) -> tuple[str, ...]:
        """What two devices make of it."""
        ppm = self.clock_ppm
        if ppm is None:
            return ()
        if abs(ppm) < _SAME_CLOCK_PPM:
            clocks = "Their clocks agree."
        else:
            clocks = (
                f"The clock of the input is {abs(ppm):.1f} millionths "
                f"{'quicker' if ppm > 0.0 else 'slower'}, told from the sweeps; the response is "
                "without that, too."
            )
        return (
            f"Output and input are two devices, {self.played_on} and {self.recorded_from}, which "
            "begin when they can: the delay is that of this take alone.",
            clocks,
        )


def kept(rig: Rig, measurement: ChannelMeasurement) -> Rig:
    """The rig with what was measured in its channel, and the date.

    Raises
    ------
    InvalidInputError
        Nothing is wired to that place any more.
    """
    if rig.channel_of(measurement.place) is None:
        raise InvalidInputError(
            f"place {measurement.place} is not wired in the rig {quoted(rig.title)}"
        )
    day = measurement.measured_on.isoformat()
    return replace(
        rig,
        channels=tuple(
            replace(one, measured=measurement.response, measured_on=day)
            if one.place == measurement.place
            else one
            for one in rig.channels
        ),
    )
