"""Where a person is calibrated: a rig with a sensor, or what stands in for both."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from skinsource.actuators.rigs import Rig
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.stream import Mix
from skinsource.lab.rig_measuring.measurement import MeasuringSetup, card_of, recording_of

#: Gets the number of samples that are recorded so far.
Report = Callable[[int], None]


class Station(Protocol):
    """Plays on the actuators of a rig, and records the sensor at the same time."""

    @property
    def rig(self) -> Rig:
        """What is wired to the outputs, with measured responses."""

    @property
    def setup(self) -> MeasuringSetup:
        """The sensor and its input; of the rest nothing is used."""

    @property
    def sample_rate_hz(self) -> int:
        """Of what is played and recorded."""

    def record(self, mix: Mix, stop: Stop, report: Report) -> Floats:
        """Play a mix as it is, and return what the sensor's input recorded, (n_times,).

        Samples are in parts of full scale; they begin with the first one played, and are as many.

        Raises
        ------
        PlaybackError
            The device refuses, loses samples, or stops answering.
        Stopped
            ``stop`` returned True; all is silent.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class CardStation:
    """A sound card that plays on the actuators of a rig, and records the sensor.

    Attributes
    ----------
    rig
        All of its channels are on one device.
    setup
        The sensor and its input, on the same device.
    output
        Sample rate and delay of the device, and the device where the channels name none.
    """

    rig: Rig
    setup: MeasuringSetup
    output: Output = field(default_factory=Output)

    @property
    def sample_rate_hz(self) -> int:
        """Of what is played and recorded."""
        return self.output.sample_rate_hz

    def record(self, mix: Mix, stop: Stop, report: Report) -> Floats:
        """Play a mix, and return what the sensor recorded; see `Station`.

        Raises
        ------
        InvalidInputError
            Channels or the sensor are on another device, whose clock is another one.
        PlaybackError, Stopped
            As of `Station`.
        """
        named = {channel.device for channel in self.rig.channels}
        highest = max(self.rig.channels, key=lambda channel: channel.output)
        card = card_of(highest, self.setup, self.output)
        if len(named) > 1 or card.two_clocks:
            raise InvalidInputError(
                "All actuators and the sensor must be on one device, so that they are in step. "
                "Wire them to one, or choose another rig."
            )
        recorded, _ = recording_of(mix, card, 0.0, stop, report)
        return recorded[self.setup.input_number - 1]
