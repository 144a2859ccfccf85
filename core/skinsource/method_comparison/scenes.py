"""The scenes on which engines are measured."""

from dataclasses import dataclass

from skinsource.limb import N_TAPS
from skinsource.signals import sample_count

#: Outputs that a window would show, and axes at which errors are measured.
VISIBLE_OUTPUTS = (29, 30, 33, 35, 38, 52)
CHECKED_AXES = (0, 2)


@dataclass(frozen=True, slots=True, kw_only=True)
class Player:
    """One input of a scene: made-up noise at a place.

    Attributes
    ----------
    location, amplitude
        Input place, 1 to 20, and factor.
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
    reference
        Key of the stored reference; scenes that differ only in what is edited share one.
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
        return self.stimulus_samples + N_TAPS - 1

    @property
    def n_inputs(self) -> int:
        """How many inputs there are."""
        return len(self.players)

    @property
    def active_inputs(self) -> int:
        """How many inputs change between two runs."""
        return len(self.players) if self.changed is None else 1


def _players(count: int, duration_s: float) -> tuple[Player, ...]:
    """Different noise at different places, at amplitudes that no float32 holds."""
    return tuple(
        Player(
            location=1 + (7 * k + 6) % 20,
            seed=100 + k,
            n_times=sample_count(duration_s),
            amplitude=(0.3 + 0.07 * k) * (-1.0) ** k,
        )
        for k in range(count)
    )


#: A loud burst, silence, and a burst 120 dB below it at the same place.
_LOUD_AND_QUIET = (
    Player(location=7, seed=200, n_times=sample_count(0.3)),
    Player(location=7, seed=201, n_times=sample_count(1.0), amplitude=1e-6, start=1300),
)

SCENES = (
    ComparedScene(
        key="S1",
        title="1 input × 0.5 s",
        players=_players(1, 0.5),
        reference="S1",
        in_quick=True,
    ),
    ComparedScene(
        key="S2",
        title="4 inputs × 2 s",
        players=_players(4, 2.0),
        reference="S2",
        in_quick=True,
    ),
    ComparedScene(key="S3", title="20 inputs × 2 s", players=_players(20, 2.0), reference="S3"),
    ComparedScene(key="S4", title="4 inputs × 10 s", players=_players(4, 10.0), reference="S4"),
    ComparedScene(
        key="S5",
        title="20 inputs × 600 s",
        players=_players(20, 600.0),
        reference="S5",
        exact_only=True,
        allowed_s=10.0,
        allowed_bytes=500e6,
        most_processes=1,
    ),
    ComparedScene(
        key="S6",
        title="loud, then 120 dB quieter",
        players=_LOUD_AND_QUIET,
        reference="S6",
        in_quick=True,
    ),
    ComparedScene(
        key="S7",
        title="1 of 20 inputs changed, 2 s",
        players=_players(20, 2.0),
        reference="S3",
        changed=4,
        exact_only=True,
    ),
)


def scene_of(key: str) -> ComparedScene:
    """Return the scene of convolution called ``key``."""
    return next(scene for scene in SCENES if scene.key == key)
