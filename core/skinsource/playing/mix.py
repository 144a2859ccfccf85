"""What is played: samples of each output of a device, and the part that is played again."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from skinsource.arguments import finite_array, real_number
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

#: What a device gets.
Frames = NDArray[np.float32]

#: How long one sound passes into another.
FADE_S = 0.005
#: A loop has room for two of those.
SHORTEST_LOOP_S = 2 * FADE_S


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Mix:
    """Samples at the rate of a device, that do not change while they are played.

    Made by `mix_of`.

    Attributes
    ----------
    samples : (n_outputs, n_times)
        From time 0 of the design on; silence before and after.  1 is full scale.
    sample_rate_hz
        Their rate.
    peak
        Largest absolute sample.
    names
        Words for what each output plays, ``""`` where it is silent.
    loop
        First sample of what is played again and again, and the sample after its last; None:
        nothing is.
    seam : (n_outputs, n_seam)
        What the last samples of the loop play: they pass over into what stands before its first
        sample, so that the first is reached without a step.
    most_gain, limit
        The highest gain that the rig allows, and the limit that it would pass first.
    """

    samples: Frames
    sample_rate_hz: int
    peak: float
    names: tuple[str, ...]
    loop: tuple[int, int] | None = None
    seam: Frames
    most_gain: float = inf
    limit: str = ""

    @property
    def n_outputs(self) -> int:
        """Outputs of the device that it needs."""
        return self.samples.shape[0]

    @property
    def n_times(self) -> int:
        """Samples of each output."""
        return self.samples.shape[1]

    @property
    def duration_s(self) -> float:
        """How long it lasts."""
        return self.n_times / self.sample_rate_hz

    def plays_on(self, output: int) -> bool:
        """Whether an output, from 1, plays something."""
        return output <= len(self.names) and self.names[output - 1] != ""

    def read(self, position: int, out: Floats) -> int:
        """Fill ``out``, (n_outputs, n), with what is played from ``position`` on.

        Returns
        -------
        The position behind it: beyond the end of a loop it goes on at its first sample.
        """
        done, wanted = 0, out.shape[1]
        while done < wanted:
            end = position + wanted - done
            loops = self.loop is not None and position < self.loop[1] <= end
            if self.loop is not None and loops:
                end = self.loop[1]
            self._copy(position, end, out[:, done : done + end - position])
            if self.loop is not None and position < self.loop[1]:
                self._join(position, end, out[:, done : done + end - position])
            done += end - position
            position = self.loop[0] if self.loop is not None and loops else end
        return position

    def _copy(self, start: int, end: int, out: Floats) -> None:
        """Samples ``start`` to ``end`` as they are, silence where there are none."""
        first = min(max(start, 0), end)
        last = max(min(end, self.n_times), first)
        out[:, : first - start] = 0.0
        out[:, first - start : last - start] = self.samples[:, first:last]
        out[:, last - start :] = 0.0

    def _join(self, start: int, end: int, out: Floats) -> None:
        """Put the seam over the samples that it stands for."""
        if self.loop is None:
            return
        seam_start = self.loop[1] - self.seam.shape[1]
        first = max(start, seam_start)
        if first < end:
            out[:, first - start :] = self.seam[:, first - seam_start : end - seam_start]


def fade_samples(sample_rate_hz: int) -> int:
    """Samples of a fade."""
    return max(round(FADE_S * sample_rate_hz), 1)


def rise(n: int) -> Floats:
    """Half a cosine from nearly 0 to nearly 1, (n,): 0 stands before it, 1 after it."""
    risen: Floats = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, n + 1) / (n + 1))
    return risen


def mix_of(
    rows: Floats | Frames,
    sample_rate_hz: int,
    *,
    outputs: Sequence[int],
    titles: Sequence[str],
    n_outputs: int,
    loop_s: tuple[float, float] | None = None,
) -> Mix:
    """Return a mix of channels.

    Parameters
    ----------
    rows : (n_channels, n_times)
        What each channel plays, at the rate of the device; 1 is full scale, before the gain.
    sample_rate_hz
        Of the device.
    outputs
        Output of each channel, from 1; channels at one output add up.
    titles
        Words for each channel.
    n_outputs
        Outputs that the device gets samples for; those nobody uses are silent.
    loop_s
        Begin and end of what is played again and again.

    Raises
    ------
    InvalidInputError
        A sample is not finite, an output is not among those of the device, or the loop is shorter
        than 10 ms.
    """
    found = finite_array("samples", rows, largest=float(np.finfo(np.float32).max))
    if found.ndim != 2 or not len(outputs) == len(titles) == found.shape[0]:
        raise InvalidInputError(
            f"samples have the shape {found.shape}, expected (n_channels, n_times) with an output "
            f"for each of {len(outputs)} channels"
        )
    wrong = next((one for one in outputs if not 1 <= one <= n_outputs), None)
    if wrong is not None:
        raise InvalidInputError(f"output {wrong} is not among 1 to {n_outputs}")
    samples = np.zeros((n_outputs, found.shape[1]), np.float32)
    names: list[list[str]] = [[] for _ in range(n_outputs)]
    for row, output, title in zip(found, outputs, titles, strict=True):
        samples[output - 1] += row
        names[output - 1].append(title)
    samples.flags.writeable = False
    loop = _loop_of(loop_s, sample_rate_hz)
    return Mix(
        samples=samples,
        sample_rate_hz=sample_rate_hz,
        peak=float(np.abs(samples).max(initial=0.0)),
        names=tuple(" + ".join(one) for one in names),
        loop=loop,
        seam=_seam_of(samples, loop, sample_rate_hz),
    )


def _loop_of(loop_s: tuple[float, float] | None, rate_hz: int) -> tuple[int, int] | None:
    if loop_s is None:
        return None
    first_s, end_s = (real_number("loop_s", one, least=0.0) for one in loop_s)
    if end_s - first_s < SHORTEST_LOOP_S * (1 - 1e-9):
        raise InvalidInputError(
            f"The loop lasts {(end_s - first_s) * 1e3:.4g} ms, expected at least "
            f"{SHORTEST_LOOP_S * 1e3:g} ms. Drag its ends on the ruler apart."
        )
    return round(first_s * rate_hz), round(end_s * rate_hz)


def _seam_of(samples: Frames, loop: tuple[int, int] | None, rate_hz: int) -> Frames:
    """What the last samples of the loop play, (n_outputs, n_seam)."""
    if loop is None:
        return np.zeros((samples.shape[0], 0), np.float32)
    n = fade_samples(rate_hz)
    weight = rise(n)
    ending, before = (_part(samples, at - n, at) for at in (loop[1], loop[0]))
    return ((1.0 - weight) * ending + weight * before).astype(np.float32)


def _part(samples: Frames, start: int, end: int) -> Floats:
    """Samples ``start`` to ``end``, silence where there are none."""
    found = np.zeros((samples.shape[0], end - start))
    first = min(max(start, 0), samples.shape[1])
    part = samples[:, first : max(min(end, samples.shape[1]), first)]
    found[:, first - start : first - start + part.shape[1]] = part
    return found
