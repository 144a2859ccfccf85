"""Verifying a calibrated person: a focus is played, and the sensor tells whether it is there.

Beside it two controls are played, as strong at the target: the best single input, and time
reversal.  The sensor goes to the target, and then to two places that should be quiet.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, nan
from typing import Literal

import numpy as np
import scipy

from skinsource.actuators.equalising import RegularisedInverse, target
from skinsource.actuators.measuring import lag_of
from skinsource.actuators.rigs import wired_channel
from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design, View
from skinsource.design.signal_path import actuation_of_rig
from skinsource.design.waveform import Waveform
from skinsource.engine.prediction import predict
from skinsource.engine.stimulus import stimulus_of
from skinsource.inverse.designing import Focus
from skinsource.inverse.focusing import time_reversal
from skinsource.lab.calibrating.calibration import AFTER_S, BEFORE_S, Calibration, samples_in
from skinsource.lab.calibrating.station import Station
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Mixer
from skinsource.limbs.limb import Limb
from skinsource.limbs.locations import output_name
from skinsource.people.others import hand_outputs, people_of
from skinsource.people.partial_file import digest_of
from skinsource.people.partial_limb import PartialLimb
from skinsource.people.ranges import Range, levels
from skinsource.signals.loudest_window import loudest_energy, window_samples

Played = Literal["focus", "best single", "time reversal"]
State = Literal["not verified", "verified", "differs"]
#: Levels are RMS along z over the loudest 100 ms.
_LEVEL = View(axes="z", span="loudest")
#: By how much the level at the target may differ from the predicted one.
MOST_OFF_DB = 3.0
_MOST_LAG = 13


@dataclass(frozen=True, slots=True, kw_only=True)
class Check:
    """What the sensor measured at one place.

    Attributes
    ----------
    output
        Where it lay.
    played
        What was played.
    measured_db, predicted_db
        RMS along z over the loudest 100 ms, dB re 1 m/s²; at quiet places the mean of other people
        is predicted.
    low_db, high_db
        Range between people at quiet places, NaN at the target.
    nmse_db
        Energy of the difference from the predicted signal, whose delay is taken out, over that of
        the signal; NaN at quiet places, whose phases cannot be predicted.
    delay_s
        How much later than predicted it came; NaN at quiet places.
    """

    output: int
    played: Played
    measured_db: float
    predicted_db: float
    low_db: float = nan
    high_db: float = nan
    nmse_db: float = nan
    delay_s: float = nan


@dataclass(frozen=True, kw_only=True, eq=False)
class Verification:
    """What is played, where the sensor goes, and what it measured so far.

    Attributes
    ----------
    found
        The calibration.
    focus
        What was solved from it.
    designs
        What is played, as strong at the target.
    expected
        Levels of these designs on other people.
    places
        Where the sensor goes: the target, the output that is expected to be the loudest other one,
        and one that is in the middle.
    checks
        What was measured.
    """

    found: Calibration
    focus: Focus
    designs: Mapping[Played, Design]
    expected: Mapping[Played, Range]
    places: tuple[int, int, int]
    checks: tuple[Check, ...] = ()

    @property
    def next_output(self) -> int | None:
        """Where the sensor must be for the next check; None: all are done."""
        done = len(self.checks) // len(self.designs)
        return self.places[done] if done < len(self.places) else None

    @property
    def state(self) -> State:
        """Whether the focus is where it should be; it is not verified before all checks are done.

        It differs where the level at the target is off by more than 3 dB, or a quiet place is
        stronger than the range between people.
        """
        if self.next_output is not None:
            return "not verified"
        strong, *quiet = (check for check in self.checks if check.played == "focus")
        good = abs(strong.measured_db - strong.predicted_db) <= MOST_OFF_DB
        good = good and all(check.measured_db <= check.high_db for check in quiet)
        return "verified" if good else "differs"

    @property
    def words(self) -> str:
        """What was found, and how the louder quiet place compares with target and single input."""
        if self.next_output is not None:
            return "Not verified."
        at = {(check.played, check.output): check.measured_db for check in self.checks}
        strong, target = self.checks[0], self.places[0]
        loudest = max(self.places[1:], key=lambda output: at["focus", output])
        below_db = at["focus", target] - at["focus", loudest]
        single_db = at["best single", target] - at["best single", loudest]
        name = output_name(loudest, self.found.sitting.like).short_name
        return (
            f"{self.state.capitalize()}: {strong.measured_db:z.1f} dB measured at the target, "
            f"{strong.predicted_db:z.1f} dB predicted. The louder of two quiet places, {name}, is "
            f"{abs(below_db):.1f} dB {'below' if below_db >= 0.0 else 'above'} the target. It is "
            f"{abs(below_db - single_db):.1f} dB "
            f"{'quieter' if below_db >= single_db else 'louder'} there than the best single input "
            "that is as strong at the target."
        )

    def holds_for(self, partial: PartialLimb) -> bool:
        """Whether it is of this very measurement: after mounting anew it is not."""
        return digest_of(partial) == digest_of(self.found.partial)


@checking
def begin_verifying(
    found: Calibration,
    focus: Focus,
    waveform: Waveform,
    *,
    level: float = 0.3,
    others: Sequence[str] | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> Verification:
    """Return what is to be played, and where the sensor goes; nothing is played yet.

    Parameters
    ----------
    found
        The calibration.
    focus
        Of its partial limb, from `skinsource.people.focus`.
    waveform, level
        What the target does, and how strongly, as of `skinsource.inverse.Focus.design`.
    others
        Names of limbs of other people; None: all measured ones.
    progress, stop
        ``progress`` is called before the levels of each design; once ``stop`` returns True,
        `Stopped` is raised.

    Raises
    ------
    InvalidInputError
        The waveform has nothing in the band, or others are too few.
    DatasetMissingError
        The measured dataset is needed, and not installed.
    Stopped
        ``stop`` returned True.

    Examples
    --------
    >>> import skinsource as ss
    >>> from skinsource.lab.calibrating import Sitting, StandIn, begin_verifying, calibrate
    >>> station = StandIn(inputs=(7, 12))
    >>> found = calibrate(Sitting(person="p07", like=station.like, output=9), station)
    >>> focus = ss.people.focus(found.partial, 9, others=station.others)
    >>> tone = ss.waveforms.Tone()
    >>> plan = begin_verifying(found, focus, tone, others=station.others)
    >>> print(plan.next_output, plan.state)
    9 not verified
    """
    limb, at_hz = found.partial.limb, focus.frequencies_hz
    energy = np.square(np.abs(focus.row)).sum(axis=0)
    best = int((energy / np.einsum("fii->i", focus.gram).real).argmax())
    single, reversed_in_time = (
        time_reversal(limb, focus.target, inputs=inputs, frequencies_hz=at_hz)
        for inputs in (focus.inputs[best : best + 1], focus.inputs)
    )
    solved: dict[Played, Focus] = {
        "focus": focus,
        "best single": single,
        "time reversal": reversed_in_time,
    }
    through = actuation_of_rig(found.rig, RegularisedInverse())
    designs = {
        name: replace(
            each.design(waveform, level=level),
            title=f"{name.capitalize()} at output {focus.target} of {found.sitting.person}",
            actuation=through,
        )
        for name, each in solved.items()
    }
    people = people_of(others, 2)
    expected: dict[Played, Range] = {}
    for number, (name, design) in enumerate(designs.items()):
        stop_if(stop)
        progress(number, len(designs), f"Levels on other people: {name}")
        expected[name] = levels(design, _LEVEL, limbs=people)
    quiet = [output for output in hand_outputs(limb) if output != focus.target]
    by_level = sorted(quiet, key=lambda output: -expected["focus"].mean_db[output - 1])
    return Verification(
        found=found,
        focus=focus,
        designs=designs,
        expected=expected,
        places=(focus.target, by_level[0], by_level[len(by_level) // 2]),
    )


@checking
def verify_next(
    verification: Verification, station: Station, *, progress: Progress = silent, stop: Stop = never
) -> Verification:
    """Play all designs while the sensor is at `Verification.next_output`, and add the checks.

    Parameters
    ----------
    verification
        Not all is done.
    station
        That of the calibration.
    progress, stop
        ``progress`` is called before each design; once ``stop`` returns True, all is silent and
        `Stopped` is raised.

    Raises
    ------
    PlaybackError
        A limit of the rig would be passed; the device refuses, loses samples, or is gone.
    Stopped
        ``stop`` returned True.

    Examples
    --------
    >>> import skinsource as ss
    >>> from skinsource.lab.calibrating import Sitting, StandIn, begin_verifying
    >>> from skinsource.lab.calibrating import calibrate, verify_next
    >>> station = StandIn(inputs=(7, 12))
    >>> found = calibrate(Sitting(person="p07", like=station.like, output=9), station)
    >>> focus = ss.people.focus(found.partial, 9, others=station.others)
    >>> tone = ss.waveforms.Tone()
    >>> plan = begin_verifying(found, focus, tone, others=station.others)
    >>> print([check.played for check in verify_next(plan, station).checks])
    ['focus', 'best single', 'time reversal']
    """
    output = verification.places[len(verification.checks) // len(verification.designs)]
    checks = []
    for number, name in enumerate(verification.designs):
        progress(number, len(verification.designs), f"Output {output}: {name}")
        checks.append(_checked(verification, station, output, name, stop))
    return replace(verification, checks=(*verification.checks, *checks))


def _checked(
    verification: Verification, station: Station, output: int, name: Played, stop: Stop
) -> Check:
    """Play one design, and return what the sensor at an output measured."""
    found, rate_hz, design = verification.found, station.sample_rate_hz, verification.designs[name]
    mix = Mixer().mix(design, Output(sample_rate_hz=rate_hz), rig=station.rig)
    around = samples_in(BEFORE_S, station), samples_in(AFTER_S, station)
    mix = replace(mix, samples=np.pad(mix.samples, ((0, 0), around)))
    recorded = station.record(mix, stop, lambda n: None)[around[0] :]
    limb = found.partial.limb
    n_seconds = ceil(recorded.size / rate_hz) + 1
    n = round(n_seconds * limb.sample_rate_hz)
    hz = np.arange(n // 2 + 1) / n_seconds
    band = target(hz, found.sitting.band_hz)
    sent = stimulus_of(design)
    places = [channel.place for channel in sent.channels if channel.place is not None]
    # Channels that play wait for the slowest of them.
    waited_s = max(wired_channel(station.rig, place).delay_s for place in places)
    latest_s = found.latency_s + waited_s
    unit = station.setup.m_per_s2_at_full_scale * limb.sample_rate_hz / rate_hz
    came = unit * band * scipy.fft.rfft(recorded, n_seconds * rate_hz)[: hz.size]
    came *= np.exp(2j * np.pi * hz * (latest_s - limb.pre_trigger_delay_s))
    measured = scipy.fft.irfft(came, n)
    if output != verification.focus.target:
        theirs = verification.expected[name]
        ends_db = theirs.mean_db, theirs.low_db, theirs.high_db
        predicted_db, low_db, high_db = (float(levels_db[output - 1]) for levels_db in ends_db)
        return Check(
            output=output,
            played=name,
            measured_db=_level_db(measured, limb),
            predicted_db=predicted_db,
            low_db=low_db,
            high_db=high_db,
        )
    ideal = predict(limb, sent.samples, places)[output - 1, limb.axes.index("z")]
    wanted = band * scipy.fft.rfft(ideal, n)
    predicted = scipy.fft.irfft(wanted, n)
    delay_s = lag_of(predicted, measured, _MOST_LAG) / limb.sample_rate_hz
    off = came * np.exp(2j * np.pi * hz * delay_s) - wanted
    return Check(
        output=output,
        played=name,
        measured_db=_level_db(measured, limb),
        predicted_db=_level_db(predicted, limb),
        nmse_db=float(decibels(np.linalg.norm(off) / np.linalg.norm(wanted))),
        delay_s=delay_s,
    )


def _level_db(signal: Floats, limb: Limb) -> float:
    n_window = window_samples(limb.sample_rate_hz)
    return float(decibels(np.sqrt(loudest_energy(signal, n_window) / n_window)))
