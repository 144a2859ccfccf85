"""What every motion can do."""

from typing import ClassVar, Protocol, runtime_checkable

from skinsource.design import Input
from skinsource.waveforms import Waveform


@runtime_checkable
class Motion(Protocol):
    """A frozen dataclass that writes tracks.

    Attributes
    ----------
    title
        What a user calls it.
    law
        The rule by which times and amplitudes follow, in a line.
    source
        Where the rule comes from.
    limits
        What is known, and what is not, of it on the palm.
    """

    title: ClassVar[str]
    law: ClassVar[str]
    source: ClassVar[str]
    limits: ClassVar[str]

    @property
    def path(self) -> tuple[int, ...]:
        """Input places, in the order in which they are passed."""

    @property
    def waveform(self) -> Waveform:
        """What plays at the places."""

    @property
    def summary(self) -> str:
        """Its times in words."""

    def tracks(self) -> tuple[Input, ...]:
        """Return its tracks, one for each place, in the order of the path.

        Raises
        ------
        InvalidInputError
            A clip would start later than one may.
        """
