"""What every effect can do."""

from typing import ClassVar, Protocol, runtime_checkable

from skinsource.arrays import Floats
from skinsource.fields import SwitchSpec

#: Specification of the field `on`.
ON = SwitchSpec(label="On", hint="An effect that is off changes nothing")


@runtime_checkable
class Effect(Protocol):
    """A frozen dataclass that changes samples.

    Sample k of what it takes and of what it gives lies at the own time ``k / rate - shift_s``,
    with a ``shift_s`` of 0 to less than a sample: a clip that does not start on a sample is drawn
    at its own instants.  What plays is 0 before own time 0, and from its duration on.

    Attributes
    ----------
    title
        What a user calls it.
    """

    title: ClassVar[str]

    @property
    def on(self) -> bool:
        """Whether it takes part."""

    def length(self, duration_s: float) -> float:
        """How long it plays what plays ``duration_s``; 0 or more."""

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes, so that what it gives has the shift ``shift_s``.

        They differ where own time 0 is not kept: what begins at 10.3 samples of something is, on
        whole samples of its own, something drawn 0.7 samples later.

        Parameters
        ----------
        duration_s
            How long plays what it takes.
        """

    def applied(
        self,
        samples: Floats,
        sample_rate_hz: float,
        shift_s: float = 0.0,
        duration_s: float | None = None,
    ) -> Floats:
        """Return the changed samples, (n_after,); ``samples`` stay as they are.

        Parameters
        ----------
        samples : (n_times,)
            What it is applied to, drawn at ``shift_before(shift_s, …)``.
        shift_s
            Shift of what is returned.
        duration_s
            How long plays what it is applied to; None: as long as there are samples.
        """


class KeepsTime:
    """What effects share that neither move nor stretch time."""

    __slots__ = ()

    def length(self, duration_s: float) -> float:
        """How long it plays what plays ``duration_s``: as long."""
        return duration_s

    def shift_before(self, shift_s: float, duration_s: float, sample_rate_hz: float) -> float:
        """Shift of the samples that it takes: the same."""
        del duration_s, sample_rate_hz
        return shift_s


def own_duration_s(
    samples: Floats, sample_rate_hz: float, shift_s: float, duration_s: float | None
) -> float:
    """Return ``duration_s``; where there is none, that of the samples."""
    if duration_s is not None:
        return duration_s
    return max(samples.size - (shift_s > 0.0), 0) / sample_rate_hz
