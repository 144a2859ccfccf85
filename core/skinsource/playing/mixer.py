"""From a design to what a device gets."""

from dataclasses import replace

import numpy as np

from skinsource.arrays import Floats
from skinsource.catalogue import load_limb
from skinsource.design import Design
from skinsource.equalising import Equaliser
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb
from skinsource.playing.device_rows import DeviceRows
from skinsource.playing.mix import SHORTEST_LOOP_S, Mix, mix_of
from skinsource.playing.output import Output
from skinsource.playing.output_of_place import outputs_by_place
from skinsource.playing.stand_in import analytic, on_two_ears, turned_up
from skinsource.rigs import Margin, Rig, RigChannel, highest_gain
from skinsource.stimulus import Stimulus, stimulus_of
from skinsource.stimulus.wiring import for_rig

#: Samples of all outputs together: one gigabyte.
MOST_SAMPLES = 2**28
_EARS = {1: "left", 2: "right"}


class Mixer:
    """Makes mixes; what has not changed since the last one is not computed again.

    An amplitude of 1 is full scale, before the gain: what is heard of one track does not change
    because another becomes louder.
    """

    def __init__(self) -> None:
        self.rows = DeviceRows()
        self._limb: tuple[str, Limb] | None = None
        self._margins: dict[tuple[int, RigChannel | None, bool, bytes], Margin] = {}

    def stimulus(self, design: Design) -> Stimulus:
        """Channels of a design, at the rate of its limb."""
        if self._limb is None or self._limb[0] != design.limb:
            self._limb = design.limb, load_limb(design.limb)
        return stimulus_of(design, limb=self._limb[1])

    def mix(
        self,
        design: Design,
        output: Output,
        *,
        loops: bool = False,
        least_outputs: int = 1,
        rig: Rig | None = None,
    ) -> Mix:
        """Return what ``output`` plays of ``design``, from time 0 on.

        Parameters
        ----------
        loops
            Whether all of it is played again and again, where the design has no loop.
        least_outputs
            The mix has silent outputs up to so many.
        rig
            What its outputs are wired to: it says which place has which, how many volts, which way
            round, and how far it may be turned up.  Drives are equalised for it as the design is
            predicted.

        Raises
        ------
        InvalidInputError
            The design cannot be played: what its inputs play cannot be computed, it is too long,
            or its loop too short.
        DatasetMissingError
            Its limb is a measured one, and no measured dataset is installed.
        """
        stimulus = self.stimulus(design)
        rate_hz = output.sample_rate_hz
        own_hz = _whole(stimulus.sample_rate_hz)
        _refuse_too_long(stimulus, rate_hz)
        if output.stand_in:
            whole = analytic(stimulus.samples)
            parts = self.rows.at(np.concatenate((whole.real, whole.imag)), own_hz, rate_hz)
            rows = on_two_ears(turned_up(parts, rate_hz, output.shift_hz))
            outputs, titles = list(_EARS), list(_EARS.values())
        else:
            sent = stimulus if rig is None else for_rig(stimulus, rig, _equaliser_of(design))
            rows = self.rows.at(sent.samples, own_hz, rate_hz)
            wired = outputs_by_place(design, output, rig)
            places = [one.place for one in stimulus.channels if one.place is not None]
            outputs = [wired[place] for place in places]
            titles = [f"place {place}" for place in places]
        loop_s = loop_of(design, stimulus.duration_s, loops=loops)
        mix = mix_of(
            rows,
            rate_hz,
            outputs=outputs,
            titles=titles,
            n_outputs=max([1, least_outputs, *outputs]),
            loop_s=loop_s,
        )
        if rig is None or output.stand_in:
            return mix
        margin = self._margin(rig, places, sent.samples, own_hz, repeated=loop_s is not None)
        return replace(mix, most_gain=margin.factor, limit=margin.words)

    def _margin(
        self, rig: Rig, places: list[int], rows: Floats, rate_hz: int, *, repeated: bool
    ) -> Margin:
        """How far all may be turned up; what has not changed since the last time is known."""
        known, self._margins = self._margins, {}
        found = Margin()
        for place, row in zip(places, rows, strict=True):
            key = place, rig.channel_of(place), repeated, row.tobytes()
            one = known.get(key)
            if one is None:
                one = highest_gain(rig, [place], row[np.newaxis], rate_hz, repeated=repeated)
            self._margins[key] = one
            found = min(found, one, key=lambda margin: margin.factor)
        return found


def _equaliser_of(design: Design) -> Equaliser | None:
    return None if design.actuated is None else design.actuated.equaliser


def loop_of(design: Design, duration_s: float, *, loops: bool) -> tuple[float, float] | None:
    """Begin and end of what is played again and again, s; None: nothing is."""
    if design.loop_s is not None:
        return design.loop_s
    return (0.0, max(duration_s, SHORTEST_LOOP_S)) if loops else None


def _whole(rate_hz: float) -> int:
    if not float(rate_hz).is_integer():
        raise InvalidInputError(
            f"The limb is sampled at {rate_hz:g} Hz, expected a whole number of hertz to play"
        )
    return int(rate_hz)


def _refuse_too_long(stimulus: Stimulus, rate_hz: int) -> None:
    samples = len(stimulus.channels) * stimulus.duration_s * rate_hz
    if samples > MOST_SAMPLES:
        raise InvalidInputError(
            f"The design lasts {stimulus.duration_s:.4g} s on {len(stimulus.channels)} outputs, "
            f"which is too much to be held at {rate_hz} Hz. Choose a lower rate, or mute inputs."
        )
