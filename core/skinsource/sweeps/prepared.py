"""What a stimulus plays, before anything moves."""

from dataclasses import dataclass

from skinsource.chain import Actuation, refuse_unfollowed
from skinsource.design import Design, Input, audible_indices
from skinsource.job import Stop, stop_if
from skinsource.limb import Band, Limb
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
    stimulus_samples
        Samples from time 0 to the end of the last drive; 1 where nothing is heard.
    """

    design: Design
    limb: Limb
    placed: tuple[Placed, ...]
    n_taps: int
    stimulus_samples: int

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


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """What an input plays at a rate, and through which actuators it was found to be possible."""

    input: Input
    rate_hz: float
    band_hz: Band | None
    actuation: Actuation | None
    placed: Placed

    def holds_for(
        self, one: Input, rate_hz: float, band_hz: Band | None, actuation: Actuation | None
    ) -> bool:
        """Whether it is what ``one`` plays."""
        followed = self.rate_hz, self.band_hz, self.actuation
        return self.input is one and followed == (rate_hz, band_hz, actuation)


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
        # Of the latest design, by id: neighbours share the inputs that do not vary.
        self._known: dict[int, _Known] = {}

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
        rate_hz, band_hz, n_taps = limb.sample_rate_hz, limb.band_hz, limb.n_taps
        limb = self._latest = self._shared.driven_limb(limb, design.actuated, design.scaling)
        known = {}
        for index in audible_indices(design.inputs):
            one = design.inputs[index]
            before = self._known.get(one.id)
            if before is None or not before.holds_for(one, rate_hz, band_hz, design.actuated):
                stop_if(stop)
                placed = self._placed(one, rate_hz, band_hz, design.actuated)
                before = _Known(one, rate_hz, band_hz, design.actuated, placed)
            known[one.id] = before
        self._known = known
        found = tuple(one.placed for one in known.values())
        end = max([1, *(one.end for one in found)])
        return Prepared(design, limb, found, n_taps, end)

    def _placed(
        self, one: Input, rate_hz: float, band_hz: Band | None, actuation: Actuation | None
    ) -> Placed:
        """An input that is heard, with what it plays."""
        (voice,) = voices(self._remembered, (one,), rate_hz)
        drive = self._remembered.drives.drawn(voice.unit, rate_hz)
        refuse_unfollowed(actuation, drive, rate_hz, band_hz, voice.location)
        return Placed(voice, drive, voice.start)

    def responses(self, one: Prepared, n_fft: int | None) -> Responses:
        """Responses of its limb at the length ``n_fft``."""
        return Responses(self._remembered, one.limb, one.design.scaling, n_fft)
