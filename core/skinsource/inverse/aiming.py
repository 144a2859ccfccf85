"""The drives of a target of a design, what they do beside simpler ways, and on other people.

They are found where the waveform of the target has energy, by `skinsource.inverse.focus` for one
strong output, and by `skinsource.inverse.paint` for several.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import log10, nan
from typing import Any

import numpy as np
import scipy

from skinsource.base.arguments import checking
from skinsource.base.conventions import (
    ALL_AXES,
    LARGEST_VELOCITY_M_PER_S,
    Axes,
    Band,
    Complexes,
    Floats,
)
from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design, Input
from skinsource.design.target import BETA, NO_TARGET, Target, conditions_of, target_in
from skinsource.engine.shared import Shared
from skinsource.inverse.focusing import Focus, energy_of, focus, paint
from skinsource.inverse.placement import place
from skinsource.inverse.responses import Responses, n_fft_of, responses_of
from skinsource.limbs.limb import Limb
from skinsource.limbs.locations import output_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.limbs.scaling import pulse_spectrum
from skinsource.perception.validity import fastest_probe
from skinsource.specs.samples import Samples

# Energy that counts, as a share of the strongest bin: -60 dB.
_COUNTS = 1e-6


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Aim:
    """A target with the drives that were found for it.

    Attributes
    ----------
    target, limb
        What was solved, and for which limb.
    band_hz
        Where it is driven.
    responses
        Spectra of the responses where the waveform has energy.
    power : (n_bins,)
        Share of the waveform's energy in each bin.
    focus
        The solution at these bins.
    """

    target: Target
    limb: Limb
    band_hz: Band
    responses: Responses
    power: Floats
    focus: Focus

    @property
    def places(self) -> tuple[int, ...]:
        """Places that play."""
        return self.responses.inputs

    def solved(self, design: Design) -> Target:
        """Return the target with its drives, found under the conditions of a design."""
        tracks = self.tracks(self.focus.used_drives)
        return replace(
            self.target,
            places=tuple(track.location for track in tracks),
            drives=tuple(samples_of(track) for track in tracks),
            solved_for=conditions_of(design),
        )

    def tracks(self, drives: Complexes) -> tuple[Input, ...]:
        """Return the tracks with which the waveform plays through drives, (n_bins, n_used)."""
        everywhere = np.zeros_like(self.focus.drives)
        everywhere[:, np.array(self.places) - 1] = drives
        playing = replace(self.focus, drives=everywhere)
        return playing.design(self.target.waveform, band_hz=self.band_hz).inputs


def samples_of(track: Input) -> Samples:
    """Return what a track of an `Aim` plays."""
    waveform: Any = track.clips[0].waveform
    return waveform.samples


@checking
def aim(target: Target, limb: Limb) -> Aim:
    """Return the drives of a target.

    Parameters
    ----------
    target
        With one strong output or more.
    limb
        For which it is solved.

    Raises
    ------
    InvalidInputError
        Nothing is strong, a strong output is mostly noise, a place does not exist, or the waveform
        has no energy in the band.

    Examples
    --------
    >>> import skinsource as ss
    >>> from skinsource.design.target import Target
    >>> aimed = aim(Target(strong=(30,)), ss.load_limb("synthetic-1"))
    >>> len(aimed.places)
    15
    """
    if not target.strong:
        raise InvalidInputError("No output is strong. Choose one on the skin map.")
    band_hz, at_hz, power = _band_of(target, limb)
    solved = _solved(target, limb, at_hz)
    responses = responses_of(
        limb, axes=_axes(target, limb), inputs=solved.inputs, frequencies_hz=at_hz
    )
    return Aim(
        target=target,
        limb=limb,
        band_hz=band_hz,
        responses=responses,
        power=power,
        focus=solved,
    )


def aim_of(design: Design) -> Aim:
    """Return the drives of the target of a design on its limb.

    Raises
    ------
    InvalidInputError
        As of `aim`, or the drives of the design are no accelerations.
    """
    found = target_in(design)
    if found is None:
        raise InvalidInputError(NO_TARGET)
    facts = facts_of(design.limb)
    limb = Shared().limb_data(design.limb, design.limb_digest or facts.digest, facts.mirrored)
    actuated = design.actuated
    if design.scaling != "probe" or (actuated is not None and actuated.equaliser is None):
        raise InvalidInputError(
            "The drives of a target are accelerations. Choose the scaling Probe acceleration, and "
            "under Output an equaliser for actuators."
        )
    return aim(found[1], limb)


def _axes(target: Target, limb: Limb) -> Axes:
    return target.axes if set(target.axes) <= set(limb.axes) else ALL_AXES


def _band_of(target: Target, limb: Limb) -> tuple[Band, Floats, Floats]:
    """Return where a waveform is driven, the bins with energy there, and the share of each."""
    n_fft = n_fft_of(limb.n_taps)
    known = responses_of(limb, inputs=(1,)).frequencies_hz
    samples = np.pad(target.waveform.samples(limb.sample_rate_hz), n_fft)
    frames = np.lib.stride_tricks.sliding_window_view(samples, n_fft)[:: n_fft // 2]
    spectra = scipy.fft.rfft(frames * scipy.signal.windows.hann(n_fft, sym=False))
    everywhere = np.square(np.abs(spectra)).sum(axis=0)
    all_hz = np.arange(n_fft // 2 + 1) * limb.sample_rate_hz / n_fft
    power = everywhere[np.searchsorted(all_hz, known[0]) :][: known.size]
    counts = np.flatnonzero(power > _COUNTS * everywhere.max(initial=0.0))
    if not counts.size:
        raise InvalidInputError(
            f"The waveform has no energy from {known[0]:.0f} to {known[-1]:.0f} Hz, where the skin "
            "answers. Choose other frequencies."
        )
    inside = slice(counts[0], counts[-1] + 1)
    band_hz = float(known[0]), float(known[-1])
    return band_hz, known[inside], power[inside] / power[inside].sum()


def _solved(target: Target, limb: Limb, at_hz: Floats) -> Focus:
    axes: Axes = _axes(target, limb)
    responses = responses_of(limb, axes=axes, inputs=target.inputs or None, frequencies_hz=at_hz)
    inputs = responses.inputs
    if 0 < target.most < len(inputs):
        inputs = place(
            limb, target.strong, target.most, candidates=inputs, axes=axes, beta=target.beta
        ).inputs
    common: Any = {"axes": axes, "inputs": inputs, "beta": target.beta, "frequencies_hz": at_hz}
    if len(target.strong) == 1:
        return focus(limb, target.strong[0], quiet=target.quiet or None, **common)
    quiet = target.quiet or tuple(set(responses.others) - set(target.strong))
    return paint(limb, dict.fromkeys(target.strong, 1.0), dict.fromkeys(quiet, 1.0), **common)


@dataclass(frozen=True, kw_only=True)
class Way:
    """What one way to reach a target does; levels in dB re that of the strong outputs.

    Attributes
    ----------
    title
        Its name.
    loudest_db, loudest
        Level at the loudest output that is not strong, and which that is.
    quiet_db, between_db
        Mean level at what is to be quiet, and the same as it is expected between the sensors.
    contact_db
        Level at the strongest contact; NaN where the unit of drives is not known.
    effort_db
        Energy of the drives over the least that gives the same at the strong outputs.
    velocity_m_per_s
        Largest velocity of a probe; NaN where the unit of drives is not known.
    """

    title: str
    loudest_db: float
    loudest: int
    quiet_db: float
    between_db: float
    contact_db: float
    effort_db: float
    velocity_m_per_s: float


@dataclass(frozen=True, kw_only=True, eq=False)
class OnLimb:
    """What the drives of a target do on a limb.

    Attributes
    ----------
    limb
        The limb.
    levels_db : (n_outputs,)
        In dB re the strong outputs on the limb for which they were found.
    contrast_db
        Level at the strong outputs over the loudest other one, on this limb.
    """

    limb: Limb
    levels_db: Floats
    contrast_db: float


def ways(aim: Aim) -> tuple[Way, Way, Way]:
    """Return what the best single input, time reversal and the drives of a target do."""
    in_time = _reversed(aim)
    least = aim.power @ np.square(np.abs(_equal(aim, in_time))).sum(axis=1)
    between = float(aim.power @ 10.0 ** (-aim.focus.unseen_contrast_db / 10.0))
    return (
        _way(aim, "Best input", _best_single(aim), least),
        _way(aim, "Time reversal", in_time, least),
        _way(aim, aim.target.title, aim.focus.used_drives, least, 10.0 * log10(between)),
    )


def _equal(aim: Aim, drives: Complexes) -> Complexes:
    """Return drives scaled so that the mean energy of the strong outputs is that of the target."""
    wanted, there = (_bright(aim, each) for each in (aim.focus.used_drives, drives))
    return drives * np.sqrt(wanted / there)


def _bright(aim: Aim, drives: Complexes) -> float:
    return float((aim.power @ energy_of(aim.responses, drives))[_rows(aim.target.strong)].mean())


def _rows(outputs: tuple[int, ...]) -> list[int]:
    return [output - 1 for output in outputs]


def _reversed(aim: Aim) -> Complexes:
    """Return the drives of least effort."""
    if len(aim.target.strong) == 1:
        return aim.focus.row.conj() / np.square(np.abs(aim.focus.row)).sum(axis=1, keepdims=True)
    gentle = replace(aim.target, beta=BETA.maximum, inputs=aim.places, most=0)
    return _solved(gentle, aim.limb, aim.responses.frequencies_hz).used_drives


def _best_single(aim: Aim) -> Complexes:
    """Return the drives of the input that has the most contrast when it plays the waveform."""
    pulse = pulse_spectrum(aim.responses.frequencies_hz, aim.limb.sample_rate_hz)
    plain = np.ones(len(pulse)) if aim.limb.per_unit_drive else 1.0 / pulse
    energy = np.square(np.abs(aim.responses.values)).sum(axis=2)
    energy = np.einsum("f,foi->oi", aim.power * plain**2, energy)
    contrast = energy[_rows(aim.target.strong)].mean(0) / energy[_rows(quiet_in(aim))].mean(0)
    drives = np.zeros((len(plain), energy.shape[1]), complex)
    drives[:, int(np.argmax(contrast))] = plain
    return drives


def quiet_in(aim: Aim) -> tuple[int, ...]:
    """Return the outputs that a target wants quiet."""
    others = (output for output in aim.responses.others if output not in aim.target.strong)
    return aim.target.quiet or tuple(others)


def _way(
    aim: Aim, title: str, drives: Complexes, least: float, between_db: float | None = None
) -> Way:
    drives, limb = _equal(aim, drives), aim.limb
    levels_db = _levels_db(aim, aim.responses, drives)
    quiet_db = float(10.0 * np.log10(np.mean(10.0 ** (levels_db[_rows(quiet_in(aim))] / 10.0))))
    loudest = _loudest_other(aim, aim.responses, levels_db)
    contact_db = velocity = nan
    each = np.square(np.abs(drives))
    if not limb.per_unit_drive:
        pulse = pulse_spectrum(aim.responses.frequencies_hz, limb.sample_rate_hz)
        bright = _bright(aim, drives)
        contact_db = float(10.0 * np.log10((aim.power * pulse**2 @ each).max() / bright))
        probes = (samples_of(track).values for track in aim.tracks(drives))
        fastest = fastest_probe(probes, limb.sample_rate_hz, limb.band_hz)
        velocity = aim.target.amplitude * fastest
    return Way(
        title=title,
        loudest_db=float(levels_db[loudest - 1]),
        loudest=loudest,
        quiet_db=quiet_db,
        between_db=quiet_db if between_db is None else between_db,
        contact_db=contact_db,
        effort_db=float(10.0 * np.log10(aim.power @ each.sum(axis=1) / least)),
        velocity_m_per_s=velocity,
    )


def _levels_db(aim: Aim, responses: Responses, drives: Complexes) -> Floats:
    """Return the level of each output re the strong ones on the limb of the target."""
    with np.errstate(divide="ignore"):
        return 10.0 * np.log10(aim.power @ energy_of(responses, drives) / _bright(aim, drives))


def _loudest_other(aim: Aim, responses: Responses, levels_db: Floats) -> int:
    others = [output for output in responses.others if output not in aim.target.strong]
    return max(others, key=lambda output: levels_db[output - 1])


def on_limb(aim: Aim, limb: Limb) -> OnLimb:
    """Return what the drives of a target do on a limb, that of another person as a rule.

    Raises
    ------
    InvalidInputError
        The limb has not these places and this rate.
    """
    responses = responses_of(
        limb,
        axes=_axes(aim.target, limb),
        inputs=aim.places,
        frequencies_hz=aim.responses.frequencies_hz,
    )
    levels_db = _levels_db(aim, responses, aim.focus.used_drives)
    strong = 10.0 ** (levels_db[_rows(aim.target.strong)] / 10.0)
    loudest = levels_db[_loudest_other(aim, responses, levels_db) - 1]
    contrast_db = float(10.0 * np.log10(strong.mean()) - loudest)
    return OnLimb(limb=limb, levels_db=levels_db, contrast_db=contrast_db)


#: Between sensors a target has to gain so much over the best single input, dB.
LEAST_GAIN_DB = 3.0
#: Nothing is told to be deeper: responses are known to about 30 %.
DEEPEST_DB = -20.0


def sentences(aim: Aim, found: tuple[Way, Way, Way]) -> tuple[str, ...]:
    """Return what has to be known of a target: what cannot be reached, and what is as good."""
    single, _, own = found
    said = []
    if own.velocity_m_per_s > LARGEST_VELOCITY_M_PER_S:
        most = aim.target.amplitude * LARGEST_VELOCITY_M_PER_S / own.velocity_m_per_s
        limit = f"{1e3 * LARGEST_VELOCITY_M_PER_S:g} mm/s"
        said.append(f"Not reachable within {limit}: {most:.2g} m/s² at most.")
    if own.loudest_db > 0.0 and not aim.target.quiet:
        name = output_name(own.loudest, aim.limb.name).name
        said.append(f"Not reachable: {name} is {own.loudest_db:.1f} dB louder at best.")
    if single.between_db - own.between_db < LEAST_GAIN_DB:
        said.append("One actuator does as well.")
    if own.quiet_db < DEEPEST_DB:
        said.append(f"What is quiet is below {DEEPEST_DB:g} dB in the model.")
    return tuple(said)
