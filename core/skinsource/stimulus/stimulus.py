"""Channels with their samples."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.limb import BAND_HZ, Band
from skinsource.resampling import PASSED_SHARE
from skinsource.scaling.response_scaling import Scaling
from skinsource.stimulus.channel import Channel


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stimulus:
    """Sampled channels side by side.

    Attributes
    ----------
    channels
        What they are; none where nothing is heard.
    samples : (n_channels, n_times)
        Amplitude times gain times waveform, read-only.
    sample_rate_hz
        Their rate.
    limb
        Name of the limb that the design is for.
    scaling
        What an amplitude of 1 means in that design.
    start_s
        Time of the design at which the first sample lies.
    own_rate_hz
        Rate at which the design was sampled: nothing above its half is in the samples.
    unit
        Of the samples of channels that have a place, see `skinsource.chain.drive_unit`.
    limb_band_hz
        In which the limb was measured; None: not known.
    """

    channels: tuple[Channel, ...]
    samples: Floats
    sample_rate_hz: float
    limb: str
    scaling: Scaling
    start_s: float = 0.0
    own_rate_hz: float
    unit: str
    limb_band_hz: Band | None = BAND_HZ

    def __post_init__(self) -> None:
        if self.samples.ndim != 2 or len(self.channels) != self.samples.shape[0]:
            raise ValueError(
                f"samples have the shape {self.samples.shape}, expected "
                f"({len(self.channels)} channels, n_times)"
            )
        held = self.samples.view()
        held.flags.writeable = False
        object.__setattr__(self, "samples", held)

    @property
    def n_times(self) -> int:
        """Samples of each channel."""
        return self.samples.shape[1]

    @property
    def duration_s(self) -> float:
        """How long it lasts."""
        return self.n_times / self.sample_rate_hz

    @property
    def band_hz(self) -> Band:
        """Lowest and highest frequency at which what is written is what was predicted."""
        lower_hz = min(self.sample_rate_hz, self.own_rate_hz)
        low_hz, high_hz = self.limb_band_hz or (0.0, np.inf)
        return low_hz, min(high_hz, PASSED_SHARE * 0.5 * lower_hz)

    @property
    def driving(self) -> tuple[int, ...]:
        """Rows of the channels that drive an actuator."""
        return tuple(row for row, one in enumerate(self.channels) if one.place is not None)

    def with_samples(self, samples: Floats, **changes: object) -> "Stimulus":
        """Return a copy that holds other samples."""
        return replace(self, samples=samples, **changes)  # type: ignore[arg-type]


def numbered(channels: Iterable[Channel]) -> tuple[Channel, ...]:
    """Number ``channels`` from 1 in their order."""
    return tuple(replace(one, number=number) for number, one in enumerate(channels, start=1))


def peaks(samples: Floats) -> Floats:
    """Largest absolute sample of each channel, (n_channels,); without a copy of them all."""
    if not samples.shape[1]:
        return np.zeros(samples.shape[0])
    return np.maximum(samples.max(axis=1), -samples.min(axis=1))
