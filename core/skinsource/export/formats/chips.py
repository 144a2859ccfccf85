"""Arrays for driver chips, and the envelope of a drive, for devices that play no waveform.

Sources: Texas Instruments, DRV2605L data sheet (real-time playback) and DRV2665 data sheet (FIFO);
Boréas Technologies, BOS1901 data sheet and help pages (FIFO, waveforms near 0 V).
"""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import scipy

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.equalising import resonance_of
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.models import Piezo
from skinsource.base.conventions import Floats
from skinsource.engine.stimulus import Stimulus
from skinsource.export.formats.format import Choices, Facts, StimulusFile, StimulusFormat
from skinsource.export.formats.text import BYTES, rounding_of, write_header
from skinsource.signals.quantising import quantised
from skinsource.specs.spec import ChoiceSpec

# A point whose amplitude is a smaller share of the largest one has no frequency of its own.
_SILENT_SHARE = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Envelope:
    """Amplitude and frequency at equal steps.

    Attributes
    ----------
    time_s : (n_points,)
        Middles of the stretches; the first is 0, the last the end.
    amplitude : (n_points,)
        Amplitude of a sine that is as strong as the drive in that stretch, in parts of full scale.
    frequency_hz : (n_points,)
        Mean of the instantaneous frequency, weighted by power; that of the point before where
        the drive is silent.
    """

    time_s: Floats
    amplitude: Floats
    frequency_hz: Floats


def envelope_of(samples: Floats, rate_hz: float, step_s: float) -> Envelope:
    """Return amplitude and frequency of a drive, every ``step_s`` and at its end.

    They follow from the analytic signal: the root mean square of its length, and the mean turn
    from sample to sample, over one step about each point.  A steady sine has its own amplitude
    and frequency.

    Parameters
    ----------
    samples : (n_times,)
        The drive; silent before and after.
    rate_hz, step_s
        Its rate; at least one sample.
    """
    n = samples.size
    # Zeros after it: the transform is circular.
    analytic = scipy.signal.hilbert(np.concatenate((samples, np.zeros(n))))[:n]
    power = np.concatenate(([0.0], np.cumsum(np.abs(analytic) ** 2)))
    turns = np.concatenate(([0.0, 0.0], np.cumsum(analytic[1:] * analytic[:-1].conj())))
    end_s = n / rate_hz
    n_points = n_points_of(end_s, step_s)
    time_s = np.minimum(np.arange(n_points) * step_s, end_s)
    first = np.clip(np.round((time_s - step_s / 2) * rate_hz).astype(int), 0, n - 1)
    last = np.clip(np.round((time_s + step_s / 2) * rate_hz).astype(int), first + 1, n)
    amplitude = np.sqrt(np.maximum(power[last] - power[first], 0.0) / (last - first))
    turn = turns[last] - turns[np.minimum(first + 1, last)]
    frequency_hz = np.abs(np.angle(turn)) * rate_hz / (2.0 * np.pi)
    audible = amplitude > _SILENT_SHARE * max(float(amplitude.max(initial=0.0)), 1e-300)
    if audible.any():
        # Silent points take the frequency of the audible one before, the first ones that after.
        latest = np.maximum.accumulate(np.where(audible, np.arange(n_points), -1))
        frequency_hz = frequency_hz[np.where(latest < 0, int(np.argmax(audible)), latest)]
    return Envelope(time_s=time_s, amplitude=amplitude, frequency_hz=frequency_hz)


def n_points_of(end_s: float, step_s: float) -> int:
    """Return how many points an envelope has that ends at ``end_s``."""
    return max(int(np.ceil(end_s / step_s - 1e-9)), 1) + 1


def strength_of(stimulus: Stimulus, step_s: float) -> Stimulus:
    """Return the amplitudes of the envelopes of all channels, at the rate of their points."""
    rate_hz = stimulus.sample_rate_hz
    rows = [envelope_of(row, rate_hz, step_s).amplitude for row in stimulus.samples]
    return stimulus.with_samples(np.clip(rows, 0.0, 1.0), sample_rate_hz=1.0 / step_s)


_FIFO_HZ = 8000
_UPDATES = "updates"


class Drv2605l(StimulusFormat):
    """Amplitudes for real-time playback, with sign: 0x00 is off, 0x7F full."""

    name = "drv2605l"
    title = "DRV2605L, real-time playback"
    suffix = ".h"
    hint = "Amplitudes for the chip that drives an LRA at its own resonance"
    rate_hz = _FIFO_HZ
    fixed_rate = True
    plays_waveform = False
    device_steps = 127
    driven = "a linear resonant actuator of 125 to 300 Hz"
    numbers = "values"
    choices: ClassVar = {
        _UPDATES: ChoiceSpec(
            label="Updates",
            options=(("200", "200 a second"), ("100", "100 a second"), ("500", "500 a second")),
            hint="Amplitude updates per second; an LRA follows about a hundred",
        )
    }

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        step_hz = int(file.choices[_UPDATES])
        header = write_header(
            path,
            file,
            quantised(file.sent.samples, "int8").values,
            "int8_t",
            (
                "DRV2605L, real-time playback: write 0x05 to register 0x01, clear bit 3 of 0x1D "
                "(data",
                "with sign), then one value to 0x02 at each update. Amplitude only: the chip "
                "chooses",
                "the frequency, the resonance of the actuator. It must be in LRA mode: bit 7",
                "of 0x1A is set. I2C address 0x5A.",
            ),
            {
                "STIM_FS_HZ": f"{step_hz}UL",
                "STIM_FULL_SCALE": 127,
                "STIM_ZERO": 0,
                "STIM_MODE_REGISTER": "0x01",
                "STIM_MODE_RTP": "0x05",
                "STIM_DATA_REGISTER": "0x02",
            },
        )
        about = {"device_rate_hz": str(step_hz), "samples": "int8", "updates_hz": step_hz}
        return {**header, **about, "integer_zero": 0, "integer_full_scale": 127}

    def sent(self, stimulus: Stimulus, choices: Choices) -> Stimulus:
        """Return the amplitudes at their own rate."""
        sent = strength_of(stimulus, 1.0 / int(choices[_UPDATES]))
        amplitudes = np.array(sent.samples)
        # The last value holds until another comes.
        amplitudes[:, -1] = 0.0
        return sent.with_samples(amplitudes)

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return how many bytes it takes."""
        return n_channels * n_points_of(n_times / _FIFO_HZ, 1.0 / int(choices[_UPDATES]))

    def drives(self, model: Actuator) -> bool:
        """Return whether the chip can follow its resonance; that of a measured one is unknown."""
        if isinstance(model, Piezo | MeasuredResponse):
            return isinstance(model, MeasuredResponse)
        return 125.0 <= resonance_of(model)[0] <= 300.0

    def loses(self, choices: Choices) -> str:
        """Return a sentence on what is not in the file."""
        return (
            "Only the amplitude is sent, in 128 steps up to full scale; frequency and phase are "
            "the chip's."
        )


class _Fifo(StimulusFormat):
    """Samples for the FIFO of a piezo driver, with a 0 before and after them.

    Attributes
    ----------
    integers, kind
        Kind of whole numbers, and the type in C that holds them.
    comment
        Lines at the top of the file.
    """

    suffix = ".h"
    rate_hz = _FIFO_HZ
    fixed_rate = True
    driven = "a piezo"
    integers: str
    kind: str
    comment: tuple[str, ...]

    def drives(self, model: Actuator) -> bool:
        """Return whether it is a piezo, or may be one."""
        return isinstance(model, Piezo | MeasuredResponse)

    def write(self, file: StimulusFile, path: Path) -> Facts:
        """Write the file."""
        quantised_drives, facts = file.integers(self.integers)
        # What is wider than its integers holds only their lower bits.
        values = np.pad(quantised_drives.values.astype(np.int32), ((0, 0), (1, 1)))
        if self.kind == "uint16_t":
            values &= 2**quantised_drives.kind.bits - 1
        defines = {
            "STIM_FS_HZ": f"{_FIFO_HZ}UL",
            "STIM_FULL_SCALE": quantised_drives.full_scale,
            "STIM_ZERO": 0,
        }
        in_volts = file.stimulus.unit == "V"
        comment = (*self.comment, *(f"{self.scale_text(file.full_scale)}.",) * in_volts)
        header = write_header(path, file, values, self.kind, comment, defines)
        return {**facts, **header, "device_rate_hz": str(_FIFO_HZ)}

    def sent(self, stimulus: Stimulus, choices: Choices) -> Stimulus:
        """Return the samples with the 0 before and after them."""
        padded = np.pad(stimulus.samples, ((0, 0), (1, 1)))
        return stimulus.with_samples(padded, start_s=stimulus.start_s - 1.0 / _FIFO_HZ)

    def n_bytes(self, n_channels: int, n_times: int, choices: Choices) -> int:
        """Return about how many bytes it takes."""
        return BYTES[self.kind] * n_channels * (n_times + 2)

    def rounds(self, choices: Choices) -> bool:
        """Return whether whole numbers are written."""
        return True

    def loses(self, choices: Choices) -> str:
        """Return a sentence on what is not in the file."""
        return f"{rounding_of(self.integers)} What lies above 3.7 kHz is left out."


class Bos1901(_Fifo):
    """Words for the FIFO: 12 bits, two's complement, in register 0."""

    name = "bos1901"
    title = "BOS1901, FIFO"
    hint = "12-bit words for the piezo driver, at 8 kHz"
    numbers = "words, read as 12 bits with sign,"
    integers, kind = "int12", "uint16_t"
    device_v, device_steps, device = 95.0, 2047, "on the evaluation kit"
    comment = (
        "BOS1901: words for register 0x0, the FIFO of 64; PLAY of CONFIG: 8 kHz.",
        "Full scale is 95 V on the evaluation kit. First and last word are 0 V;",
        "a wave that stays within about 3 V of 0 without reaching it may stop it.",
    )


class Drv2665(_Fifo):
    """Bytes for the FIFO: 8 bits, two's complement."""

    name = "drv2665"
    title = "DRV2665, FIFO"
    hint = "Bytes for the piezo driver, at 8 kHz"
    integers, kind = "int8", "int8_t"
    device_v, device_steps, device = 25.0, 127, "at the least gain of the chip"
    comment = (
        "DRV2665: bytes for the FIFO of 100, which plays 8000 of them a second. First and",
        "last byte are 0.",
    )
