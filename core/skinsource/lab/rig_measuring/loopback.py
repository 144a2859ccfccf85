"""A loopback: clicks from an output into an input, through a cable, tell delay and jitter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.actuators.measuring import exponential_sweep, lag_of
from skinsource.base.arguments import checking, integer
from skinsource.base.conventions import Floats, Indices
from skinsource.base.errors import PlaybackError
from skinsource.base.job import Stop, never
from skinsource.lab.playing.devices import Output, check_outputs, device_of, devices
from skinsource.lab.playing.stream import mix_of
from skinsource.lab.rig_measuring.duplex import Card, check_inputs, input_device_of, input_devices
from skinsource.lab.rig_measuring.measurement import LONGEST_DELAY_S, recording_of

# A click is a short sweep far above hum, told from noise by its shape.
_CLICK_S, _BETWEEN_S, _AMPLITUDE = 0.01, 0.2, 0.5
_LOWEST_HZ, _HIGHEST_SHARE = 500.0, 0.35
# What is recorded after the start of the last click.
_LAST_S = LONGEST_DELAY_S + 0.1
# Clicks are so many times stronger than the noise, and than this share of full scale.
_ABOVE, _LEAST = 8.0, 1e-3
# Clicks differ by less, and one that is weaker than this share of the others was not heard.
_MOST_JITTER_S, _SEEN = 0.005, 0.5


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Loopback:
    """What a loopback measured.

    Attributes
    ----------
    round_trips_s : (n_clicks,)
        From a sample that is sent to the one that is received, s; NaN where no click was seen.
    behind_s
        How much later than the device tells sound leaves the output, s: what `Player` calls
        ``loopback_s``; it holds the delay of the input that the device does not tell.  None: the
        device tells no times.
    later_s
        How much later than the reference its clicks come back, s, (n_clicks,); None: there is no
        reference.
    """

    round_trips_s: Floats
    behind_s: float | None
    later_s: Floats | None = None

    @property
    def n_seen(self) -> int:
        """How many clicks were seen."""
        return int(np.count_nonzero(np.isfinite(self.round_trips_s)))

    @property
    def round_trip_s(self) -> float:
        """Median of the round trips, s."""
        return float(np.nanmedian(self.round_trips_s))

    @property
    def jitter_s(self) -> float:
        """Standard deviation of the round trips, s."""
        return float(np.nanstd(self.round_trips_s))


@checking
def loopback(
    output: int,
    source: int,
    device: str | Output | None = None,
    *,
    reference: tuple[int, int] | None = None,
    repeats: int = 20,
    stop: Stop = never,
) -> Loopback:
    """Play clicks on an output, record an input that it is wired to, and tell the delay.

    Parameters
    ----------
    output, source
        Output and input of the device, from 1, with a cable between them.
    device
        Name of the device, or an `Output`; None: that of the system.
    reference
        Another output and input with a cable of their own, which play and record the same clicks:
        two channels are compared without what differs from one start of the device to the next.
    repeats
        Number of clicks, five a second.
    stop
        Asked whether to give up.

    Raises
    ------
    PlaybackError
        There is no such device, output or input, or nothing was heard.

    Examples
    --------
    >>> import skinsource as ss
    >>> try:
    ...     print(ss.rig_measuring.loopback(1, 1, device="No such card").round_trip_s)
    ... except ss.SkinSourceError:
    ...     print("not here")
    not here
    """
    asked = device if isinstance(device, Output) else Output(device=device or "")
    number, rate_hz = integer("repeats", repeats, 1, 1000), asked.sample_rate_hz
    played_on = device_of(asked, devices())
    inputs = input_device_of(played_on.name, played_on, input_devices())
    cables = [(output, source), *([] if reference is None else [reference])]
    for played, recorded in cables:
        check_outputs(played_on, {0: integer("output", played, 1, 1024)})
        check_inputs(inputs, integer("source", recorded, 1, 1024))
    n_inputs = max(recorded for _, recorded in cables)
    card = Card(device=played_on, inputs=inputs, n_inputs=n_inputs, latency_s=asked.latency_s)
    click, starts, row = clicks(number, rate_hz)
    outputs = list(dict.fromkeys(played for played, _ in cables))
    mix = mix_of(
        np.tile(row, (len(outputs), 1)),
        rate_hz,
        outputs=outputs,
        titles=["clicks"] * len(outputs),
        n_outputs=max(outputs),
    )
    recording, shift_s = recording_of(mix, card, 0.0, stop, lambda _: None)
    found = []
    for played, recorded in cables:
        found.append(lags(recording[recorded - 1], click, starts, rate_hz) / rate_hz)
        if not np.isfinite(found[-1]).any():
            raise PlaybackError(
                f"Input {recorded} of {inputs.name} heard nothing of output {played}. Check the "
                "cable."
            )
    behind_s = None if shift_s is None else float(np.nanmedian(found[0])) + shift_s
    later_s = None if reference is None else found[0] - found[1]
    return Loopback(round_trips_s=found[0], behind_s=behind_s, later_s=later_s)


def clicks(number: int, rate_hz: int) -> tuple[Floats, Indices, Floats]:
    """Return the samples of a click, where clicks start, and all of them until the last is back."""
    swept_hz = (_LOWEST_HZ, _HIGHEST_SHARE * rate_hz)
    sweep = exponential_sweep(swept_hz, _CLICK_S, rate_hz)
    click = _AMPLITUDE * np.hanning(sweep.size) * sweep
    starts: Indices = round(_BETWEEN_S * rate_hz) * np.arange(1, number + 1)
    return click, starts, _row(click, starts, starts[-1] + round(_LAST_S * rate_hz))


def _row(click: Floats, starts: Indices, n_times: int) -> Floats:
    row = np.zeros(n_times)
    for start in starts:
        row[start : start + click.size] = click
    return row


def lags(recorded: Floats, click: Floats, starts: Indices, rate_hz: int) -> Floats:
    """Return how many samples after it was played each click came back, (n_clicks,).

    It may lie between two samples; NaN where the click was not heard.

    Parameters
    ----------
    recorded : (n_times,)
        What was recorded, from the first played sample on.
    click : (n_click,)
        Samples of a click.
    starts : (n_clicks,)
        Samples at which clicks were played.
    rate_hz
        Of all of them.
    """
    found = np.full(len(starts), np.nan)
    length = scipy.fft.next_fast_len(2 * recorded.size, real=True)
    sent = scipy.fft.rfft(_row(click, starts, recorded.size), length)
    came = scipy.fft.rfft(recorded, length)
    common = scipy.fft.irfft(sent.conj() * came, length)[: round(LONGEST_DELAY_S * rate_hz) + 1]
    size, energy = np.abs(common), float(click @ click)
    rough = int(size.argmax())
    heard = _AMPLITUDE * size[rough] / (energy * len(starts))
    if heard < _LEAST or size[rough] < _ABOVE * float(np.median(size)):
        return found
    most = round(_MOST_JITTER_S * rate_hz)
    padded, strengths = np.pad(click, most), np.zeros(len(starts))
    for number, begin in enumerate(starts + rough - most):
        part = np.copysign(1.0, common[rough]) * recorded[begin : begin + padded.size]
        lag = lag_of(padded, part, most)
        found[number], strengths[number] = rough + lag, padded @ np.roll(part, -round(lag))
    found[strengths < _SEEN * np.median(strengths)] = np.nan
    return found
