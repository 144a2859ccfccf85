"""Calibrating a person: how one place of the skin answers to each actuator of a rig.

Each actuator sweeps twice, at the same velocity throughout.  What the sensor records is divided by
the acceleration of the contact, which follows from the measured response of the channel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

import numpy as np
import scipy

from skinsource.actuators.equalising import target
from skinsource.actuators.measuring import exponential_sweep, lag_of
from skinsource.actuators.rigs import (
    Rig,
    RigChannel,
    full_scale_volts,
    highest_gain,
    wired_channel,
)
from skinsource.base.arguments import checking
from skinsource.base.conventions import Band, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.inverse.designing import DRIVEN_HZ
from skinsource.inverse.responses import bins_of, n_fft_of
from skinsource.lab.calibrating.station import Station
from skinsource.lab.playing.stream import mix_of
from skinsource.lab.rig_measuring.measurement import CLIPPED, NOISE_S, SETTLING_S
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import pulse_spectrum
from skinsource.people.partial_limb import PartialLimb
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import TextSpec

PERSON = TextSpec(label="Person", longest=100, one_line=True, hint="A code, no name")
CONTACT = TextSpec(label="Actuators", longest=400, hint="Contact area, adhesive, preload")
MOUNTING = TextSpec(label="Sensor fixed by", longest=400, hint="Adhesive, and where its cable is")
POSTURE = TextSpec(label="Posture", longest=400, hint="How hand and arm lie")
SENSOR = TextSpec(label="Sensor", longest=400, hint="Type and mass, at most 0.5 g")
SPEED = NumberSpec(
    label="Contact velocity", unit="m/s", minimum=5e-3, maximum=10e-3, hint="Peak of the sweeps"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sitting(fields.CheckedModel):
    """A person at a station, and what is to be measured.

    Attributes
    ----------
    person
        Code of the person.
    like
        Name of the published or synthetic limb whose places, axes, sample rate, drive and delay
        the result has.
    output
        Where the sensor lies, from 1.
    inputs
        Places with an actuator; empty: all channels of the rig.
    contact
        How the actuators are attached: area, adhesive, preload.
    mounting, posture, sensor
        As of `skinsource.people.PartialLimb`.
    speed_m_per_s
        Velocity of the contact: its peak, at all frequencies.
    band_hz
        Band of the designs that are wanted.
    """

    person: str = fields.text("", PERSON)
    like: str = "measured-1"
    output: int = 1
    inputs: tuple[int, ...] = ()
    contact: str = fields.text("", CONTACT)
    mounting: str = fields.text("", MOUNTING)
    posture: str = fields.text("", POSTURE)
    sensor: str = fields.text("", SENSOR)
    speed_m_per_s: float = fields.number(7e-3, SPEED)
    band_hz: Band = DRIVEN_HZ


#: Frequencies between which actuators sweep, and how long.
SWEPT_HZ: Band = (20.0, 650.0)
SWEEP_S, REST_S = 2.4, 0.6
# Between them responses are whole; at the ends of the sweep they are 0.
_WHOLE_HZ: Band = (25.0, 600.0)
_PERIOD_S, _RINGS_S = SWEEP_S + REST_S, 0.15
#: Silence before and after what is played.
BEFORE_S, AFTER_S = SETTLING_S, 0.5
_TAKE_S = BEFORE_S + 2 * _PERIOD_S + AFTER_S
#: What is accepted.
LEAST_COHERENCE, LEAST_SHARE = 0.9, 0.8
MOST_DB, MOST_DEG, MOST_APART_S = 1.0, 10.0, 1e-4
#: Rules by which inputs are left out, as reports state them.
RULES = (
    "no recorded sample reaches full scale",
    f"the coherence of the two sweeps is {LEAST_COHERENCE:g} or more over "
    f"{100 * LEAST_SHARE:g} % of the band",
    f"the two sweeps are within {1e3 * MOST_APART_S:g} ms",
    f"the first accepted input, measured again at the end, is within {MOST_DB:g} dB, "
    f"{MOST_DEG:g}° and {1e3 * MOST_APART_S:g} ms",
)
# Half of the bins over which a coherence is averaged.
_AROUND = 8
# The first sample of so much of the peak is where a response begins.
_BEGINS = 0.1
_MOST_LAG = 13
_LEAST_POWER = 1e-300


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Measured:
    """What one input did at the sensor.

    Attributes
    ----------
    place
        Of the actuator, from 1.
    response : (n_taps,)
        To the measuring pulse, as those of the limb ``like``; mean of the two sweeps.
    coherent
        Share of the band in which the two sweeps agree.
    delay_s
        How much later the second one is recorded than it should be.
    peak
        Largest recorded sample, in parts of full scale.
    failures
        Sentences; none: it is accepted.
    """

    place: int
    response: Floats
    coherent: float
    delay_s: float
    peak: float
    failures: tuple[str, ...]

    def __repr__(self) -> str:
        return f"<Measured place {self.place}: {' '.join(self.failures) or 'accepted'}>"


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Calibration:
    """All inputs of a sitting.

    Attributes
    ----------
    sitting
        The person, and where the sensor was.
    rows
        Of each input the last measurement.
    latency_s
        Time from a sample to the skin, which is taken out of all responses: after it the strongest
        one begins.
    noise_m_per_s2
        RMS of the sensor in silence.
    moved
        How the first accepted input had changed at the end; "": it had not.
    measured_on
        Date.
    rig
        What was played on.
    """

    sitting: Sitting
    rows: tuple[Measured, ...]
    latency_s: float
    noise_m_per_s2: float
    moved: str
    measured_on: str
    rig: Rig

    def __repr__(self) -> str:
        n = len(self.rows) - len(self.failures)
        return f"<Calibration of {self.sitting.person}: {n} of {len(self.rows)} inputs accepted>"

    @property
    def failures(self) -> dict[int, tuple[str, ...]]:
        """Sentences on each input that is not accepted, by place."""
        return {row.place: row.failures for row in self.rows if row.failures}

    @property
    def accepted(self) -> bool:
        """Whether all inputs are accepted, and nothing had moved."""
        return not self.failures and not self.moved

    @property
    def partial(self) -> PartialLimb:
        """The person at this place, from the accepted inputs; along other axes than z it is 0.

        Raises
        ------
        InvalidInputError
            No input is accepted, or something has moved.
        """
        rows = [row for row in self.rows if not row.failures]
        if self.moved or not rows:
            raise InvalidInputError(self.moved or "No input was accepted. Measure them again.")
        sitting, whole = self.sitting, limb_of(self.sitting.like)
        responses = np.zeros((len(rows), 1, whole.n_axes, whole.n_taps))
        responses[:, 0, whole.axes.index("z")] = [row.response for row in rows]
        return PartialLimb(
            person=sitting.person,
            like=sitting.like,
            inputs=tuple(row.place for row in rows),
            outputs=(sitting.output,),
            responses=responses,
            mounting="; ".join(filter(None, (sitting.contact, sitting.mounting))),
            posture=sitting.posture,
            sensor=sitting.sensor,
            dates=(self.measured_on,),
        )


@checking
def calibrate(
    sitting: Sitting,
    station: Station,
    *,
    before: Calibration | None = None,
    heard: Callable[[Measured], None] = lambda measured: None,
    progress: Progress = silent,
    stop: Stop = never,
) -> Calibration:
    """Measure how a place of the skin answers to each actuator.

    A silence comes first, then two sweeps of each input, and at the end the first accepted input
    once more.

    Parameters
    ----------
    sitting
        The person, and what is to be measured.
    station
        Where it is played and recorded.
    before
        What was measured just before: only inputs that failed are measured again, or all where
        something had moved.
    heard
        Called after each input.
    progress, stop
        ``progress`` is called while samples are recorded; once ``stop`` returns True, all is silent
        and `Stopped` is raised.

    Raises
    ------
    InvalidInputError
        A place is not wired, its channel has no volts at full scale or no measured response, or a
        limit of the rig would be passed; nothing was played then.
    PlaybackError
        The device refuses, loses samples, or stops answering.
    Stopped
        ``stop`` returned True.

    Examples
    --------
    >>> from skinsource.lab.calibrating import Sitting, StandIn, calibrate
    >>> station = StandIn(inputs=(7, 12))
    >>> found = calibrate(Sitting(person="p07", like=station.like, output=9), station)
    >>> found, found.partial
    (<Calibration of p07: 2 of 2 inputs accepted>, <PartialLimb of p07: outputs 9>)
    """
    kept = () if before is None or before.moved else before.rows
    known = {row.place: row for row in kept if not row.failures}
    latency_s = before.latency_s if known and before is not None else None
    places = sitting.inputs or tuple(channel.place for channel in station.rig.channels)
    sweeps = {place: _Sweep.of(sitting, station, place) for place in places}
    ahead = [place for place in places if place not in known]
    total = samples_in(NOISE_S, station) + (len(ahead) + 1) * samples_in(_TAKE_S, station)
    done = 0

    def record(place: int, samples: Floats, text: str) -> Floats:
        nonlocal done
        began, number = done, sweeps[place].channel.output
        done += samples.size
        mix = mix_of(
            samples[None],
            station.sample_rate_hz,
            outputs=[number],
            titles=[text],
            n_outputs=number,
        )
        recorded = station.record(mix, stop, lambda n: progress(began + n, total, text))
        return recorded * station.setup.m_per_s2_at_full_scale

    noise = record(places[0], np.zeros(samples_in(NOISE_S, station)), "Silence")
    for place in ahead:
        recorded = record(place, sweeps[place].samples, f"Place {place}")
        measured, begins_s = sweeps[place].measured(recorded, latency_s)
        if not measured.failures:
            latency_s = begins_s
        known[place] = measured
        heard(measured)
    # What was accepted before says whether all is still as it was then.
    moved, accepted = "", [row for row in known.values() if not row.failures]
    if accepted:
        first = accepted[0]
        sweep = sweeps[first.place]
        recorded = record(first.place, sweep.samples, f"Place {first.place} again")
        moved = _change(sitting, first, sweep.measured(recorded, latency_s)[0])
    return Calibration(
        sitting=sitting,
        rows=tuple(known[place] for place in places),
        latency_s=latency_s or 0.0,
        noise_m_per_s2=float(noise.std()),
        moved=moved,
        measured_on=datetime.now(UTC).date().isoformat(),
        rig=station.rig,
    )


def samples_in(seconds: float, station: Station) -> int:
    """Return how many samples of a station last so long."""
    return round(seconds * station.sample_rate_hz)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Sweep:
    """What an input plays, and what its contact does then.

    Attributes
    ----------
    samples : (n_times,)
        Two sweeps, silence before and after.
    moves : (n_bins,)
        Spectrum of the contact's acceleration during one sweep, m/s², in steps of 1/3 Hz.
    """

    sitting: Sitting
    station: Station
    channel: RigChannel
    samples: Floats
    moves: Complexes

    @staticmethod
    def of(sitting: Sitting, station: Station, place: int) -> _Sweep:
        """Return the sweep of an input; raise where its channel does not allow it."""
        rig, rate_hz = station.rig, station.sample_rate_hz
        channel = wired_channel(rig, place)
        volts = full_scale_volts(channel)
        if channel.measured is None:
            raise InvalidInputError(
                f"Place {place} has no measured response, so its motion is not known. Measure its "
                "channel, or leave it out."
            )
        sweep = np.zeros(samples_in(_PERIOD_S, station))
        chirp = exponential_sweep(SWEPT_HZ, SWEEP_S, rate_hz)
        # What the inverse rings before the sweep has room in its period.
        begin = samples_in(_RINGS_S, station)
        sweep[begin : begin + chirp.size] = sitting.speed_m_per_s * chirp
        hz = np.arange(sweep.size // 2 + 1) / _PERIOD_S
        moves = 2j * np.pi * hz * scipy.fft.rfft(sweep) * target(hz, SWEPT_HZ)
        driven = np.zeros_like(moves)
        # The target is 0 at 0 Hz, where nothing moves.
        driven[1:] = moves[1:] / (volts * channel.measured.response(hz[1:]))
        samples = np.zeros(samples_in(_TAKE_S, station))
        first = samples_in(BEFORE_S, station)
        samples[first : first + 2 * sweep.size] = np.tile(scipy.fft.irfft(driven, sweep.size), 2)
        margin = highest_gain(rig, [place], samples[None], rate_hz)
        peak = float(np.abs(samples).max())
        if margin.factor < 1.0 or peak > 1.0:
            passed = margin.words or f"place {place}: full scale"
            raise InvalidInputError(
                f"At {1e3 * sitting.speed_m_per_s:g} mm/s the sweep would pass a limit of the rig "
                f"({passed}). Choose a lower velocity, or leave the place out."
            )
        late = np.exp(-2j * np.pi * hz * channel.delay_s)
        return _Sweep(
            sitting=sitting, station=station, channel=channel, samples=samples, moves=moves * late
        )

    def measured(self, recorded: Floats, latency_s: float | None) -> tuple[Measured, float]:
        """Return what the input did, and when its response begins unless a latency is known."""
        sitting, station = self.sitting, self.station
        whole = limb_of(sitting.like)
        n = samples_in(_PERIOD_S, station)
        parts = recorded[samples_in(BEFORE_S, station) :][: 2 * n].reshape(2, n)
        # Bins of one period at the limb's sample rate, of which only those swept are not 0.
        n_taps = round(_PERIOD_S * whole.sample_rate_hz)
        swept = slice(*(round(hz * _PERIOD_S) for hz in SWEPT_HZ))
        hz = np.arange(swept.start, swept.stop) / _PERIOD_S
        shape = np.interp(hz, [SWEPT_HZ[0], *_WHOLE_HZ, SWEPT_HZ[1]], [0.0, 1.0, 1.0, 0.0])
        pulse = np.sin(0.5 * np.pi * shape) ** 2 * pulse_spectrum(hz, whole.sample_rate_hz)
        answers = np.zeros((2, n_taps // 2 + 1), complex)
        answers[:, swept] = scipy.fft.rfft(parts)[:, swept] * pulse / self.moves[swept]
        if latency_s is None:
            latency_s = _begins(scipy.fft.irfft(answers.mean(axis=0), n_taps), whole)
        later_s = whole.pre_trigger_delay_s - latency_s
        answers[:, swept] *= np.exp(-2j * np.pi * hz * later_s)
        both = scipy.fft.irfft(answers, n_taps)[:, : whole.n_taps]
        coherent = _coherent_share(both, whole, sitting.band_hz)
        delay_s = lag_of(both[0], both[1], _MOST_LAG) / whole.sample_rate_hz
        peak = float(np.abs(recorded).max() / station.setup.m_per_s2_at_full_scale)
        failures = []
        if peak >= CLIPPED:
            failures.append("The input of the sensor clips. Turn its gain down.")
        if coherent < LEAST_SHARE:
            failures.append(
                f"The sweeps agree over {100 * coherent:.0f} % of the band, expected "
                f"{100 * LEAST_SHARE:g} %. Check the actuator and its contact."
            )
        elif abs(delay_s) > MOST_APART_S:
            failures.append(
                f"The sweeps are {1e3 * abs(delay_s):.2f} ms apart, expected at most "
                f"{1e3 * MOST_APART_S:g} ms. Close other programs."
            )
        measured = Measured(
            place=self.channel.place,
            response=both.mean(axis=0),
            coherent=coherent,
            delay_s=delay_s,
            peak=peak,
            failures=tuple(failures),
        )
        return measured, latency_s


def _begins(response: Floats, limb: Limb) -> float:
    """Return the time at which a response begins, s: before its peak, by at most the delay."""
    peak = int(np.abs(response).argmax())
    first = max(peak - round(limb.pre_trigger_delay_s * limb.sample_rate_hz), 0)
    loud = np.abs(response[first : peak + 1]) >= _BEGINS * abs(response[peak])
    return float(first + loud.argmax()) / limb.sample_rate_hz


def _in_band(rows: Sequence[Floats] | Floats, limb: Limb, band_hz: Band) -> Complexes:
    """Return the spectra of responses within a band, (n_rows, n_bins)."""
    n_fft = n_fft_of(limb.n_taps)
    hz = bins_of(n_fft, limb.sample_rate_hz)
    return scipy.fft.rfft(np.array(rows), n_fft)[:, (hz >= band_hz[0]) & (hz <= band_hz[1])]


def _coherent_share(both: Floats, limb: Limb, band_hz: Band) -> float:
    """Return the share of a band over which two responses are coherent."""
    one, other = _in_band(both, limb, band_hz)

    def around(values: Complexes | Floats) -> Any:
        return scipy.ndimage.uniform_filter1d(values, 2 * _AROUND + 1)

    power = around(np.square(np.abs(one))) * around(np.square(np.abs(other)))
    coherence = np.abs(around(one.conj() * other)) / np.sqrt(np.maximum(power, _LEAST_POWER))
    return float(np.mean(coherence >= LEAST_COHERENCE))


def _change(sitting: Sitting, first: Measured, again: Measured) -> str:
    """Return how an input has changed; "": by no more than is accepted."""
    whole = limb_of(sitting.like)
    one, other = _in_band([first.response, again.response], whole, sitting.band_hz)
    factor = np.vdot(one, other) / np.vdot(one, one)
    gain_db, degrees = 20.0 * np.log10(np.abs(factor)), np.degrees(np.angle(factor))
    delay_s = lag_of(first.response, again.response, _MOST_LAG) / whole.sample_rate_hz
    if abs(gain_db) <= MOST_DB and abs(degrees) <= MOST_DEG and abs(delay_s) <= MOST_APART_S:
        return ""
    return (
        f"Place {first.place} had changed by {gain_db:.1f} dB, {degrees:.0f}° and "
        f"{1e3 * delay_s:.2f} ms at the end: the sensor or the actuator has moved. Press both on, "
        "and measure all inputs again."
    )
