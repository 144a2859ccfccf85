"""The stand-in person: a synthetic limb of another size, on a rig that is not there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import ceil
from typing import Literal

import numpy as np
import scipy

from skinsource.actuators.actuation import load
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel, full_scale_volts
from skinsource.base.conventions import Floats
from skinsource.base.job import Stop, stop_if
from skinsource.inverse.responses import PERPENDICULAR_INPUTS
from skinsource.lab.calibrating.station import Report
from skinsource.lab.playing.stream import Mix
from skinsource.lab.rig_measuring.measurement import MeasuringSetup
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import pulse_spectrum
from skinsource.limbs.synthetic import synthetic_person

#: What may go wrong at a place, once: the sensor's input clips; the actuator has come off; samples
#: are lost; the sensor slips by 20 mm or a little more, and stays there.
Fault = Literal["clips", "off", "late", "moves"]
_ACTUATOR, _FULL_SCALE_V = "example-voice-coil", 4.0
_MEASURED_HZ = np.geomspace(10.0, 1000.0, 240)
#: From a sample to its recording, without actuator and skin; samples lost when it is late.
_LATENCY_S, _LOST_S, _SLIP_MM = 0.0123, 0.002, 20.0


@dataclass(kw_only=True, eq=False)
class StandIn:
    """A person and a rig that are computed: all can be tried without hardware.

    The same seed gives the same person, errors and noise, in the same order of recordings.  It
    answers at once.

    Attributes
    ----------
    seed
        Of the person, the errors of the rig, and the noise.
    output
        Where the sensor lies, from 1; set it to move the sensor.
    inputs
        Places with an actuator.
    noise_m_per_s2
        RMS of the noise of the sensor.
    gain_db, delay_s
        Largest errors of the gains and delays that the rig does not know of.
    faults
        What goes wrong when a place is played the next time; it goes wrong once.
    others
        Names of limbs that can be the other people.
    like
        Name of the limb whose places it has.
    sample_rate_hz
        Of what is played and recorded.
    """

    seed: int = 0
    output: int = 9
    inputs: tuple[int, ...] = PERPENDICULAR_INPUTS
    noise_m_per_s2: float = 0.01
    gain_db: float = 3.0
    delay_s: float = 1e-4
    faults: Mapping[int, Fault] = field(default_factory=dict)
    others: tuple[str, ...] = ("synthetic-2", "synthetic-3", "synthetic-4")
    like: str = "synthetic-1"
    sample_rate_hz: int = 8000

    def __post_init__(self) -> None:
        self._ahead = dict(self.faults)
        self._noise = np.random.default_rng([self.seed, 1])

    @cached_property
    def limb(self) -> Limb:
        """The person, as nobody could ever measure."""
        random = np.random.default_rng(self.seed)
        # As far from the others as they are from one another: a sensor elsewhere can be told.
        length_mm = round(float(random.uniform(160.0, 178.0)), 1)
        return synthetic_person(1, hand_length_mm=length_mm, seed=100 + self.seed)

    @cached_property
    def errors(self) -> dict[int, tuple[float, float]]:
        """By place, the factor of the gain and the delay that the rig does not know of."""
        random = np.random.default_rng([self.seed, 2])
        gains = 10.0 ** (random.uniform(-self.gain_db, self.gain_db, len(self.inputs)) / 20.0)
        delays_s = random.uniform(-self.delay_s, self.delay_s, len(self.inputs))
        return {
            place: (float(gain), float(delay_s))
            for place, gain, delay_s in zip(self.inputs, gains, delays_s, strict=True)
        }

    @cached_property
    def rig(self) -> Rig:
        """A channel for each place, with the response that the rig believes in."""
        measured = MeasuredResponse.of(_MEASURED_HZ, load(_ACTUATOR).response(_MEASURED_HZ))
        channels = tuple(
            RigChannel(
                place=place,
                actuator=_ACTUATOR,
                device="Stand-in person",
                output=number,
                full_scale_v=_FULL_SCALE_V,
                measured=measured,
                measured_on="2026-01-01",
            )
            for number, place in enumerate(self.inputs, start=1)
        )
        note = f"Computed from a synthetic limb, seed {self.seed}: nobody was measured."
        return Rig(title="Stand-in person", note=note, channels=channels)

    @property
    def setup(self) -> MeasuringSetup:
        """An accelerometer on input 1."""
        return MeasuringSetup()

    def record(self, mix: Mix, stop: Stop, report: Report) -> Floats:
        """Return what the sensor would have recorded; see `Station`."""
        stop_if(stop)
        rate_hz, limb = self.sample_rate_hz, self.limb
        # Whole seconds have bins at the same frequencies at both rates.
        n_seconds = ceil(mix.n_times / rate_hz + 1.0)
        n_skin = round(n_seconds * limb.sample_rate_hz)
        hz = np.arange(n_skin // 2) / n_seconds
        model = load(_ACTUATOR).response(hz) / pulse_spectrum(hz, limb.sample_rate_hz)
        moved = np.zeros(n_seconds * rate_hz // 2 + 1, complex)
        fault: Fault | None = None
        for channel in self.rig.channels:
            if not (mix.plays_on(channel.output) and mix.samples[channel.output - 1].any()):
                continue
            fault = self._ahead.pop(channel.place, fault)
            if fault == "moves":
                places_mm = limb.output_positions_mm
                away = np.hypot(*(places_mm - places_mm[self.output - 1]).T)
                self.output = int(np.nanargmin(np.where(away < _SLIP_MM, np.nan, away))) + 1
            gain, late_s = self.errors[channel.place]
            late_s += _LATENCY_S - limb.pre_trigger_delay_s
            played = scipy.fft.rfft(mix.samples[channel.output - 1], n_seconds * rate_hz)
            skin = scipy.fft.rfft(limb.response_to(channel.place)[self.output - 1, -1], n_skin)
            skin = skin[: hz.size] * model * np.exp(-2j * np.pi * hz * late_s)
            if fault != "off":
                moved[: hz.size] += gain * full_scale_volts(channel) * played[: hz.size] * skin
        came = scipy.fft.irfft(moved, n_seconds * rate_hz)[: mix.n_times]
        came += self.noise_m_per_s2 * self._noise.standard_normal(mix.n_times)
        came /= self.setup.m_per_s2_at_full_scale
        if fault == "clips":
            came *= 2.0 / np.abs(came).max()
        if fault == "late":
            half, lost = mix.n_times // 2, round(_LOST_S * rate_hz)
            came[half:] = np.roll(came[half:], -lost)
        report(mix.n_times)
        return np.clip(came, -1.0, 1.0)
