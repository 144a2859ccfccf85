"""Arrays for driver chips: DRV2605L, BOS1901, DRV2665.

Sources: Texas Instruments, DRV2605L data sheet (real-time playback) and DRV2665 data sheet (FIFO);
Boréas Technologies, BOS1901 data sheet and help pages (FIFO, waveforms near 0 V).
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from skinsource.fields import ChoiceSpec
from skinsource.quantising import quantised
from skinsource.stimulus_formats.c_text import write_header
from skinsource.stimulus_formats.column_names import channel_names
from skinsource.stimulus_formats.envelopes import envelope_of
from skinsource.stimulus_formats.stimulus_format import Facts, Outgoing, StimulusFormat

_FIFO_HZ = 8000
_UPDATES = "updates"
#: What the evaluation kit of the BOS1901 plays at full scale.
_BOS_VOLTS = 95


def write_drv2605l(outgoing: Outgoing, path: Path) -> Facts:
    """Write amplitudes for real-time playback, with sign: 0x00 is off, 0x7F full."""
    step_hz = int(outgoing.choices[_UPDATES])
    stimulus = outgoing.stimulus
    amplitudes = np.stack(
        [
            envelope_of(row, stimulus.sample_rate_hz, 1.0 / step_hz).amplitude
            for row in stimulus.samples
        ]
    )
    # The last value holds until another comes.
    amplitudes[:, -1] = 0.0
    found = quantised(np.clip(amplitudes, 0.0, 1.0), "int8")
    return _written(
        outgoing,
        path,
        found.values,
        kind="int8_t",
        words=(
            "DRV2605L, real-time playback: write 0x05 to register 0x01, clear bit 3 of 0x1D (data",
            "with sign), then one value to 0x02 at each update. Amplitude only: the chip chooses",
            "the frequency, the resonance of the actuator. I2C address 0x5A.",
        ),
        defines={
            "STIM_FS_HZ": f"{step_hz}UL",
            "STIM_FULL_SCALE": "127",
            "STIM_ZERO": "0",
            "STIM_MODE_REGISTER": "0x01",
            "STIM_MODE_RTP": "0x05",
            "STIM_DATA_REGISTER": "0x02",
        },
    ) | {"samples": "int8", "updates_hz": step_hz}


def write_bos1901(outgoing: Outgoing, path: Path) -> Facts:
    """Write words for the FIFO: 12 bits, two's complement, in register 0."""
    found, facts = outgoing.whole_numbers("int12")
    words = _silent_ends(found.values.astype(np.int32)) & 0x0FFF
    return {
        **facts,
        **_written(
            outgoing,
            path,
            words,
            kind="uint16_t",
            words=(
                "BOS1901: words for register 0x0, the FIFO of 64; PLAY of CONFIG: 8 kHz.",
                f"Full scale is {_BOS_VOLTS} V on the evaluation kit. First and last word are 0 V;",
                "a wave that stays within about 3 V of 0 without reaching it may stop it.",
            ),
            defines={
                "STIM_FS_HZ": f"{_FIFO_HZ}UL",
                "STIM_FULL_SCALE": f"{found.full_scale}",
                "STIM_ZERO": "0",
            },
        ),
    }


def write_drv2665(outgoing: Outgoing, path: Path) -> Facts:
    """Write bytes for the FIFO: 8 bits, two's complement."""
    found, facts = outgoing.whole_numbers("int8")
    return {
        **facts,
        **_written(
            outgoing,
            path,
            _silent_ends(found.values),
            kind="int8_t",
            words=(
                "DRV2665: bytes for the FIFO of 100, which plays 8000 of them a second. First and",
                "last byte are 0.",
            ),
            defines={
                "STIM_FS_HZ": f"{_FIFO_HZ}UL",
                "STIM_FULL_SCALE": f"{found.full_scale}",
                "STIM_ZERO": "0",
            },
        ),
    }


def _silent_ends(values: NDArray[np.integer]) -> NDArray[np.integer]:
    """The values, with a 0 before and after them."""
    return np.pad(values, ((0, 0), (1, 1)))


def _written(
    outgoing: Outgoing,
    path: Path,
    values: NDArray[np.integer],
    *,
    kind: str,
    words: tuple[str, ...],
    defines: dict[str, str],
) -> dict[str, object]:
    names = [f"stim_{name}" for name in channel_names(outgoing.stimulus)]
    n_bytes = write_header(
        path,
        outgoing,
        words=words,
        defines=defines,
        kind=kind,
        arrays=dict(zip(names, values, strict=True)),
        stop=outgoing.stop,
    )
    return {"array_bytes": n_bytes, "arrays": names, "device_rate_hz": defines["STIM_FS_HZ"][:-2]}


def _bytes_per_update(n_channels: int, n_times: int, choices: Mapping[str, str]) -> int:
    return n_channels * (n_times * int(choices[_UPDATES]) // _FIFO_HZ + 2)


_EIGHT_BITS = (
    "8 bits: each sample is rounded, by at most 48 dB below full scale. What lies above 3.7 kHz is "
    "left out."
)

DRV2605L = StimulusFormat(
    name="drv2605l",
    title="DRV2605L, real-time playback",
    suffix=".h",
    hint="Amplitudes for the chip that drives an LRA at its own resonance",
    write=write_drv2605l,
    bytes_of=_bytes_per_update,
    rate_hz=_FIFO_HZ,
    fixed_rate=True,
    choices={
        _UPDATES: ChoiceSpec(
            label="Updates",
            options=(("200", "200 a second"), ("100", "100 a second"), ("500", "500 a second")),
            hint="How often the amplitude changes; an LRA follows some hundred a second",
        )
    },
    loses=lambda _: (
        "The waveform: only how strong it is, in 128 steps, reaches the actuator; "
        "frequency and phase are the chip's."
    ),
)
BOS1901 = StimulusFormat(
    name="bos1901",
    title="BOS1901, FIFO",
    suffix=".h",
    hint="12-bit words for the piezo driver, at 8 kHz",
    write=write_bos1901,
    bytes_of=lambda n_channels, n_times, _: 2 * n_channels * (n_times + 2),
    rounds=lambda _: True,
    rate_hz=_FIFO_HZ,
    fixed_rate=True,
    loses=lambda _: (
        "12 bits: each sample is rounded, by at most 72 dB below full scale. What lies "
        "above 3.7 kHz is left out."
    ),
)
DRV2665 = StimulusFormat(
    name="drv2665",
    title="DRV2665, FIFO",
    suffix=".h",
    hint="Bytes for the piezo driver, at 8 kHz",
    write=write_drv2665,
    bytes_of=lambda n_channels, n_times, _: n_channels * (n_times + 2),
    rounds=lambda _: True,
    rate_hz=_FIFO_HZ,
    fixed_rate=True,
    loses=lambda _: _EIGHT_BITS,
)
