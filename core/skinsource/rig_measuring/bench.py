"""All that is needed to measure a channel, looked for before anything is played."""

from dataclasses import dataclass, replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.measuring.exponential_sweep import exponential_sweep
from skinsource.playing import Output
from skinsource.playing.devices import check_outputs, device_of, devices
from skinsource.quoting import quoted
from skinsource.rig_measuring.duplex import Card
from skinsource.rig_measuring.inputs import check_inputs, input_device_of, input_devices
from skinsource.rig_measuring.setup import LONGEST_DELAY_S, MeasuringSetup
from skinsource.rigs import Rig, RigChannel

# After each sweep, in which what rings dies away.
_REST_S = 0.5
# The sweep goes beyond what is wanted: so the delay is told well, and the ends are whole.
_LOWER, _HIGHER = 0.6, 4.0
_MOST_OF_RATE = 0.42
# At least so many outputs and inputs, where the device has them: some know pairs only.
FEWEST_WAYS = 2


@dataclass(frozen=True, slots=True, eq=False)
class Bench:
    """All that stays the same while a channel is measured."""

    channel: RigChannel
    volts: float
    setup: MeasuringSetup
    card: Card
    rate_hz: int
    sweep: Floats
    swept_hz: tuple[float, float]

    @property
    def numbers(self) -> tuple[int, ...]:
        """Inputs that are looked at."""
        setup = self.setup
        return tuple(one for one in (setup.input_number, setup.loopback_input) if one)

    @property
    def period(self) -> int:
        """Samples from one sweep to the next."""
        return self.sweep.size + round(_REST_S * self.rate_hz)

    def sweep_by(self, clock_ratio: float) -> Floats:
        """One period, (period,), as a clock counts it that is so many times as quick."""
        found = np.zeros(self.period)
        sweep = self.sweep
        if clock_ratio != 1.0:
            sweep = exponential_sweep(self.swept_hz, self.setup.sweep_s, self.rate_hz, clock_ratio)
        found[: sweep.size] = sweep
        return found

    def row(self, repeats: int, lead: int) -> Floats:
        """Samples that are played at a gain of 1, (n_times,)."""
        one = self.sweep_by(1.0)
        tail = np.zeros(round(LONGEST_DELAY_S * self.rate_hz))
        return np.concatenate((np.zeros(lead), np.tile(one, repeats), tail))


def measurable(
    channel: RigChannel, setup: MeasuringSetup, sample_rate_hz: float
) -> tuple[float, float]:
    """Volts at full scale, and the highest frequency that can be told, Hz.

    Raises
    ------
    InvalidInputError
        The channel or the setup cannot be measured, whatever devices there are.
    """
    volts = channel.volts_at_full_scale
    if volts is None:
        raise InvalidInputError(
            f"place {channel.place}: the rig does not say the volts at full scale, without which "
            "m/s² per V cannot be told; measure them with a tone and a voltmeter"
        )
    highest_hz = _MOST_OF_RATE * sample_rate_hz
    if setup.highest_hz > highest_hz:
        raise InvalidInputError(
            f"the response is wanted up to {setup.highest_hz:g} Hz, and {sample_rate_hz:g} Hz can "
            f"tell at most {highest_hz:.0f} Hz; choose a higher rate"
        )
    return volts, highest_hz


def bench_of(rig: Rig, place: int, setup: MeasuringSetup, output: Output) -> Bench:
    """Look for all that is needed; refuse what is missing before anything is played."""
    channel = rig.channel_of(place)
    if channel is None:
        raise InvalidInputError(
            f"place {place} is not wired in the rig {quoted(rig.title)}; add a channel for it"
        )
    rate_hz = output.sample_rate_hz
    volts, highest_hz = measurable(channel, setup, rate_hz)
    swept_hz = _LOWER * setup.lowest_hz, min(_HIGHER * setup.highest_hz, highest_hz)
    found = devices()
    named = [one for one in found if channel.device in (one.name, one.title)]
    if channel.device:
        own = named[0].name if named else channel.device
        api = named[0].host_api if named else ""
        output = replace(output, device=own, host_api=api)
    device = device_of(output, found)
    check_outputs(device, {place: channel.output})
    inputs = input_device_of(setup.input_device, device, input_devices())
    check_inputs(inputs, setup.input_number, setup.loopback_input)
    most = max(setup.input_number, setup.loopback_input)
    card = Card(
        device=device,
        inputs=inputs,
        n_inputs=max(most, min(FEWEST_WAYS, inputs.n_inputs)),
        latency_s=output.latency_s,
    )
    sweep = exponential_sweep(swept_hz, setup.sweep_s, rate_hz)
    return Bench(channel, volts, setup, card, rate_hz, sweep, swept_hz)
