"""From a design to the mix for a device, or to a stand-in sound for people without actuators.

For the stand-in, all frequencies are shifted up by the same number of hertz (single sideband): 25
to 600 Hz become 325 to 900 Hz with a shift of 300 Hz, which small loudspeakers play, and which ears
hear evenly.  Times, envelopes and differences of frequencies stay the same; intervals do not.
"""

from dataclasses import replace

import numpy as np
import scipy

from skinsource.actuators.rigs import Margin, Rig, RigChannel, highest_gain
from skinsource.base.arrays import Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.amplitudes import equaliser_of
from skinsource.design.design import Design
from skinsource.engine.stimulus import Stimulus, for_rig, stimulus_of, through_actuators
from skinsource.lab.playing.devices import DeviceRows, Output, outputs_by_place
from skinsource.lab.playing.mix import SHORTEST_LOOP_S, Mix, mix_of
from skinsource.limbs.catalog import load_limb
from skinsource.limbs.limb import Limb


def analytic(rows: Floats) -> Complexes:
    """Return ``rows``, (n_channels, n_times), without their negative frequencies.

    The real part is ``rows``.  Ringing beyond the ends is cut off.
    """
    n = rows.shape[1]
    # Padding, so that ringing at one end does not wrap round to the other.
    length = scipy.fft.next_fast_len(2 * n + 1)
    signals: Complexes = scipy.signal.hilbert(rows, length, axis=1)[:, :n]
    return signals


def turned_up(parts: Floats, sample_rate_hz: int, shift_hz: float) -> Floats:
    """Return signals with all frequencies ``shift_hz`` higher.

    Parameters
    ----------
    parts : (2 n_channels, n_times)
        Real parts of all analytic signals, then their imaginary parts.
    sample_rate_hz
        Their rate, high enough for the shifted frequencies.
    shift_hz
        The shift.

    Returns
    -------
    (n_channels, n_times)
    """
    n = parts.shape[0] // 2
    # Whole turns are subtracted first, so that long designs lose no accuracy.
    turns = (np.arange(parts.shape[1]) * (shift_hz / sample_rate_hz)) % 1.0
    angle = 2.0 * np.pi * turns
    shifted: Floats = parts[:n] * np.cos(angle) - parts[n:] * np.sin(angle)
    return shifted


def on_two_ears(rows: Floats) -> Floats:
    """Return left and right, (2, n_times), of channels spread from left to right in their order.

    The two shares of a channel add up to 1; a single channel is in the middle.
    """
    n = rows.shape[0]
    to_right = (np.arange(n) + 0.5) / max(n, 1)
    ears: Floats = np.stack((1.0 - to_right, to_right)) @ rows
    return ears


#: Samples of all outputs together: one gigabyte.
MOST_SAMPLES = 2**28
_EARS = {1: "left", 2: "right"}


class Mixer:
    """Makes mixes; unchanged rows and margins of the last mix are used again.

    An amplitude of 1, or 1 V, is full scale before the gain where no rig says otherwise, so that
    the level of a track does not depend on other tracks.
    """

    def __init__(self) -> None:
        self.rows = DeviceRows()
        self._limb: tuple[str, Limb] | None = None
        self._margins: dict[tuple[int, RigChannel | None, bool, bytes], Margin] = {}

    def stimulus(self, design: Design) -> Stimulus:
        """Return the channels of a design, at the rate of its limb."""
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
            Whether the whole design is repeated where it has no loop.
        least_outputs
            Outputs of the mix at least; further ones are silent.
        rig
            What the outputs are wired to: locations, volts, polarity and limits.  The equaliser of
            the design makes the volts for it; without a rig, for the actuators of the design.

        Raises
        ------
        InvalidInputError
            The design cannot be played: an input cannot be sampled, or the design is too long, or
            its loop too short.
        DatasetMissingError
            Its limb is a measured one, and no measured dataset is installed.
        """
        stimulus = self.stimulus(design)
        rate_hz = output.sample_rate_hz
        own_hz = _whole_hertz(stimulus.sample_rate_hz)
        _check_length(stimulus, rate_hz)
        if output.stand_in:
            whole = analytic(stimulus.samples)
            parts = self.rows.at(np.concatenate((whole.real, whole.imag)), own_hz, rate_hz)
            rows = on_two_ears(turned_up(parts, rate_hz, output.shift_hz))
            outputs, titles = list(_EARS), list(_EARS.values())
        else:
            sent, equaliser = stimulus, equaliser_of(design)
            if rig is not None:
                sent = for_rig(stimulus, rig, equaliser)
            elif equaliser is not None and design.actuation is not None:
                sent = through_actuators(stimulus, design.actuation, equaliser)
            rows = self.rows.at(sent.samples, own_hz, rate_hz)
            wired = outputs_by_place(design, output, rig)
            places = [channel.place for channel in stimulus.channels if channel.place is not None]
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
        """Return the highest gain of all rows; margins of unchanged rows are not computed again."""
        known, self._margins = self._margins, {}
        for place, row in zip(places, rows, strict=True):
            key = place, rig.channel_of(place), repeated, row.tobytes()
            margin = known.get(key)
            if margin is None:
                margin = highest_gain(rig, [place], row[np.newaxis], rate_hz, repeated=repeated)
            self._margins[key] = margin
        return min([Margin(), *self._margins.values()], key=lambda margin: margin.factor)


def loop_of(design: Design, duration_s: float, *, loops: bool) -> tuple[float, float] | None:
    """Return begin and end of the repeated part, s; None where nothing is repeated."""
    if design.loop_s is not None:
        return design.loop_s
    return (0.0, max(duration_s, SHORTEST_LOOP_S)) if loops else None


def _whole_hertz(rate_hz: float) -> int:
    if not float(rate_hz).is_integer():
        raise InvalidInputError(
            f"The limb is sampled at {rate_hz:g} Hz, expected a whole number of hertz to play"
        )
    return int(rate_hz)


def _check_length(stimulus: Stimulus, rate_hz: int) -> None:
    samples = len(stimulus.channels) * stimulus.duration_s * rate_hz
    if samples > MOST_SAMPLES:
        raise InvalidInputError(
            f"The design lasts {stimulus.duration_s:.4g} s on {len(stimulus.channels)} outputs, "
            f"which does not fit into memory at {rate_hz} Hz. Choose a lower rate, or mute inputs."
        )
