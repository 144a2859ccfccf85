"""What a stimulus plays, before anything moves."""

from dataclasses import dataclass

from skinsource.chain import refuse_unfollowed
from skinsource.design import Design
from skinsource.job import Stop, stop_if
from skinsource.limb import Limb
from skinsource.quantities import voices
from skinsource.rendering.placed import Placed
from skinsource.rendering.remembered import Remembered
from skinsource.rendering.responses import Responses
from skinsource.rendering.segments import length_at_once
from skinsource.shared import Shared


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A stimulus with its limb and its drives.

    Attributes
    ----------
    design
        Of which it is.
    limb
        What it moves.
    placed
        Inputs that are heard, with what they play, in their order.
    n_taps
        Samples of a response of the limb itself, without what actuators ring.
    """

    design: Design
    limb: Limb
    placed: tuple[Placed, ...]
    n_taps: int

    @property
    def stimulus_samples(self) -> int:
        """Samples from time 0 to the end of the last drive; 1 where nothing is heard."""
        return max([1, *(one.end for one in self.placed)])

    @property
    def response_samples(self) -> int:
        """Samples of the response: the stimulus and one response more."""
        return self.stimulus_samples + self.limb.n_taps - 1

    @property
    def record_samples(self) -> int:
        """Samples that levels are over: the stimulus and one response of the limb itself."""
        return self.stimulus_samples + self.n_taps - 1

    @property
    def moving(self) -> tuple[Placed, ...]:
        """Inputs that move the skin at all."""
        return tuple(one for one in self.placed if one.moves)

    def n_fft(self, response_samples: int | None = None) -> int | None:
        """Length of transforms of its response, or of a longer one; None: too long at once."""
        places = {one.voice.location for one in self.placed}
        return length_at_once(
            response_samples or self.response_samples,
            len(places),
            self.limb.n_outputs * self.limb.n_axes,
        )


class Preparing:
    """Prepares stimuli; remembers what they have in common.

    Parameters
    ----------
    shared
        Limbs, and what rendering remembers.
    """

    def __init__(self, shared: Shared) -> None:
        self._shared = shared
        # Nobody else keeps the responses that were read of it.
        self._latest: Limb | None = None

    @property
    def _remembered(self) -> Remembered:
        return self._shared.remembered()

    def of(self, design: Design, stop: Stop) -> Prepared:
        """Draw what the inputs of ``design`` play.

        Raises
        ------
        InvalidInputError
            A sample is no usable number, or a waveform does not fit the limb's rate.
        DatasetMissingError
            The limb is a measured one, and the dataset is not installed.
        """
        limb = self._shared.limb_of(design.limb, design.limb_digest)
        rate_hz, n_taps = limb.sample_rate_hz, limb.n_taps
        limb = self._latest = self._shared.driven_limb(limb, design.actuated, design.scaling)
        found = []
        for one in voices(self._remembered, design.inputs, rate_hz):
            if one.heard:
                stop_if(stop)
                drive = self._remembered.drives.drawn(one.unit, rate_hz)
                refuse_unfollowed(design.actuated, drive, rate_hz, one.location)
                found.append(Placed(one, drive, one.start))
        return Prepared(design, limb, tuple(found), n_taps)

    def responses(self, one: Prepared, n_fft: int | None) -> Responses:
        """Responses of its limb at the length ``n_fft``."""
        return Responses(self._remembered, one.limb, one.design.scaling, n_fft)
