"""The limb that scenes are computed on: what it is like, and how its responses are reached."""

import hashlib
from dataclasses import dataclass

import numpy as np

from skinsource.catalogue import load_limb
from skinsource.counting import counted
from skinsource.limb import N_INPUTS, N_OUTPUTS, N_TAPS, SAMPLE_RATE_HZ, Axes, Limb
from skinsource.method_comparison.made_up import made_up_limb
from skinsource.own_limbs import facts_of

_MOST_VISIBLE = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedLimb:
    """All that scenes, engines and rows know of a limb.

    Attributes
    ----------
    name
        As `skinsource.catalogue.load_limb` knows it.
    digest
        SHA-256 of its numbers; empty of the made-up one, whose responses are always the same.
    n_inputs, n_outputs, axes, n_taps, sample_rate_hz
        As of `Limb`.
    visible_outputs, checked_axes
        Outputs that a window would show, and axes (0 is the first), at which errors are measured.
    """

    name: str
    digest: str
    n_inputs: int
    n_outputs: int
    axes: Axes
    n_taps: int
    sample_rate_hz: float
    visible_outputs: tuple[int, ...]
    checked_axes: tuple[int, ...]

    @property
    def n_axes(self) -> int:
        """How many axes each output has."""
        return len(self.axes)

    @property
    def n_channels(self) -> int:
        """How many signals a response has: each output along each axis."""
        return self.n_outputs * self.n_axes

    @property
    def checked_channels(self) -> tuple[int, ...]:
        """Where errors are measured, as n_axes (output - 1) + axis."""
        return tuple(
            self.n_axes * (output - 1) + axis
            for output in self.visible_outputs
            for axis in self.checked_axes
        )

    @property
    def size(self) -> str:
        """Words for its shape and rate."""
        return (
            f"{counted(self.n_inputs, 'place')} × {counted(self.n_outputs, 'output')} × "
            f"{counted(self.n_axes, 'axis', 'axes')} ({self.axes}) × "
            f"{counted(self.n_taps, 'sample')}, {self.sample_rate_hz:g} Hz"
        )

    def load(self) -> Limb:
        """Open it anew: its responses are read when touched, and go with it.

        Raises as `skinsource.catalogue.load_limb`: it may have been removed or replaced meanwhile.
        """
        return made_up_limb() if self == MADE_UP else load_limb(self.name, self.digest)


#: What is measured where no limb is named: whole numbers in the shape of the published limbs.
MADE_UP = ComparedLimb(
    name="made-up",
    digest="",
    n_inputs=N_INPUTS,
    n_outputs=N_OUTPUTS,
    axes="xyz",
    n_taps=N_TAPS,
    sample_rate_hz=SAMPLE_RATE_HZ,
    visible_outputs=(29, 30, 33, 35, 38, 52),
    checked_axes=(0, 2),
)


def limb_called(name: str, digest: str = "") -> ComparedLimb:
    """Return what is known of an installed limb.

    Parameters
    ----------
    name, digest
        As of `ComparedLimb`; where no digest is given, that of its numbers as they are now.

    Raises as `skinsource.catalogue.load_limb`.
    """
    limb = load_limb(name, digest)
    return limb_of_size(
        name=name,
        digest=digest or facts_of(name).digest or sha256_of(limb),
        n_inputs=limb.n_inputs,
        n_outputs=limb.n_outputs,
        axes=limb.axes,
        n_taps=limb.n_taps,
        sample_rate_hz=limb.sample_rate_hz,
    )


def limb_of_size(
    *,
    name: str,
    digest: str,
    n_inputs: int,
    n_outputs: int,
    axes: Axes,
    n_taps: int,
    sample_rate_hz: float,
) -> ComparedLimb:
    """A limb whose errors are measured at outputs spread over all, along first and last axis."""
    spread = np.linspace(1, n_outputs, min(n_outputs, _MOST_VISIBLE)).astype(int)
    return ComparedLimb(
        name=name,
        digest=digest,
        n_inputs=n_inputs,
        n_outputs=n_outputs,
        axes=axes,
        n_taps=n_taps,
        sample_rate_hz=sample_rate_hz,
        visible_outputs=tuple(map(int, spread)),
        checked_axes=tuple(sorted({0, len(axes) - 1})),
    )


def sha256_of(limb: Limb) -> str:
    """Hash of all responses, (n_inputs, n_outputs, n_axes, n_taps), as little-endian float64."""
    digest = hashlib.sha256()
    for location in range(1, limb.n_inputs + 1):
        digest.update(np.ascontiguousarray(limb.response_to(location), "<f8").data)
    return digest.hexdigest()
