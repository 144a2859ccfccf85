"""The scenes on which engines are measured."""

import itertools
import math
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

from skinsource.counting import counted
from skinsource.method_comparison.compared_limb import MADE_UP, ComparedLimb
from skinsource.signals import sample_count

_SEVERAL = 4
# Neighbours in a scene are far apart on the limb.
_FIRST_PLACE, _LEAST_STEP = 6, 7
_CHANGED = 4
# The silence between two bursts, after the response to the first has died away.
_PAUSE_S = 0.25


@dataclass(frozen=True, slots=True, kw_only=True)
class Player:
    """One input of a scene: made-up noise at a place.

    Attributes
    ----------
    location, amplitude
        Input place, from 1 on, and factor.
    seed
        Of the noise.
    start, n_times
        Onset and length, in samples.
    """

    location: int
    seed: int
    n_times: int
    amplitude: float = 1.0
    start: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedScene:
    """What is to be computed.

    Attributes
    ----------
    key, title
        ``"S1"``, …; words for people.
    players
        The inputs.
    limb
        What they play on.
    reference
        Key of the exact values; scenes that differ only in what is edited share one.
    changed
        Index of the only input that changes between two runs; None: all change.
    in_quick
        Whether the short run includes it.
    exact_only
        Whether settings that trade error for time are left out, as another scene shows them.
    allowed_s, allowed_bytes
        Time and memory above idle that the program promises for it; None: nothing.
    family
        Engines of the same family can compute it.
    most_processes
        In how many fresh processes it is measured at most: what runs for seconds differs little
        from one to the next.
    """

    key: str
    title: str
    players: tuple[Player, ...]
    reference: str
    limb: ComparedLimb = MADE_UP
    changed: int | None = None
    in_quick: bool = False
    exact_only: bool = False
    allowed_s: float | None = None
    allowed_bytes: float | None = None
    family: str = "convolution"
    most_processes: int = 100

    @property
    def stimulus_samples(self) -> int:
        """Samples to the end of the last input."""
        return max(player.start + player.n_times for player in self.players)

    @property
    def response_samples(self) -> int:
        """Samples of the response."""
        return self.stimulus_samples + self.limb.n_taps - 1

    @property
    def n_inputs(self) -> int:
        """How many inputs there are."""
        return len(self.players)

    @property
    def active_inputs(self) -> int:
        """How many inputs change between two runs."""
        return len(self.players) if self.changed is None else 1


@cache
def scenes_on(limb: ComparedLimb) -> tuple[ComparedScene, ...]:
    """The scenes of convolution, as many of them as this limb has places for.

    Minutes of all places, and what they may cost, are promised for the made-up limb alone.
    """
    every, several = limb.n_inputs, min(_SEVERAL, limb.n_inputs)
    # Where all are no more than several, what all play is a scene already.
    of_all = "S3" if every > several else "S2"
    long = {"exact_only": True, "allowed_s": 10.0, "allowed_bytes": 500e6, "most_processes": 1}
    found = (
        _even("S1", limb, 1, 0.5, in_quick=True),
        _even("S2", limb, several, 2.0, in_quick=True),
        _even("S3", limb, every, 2.0) if every > several else None,
        _even("S4", limb, several, 10.0),
        _even("S5", limb, every, 600.0, **long) if limb == MADE_UP else None,
        ComparedScene(
            key="S6",
            title="loud, then 120 dB quieter",
            players=_loud_and_quiet(limb),
            reference="S6",
            in_quick=True,
            limb=limb,
        ),
        ComparedScene(
            key="S7",
            title=f"1 of {every} inputs changed, 2 s",
            players=_players(limb, every, 2.0),
            reference=of_all,
            changed=min(_CHANGED, every - 1),
            exact_only=True,
            limb=limb,
        )
        if every > 1
        else None,
    )
    return tuple(scene for scene in found if scene is not None)


def _even(
    key: str, limb: ComparedLimb, count: int, duration_s: float, **more: Any
) -> ComparedScene:
    """A scene in which all inputs play equally long."""
    return ComparedScene(
        key=key,
        title=f"{counted(count, 'input')} × {duration_s:g} s",
        players=_players(limb, count, duration_s),
        reference=key,
        limb=limb,
        **more,
    )


def _players(limb: ComparedLimb, count: int, duration_s: float) -> tuple[Player, ...]:
    """Different noise at different places, at amplitudes that no float32 holds."""
    # Without a divisor in common with their number it comes to every place once.
    step = next(k for k in itertools.count(_LEAST_STEP) if math.gcd(k, limb.n_inputs) == 1)
    return tuple(
        Player(
            location=1 + (step * k + _FIRST_PLACE) % limb.n_inputs,
            seed=100 + k,
            n_times=sample_count(duration_s, limb.sample_rate_hz),
            amplitude=(0.3 + 0.07 * k) * (-1.0) ** k,
        )
        for k in range(count)
    )


def _loud_and_quiet(limb: ComparedLimb) -> tuple[Player, ...]:
    """A loud burst, silence, and a burst 120 dB below it at the same place."""
    samples = partial(sample_count, sample_rate_hz=limb.sample_rate_hz)
    location, loud = 1 + _FIRST_PLACE % limb.n_inputs, samples(0.3)
    start = max(samples(1.0), loud + limb.n_taps - 1 + samples(_PAUSE_S))
    return (
        Player(location=location, seed=200, n_times=loud),
        Player(location=location, seed=201, n_times=samples(1.0), amplitude=1e-6, start=start),
    )


SCENES = scenes_on(MADE_UP)


def scene_of(key: str, limb: ComparedLimb = MADE_UP) -> ComparedScene:
    """Return the scene of convolution called ``key``."""
    return next(scene for scene in scenes_on(limb) if scene.key == key)
