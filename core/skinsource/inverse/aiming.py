"""The drives of a target of a design, what they do beside simpler ways, and on other people.

They are found where the waveform of the target has energy, by `skinsource.inverse.focus` for one
strong output, and by `skinsource.inverse.paint` for several.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import nan, sqrt
from typing import Any

import numpy as np
import scipy

from skinsource.actuators.equalising import equalised, followed_band
from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import Margin, Rig, RigChannel, highest_gain, limits_of, strictest
from skinsource.base.arguments import checking
from skinsource.base.conventions import LARGEST_VELOCITY_M_PER_S, Band, Complexes, Floats
from skinsource.base.errors import InvalidInputError, counted, sentence
from skinsource.design.design import Design, audible_inputs
from skinsource.design.target import BETA, NO_TARGET, Target, conditions_of, target_in
from skinsource.engine.actuator_demand import profile_of
from skinsource.engine.shared import Shared
from skinsource.inverse.designing import Focus, pulse_of
from skinsource.inverse.drives_in_time import samples_of
from skinsource.inverse.focusing import energy_of, focus, paint
from skinsource.inverse.placement import place
from skinsource.inverse.responses import Responses, bins_of, n_fft_of, power_db, responses_of
from skinsource.limbs.limb import Limb
from skinsource.limbs.locations import output_name
from skinsource.limbs.own_limbs import axes_on, facts_of
from skinsource.perception.validity import fastest_probe

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
        """Places that may play."""
        return self.responses.inputs

    @property
    def peak(self) -> float | None:
        """Largest sample of a drive for an amplitude of 1; None: there is no limit."""
        target = self.target
        return target.peak / target.amplitude if target.peak and target.amplitude else None

    def solved(self, design: Design) -> Target:
        """Return the target with its drives, found under the conditions of a design."""
        rows = zip(self.places, self.played, strict=True)
        playing = {place: samples_of(self.focus.limb, row) for place, row in rows if row.any()}
        return replace(
            self.target,
            places=tuple(playing),
            drives=tuple(playing.values()),
            solved_for=conditions_of(design),
        )

    @cached_property
    def played(self) -> Floats:
        """What the places play for an amplitude of 1, (n_used, n_times)."""
        return self.in_time(self.focus.used_drives, self.peak)

    @cached_property
    def spectra(self) -> Complexes:
        """Spectra of pieces of what is played, (n_pieces, n_bins, n_used).

        Their energies add up; that of the waveform is 1.
        """
        if self.peak is None or np.abs(self.played).max() < self.peak:
            return self.of_waveform(self.focus.used_drives)
        limb, at_hz = self.limb, self.responses.frequencies_hz
        wave = self.target.waveform.samples(limb.sample_rate_hz)
        pieces, whole = (_pieces(limb, rows, at_hz) for rows in (self.played, wave))
        pulse = pulse_of(limb, at_hz)[:, None]
        return np.moveaxis(pieces, 0, -1) / pulse / np.sqrt(np.square(np.abs(whole)).sum())

    def of_waveform(self, drives: Complexes) -> Complexes:
        """Return `spectra` of the waveform through drives, (n_bins, n_used), without a limit."""
        spectra: Complexes = np.sqrt(self.power)[None, :, None] * drives
        return spectra

    def in_time(self, drives: Complexes, peak: float | None = None) -> Floats:
        """Return the waveform through drives, (n_bins, n_used), in time: (n_used, n_times)."""
        playing = replace(self.focus, used_drives=drives)
        return playing.drives_in_time(self.target.waveform, peak=peak, band_hz=self.band_hz)


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
    axes = axes_on(limb.name, target.axes)
    return Aim(
        target=target,
        limb=limb,
        band_hz=band_hz,
        responses=responses_of(limb, axes=axes, inputs=solved.inputs, frequencies_hz=at_hz),
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


def _band_of(target: Target, limb: Limb) -> tuple[Band, Floats, Floats]:
    """Return where a waveform is driven, the bins with energy there, and the share of each."""
    axes = axes_on(limb.name, target.axes)
    known = responses_of(limb, axes=axes, inputs=(1,)).frequencies_hz
    all_hz = bins_of(n_fft_of(limb.n_taps), limb.sample_rate_hz)
    pieces = _pieces(limb, target.waveform.samples(limb.sample_rate_hz), all_hz)
    everywhere = np.square(np.abs(pieces)).sum(axis=0)
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


def _pieces(limb: Limb, samples: Floats, at_hz: Floats) -> Complexes:
    """Return spectra at bins of overlapping pieces of samples, (..., n_pieces, n_bins)."""
    n_fft = n_fft_of(limb.n_taps)
    longer = np.pad(samples, [*[(0, 0)] * (samples.ndim - 1), (n_fft, n_fft)])
    pieces = np.lib.stride_tricks.sliding_window_view(longer, n_fft, axis=-1)
    # Windows whose squares add up to the same everywhere: no energy is left out.
    pieces = pieces[..., :: n_fft // 4, :] * scipy.signal.windows.hann(n_fft, sym=False)
    first = np.searchsorted(bins_of(n_fft, limb.sample_rate_hz), at_hz[0])
    return scipy.fft.rfft(pieces)[..., first : first + at_hz.size]


def _solved(target: Target, limb: Limb, at_hz: Floats) -> Focus:
    axes = axes_on(limb.name, target.axes)
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
    amplitude
        Acceleration at the strong outputs where the waveform is 1, m/s²: less than that of the
        target where its peak allows no more.
    loudest_db, loudest
        Level at the loudest output that is not strong, and which that is.
    quiet_db, between_db
        Mean level at what is to be quiet, and the same as it is expected between the sensors:
        within a peak as much more than at them as without it.
    contact_db
        Level at the strongest contact; NaN where the unit of drives is not known.
    effort_db
        Energy of the drives over the least that gives the same at the strong outputs.
    velocity_m_per_s
        Largest velocity of a probe; NaN where the unit of drives is not known.
    """

    title: str
    amplitude: float
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
    levels_db : (n_outputs,)
        In dB re the strong outputs of this limb.
    loudest_db, loudest
        Level at the loudest output that is not strong, and which that is.
    """

    levels_db: Floats
    loudest_db: float
    loudest: int


def ways(aim: Aim) -> tuple[Way, Way, Way]:
    """Return what the best single input, time reversal and the drives of a target do.

    The first two are as strong as the target.
    """
    place, alone = _best_single(aim)
    in_time = _reversed(aim)
    spectra = aim.of_waveform(in_time)
    least = np.square(np.abs(spectra)).sum() / _bright(aim, spectra)
    return (
        _way(aim, f"Best input: {place}", least, alone),
        _way(aim, "Time reversal", least, in_time),
        _way(aim, aim.target.title, least),
    )


def _bright(aim: Aim, spectra: Complexes, there: Responses | None = None) -> float:
    """Return the mean energy of the strong outputs, on another limb where its responses are."""
    return float(_energy(there or aim.responses, spectra)[_rows(aim.target.strong)].mean())


def _energy(responses: Responses, spectra: Complexes) -> Floats:
    """Return the energy of all outputs, (n_outputs,)."""
    return sum((energy_of(responses, piece).sum(axis=0) for piece in spectra), start=np.zeros(1))


def _rows(outputs: tuple[int, ...]) -> list[int]:
    return [output - 1 for output in outputs]


def _reversed(aim: Aim) -> Complexes:
    """Return the drives of least effort."""
    if len(aim.target.strong) == 1:
        return aim.focus.row.conj() / np.square(np.abs(aim.focus.row)).sum(axis=1, keepdims=True)
    gentle = replace(aim.target, beta=BETA.maximum, inputs=aim.places, most=0)
    return _solved(gentle, aim.limb, aim.responses.frequencies_hz).used_drives


def _best_single(aim: Aim) -> tuple[int, Complexes]:
    """Return the place that has the most contrast when it plays the waveform, and its drives."""
    plain = 1.0 / pulse_of(aim.limb, aim.responses.frequencies_hz)
    energy = np.square(np.abs(aim.responses.values)).sum(axis=2)
    energy = np.einsum("f,foi->oi", aim.power * plain**2, energy)
    contrast = energy[_rows(aim.target.strong)].mean(0) / energy[_rows(quiet_in(aim))].mean(0)
    drives = np.zeros((len(plain), energy.shape[1]), complex)
    best = int(np.argmax(contrast))
    drives[:, best] = plain
    return aim.places[best], drives


def quiet_in(aim: Aim) -> tuple[int, ...]:
    """Return the outputs that a target wants quiet."""
    others = (output for output in aim.responses.others if output not in aim.target.strong)
    return aim.target.quiet or tuple(others)


def _way(aim: Aim, title: str, least: float, drives: Complexes | None = None) -> Way:
    """Return what drives do, (n_bins, n_used), as strong as the target; None: those of the target.

    ``least``: least energy of drives for an energy of 1 at the strong outputs.
    """
    spectra, played, limb, amplitude = aim.spectra, aim.played, aim.limb, aim.target.amplitude
    bright = _bright(aim, spectra)
    if drives is not None:
        drives = drives * np.sqrt(bright / _bright(aim, aim.of_waveform(drives)))
        spectra, played = aim.of_waveform(drives), aim.in_time(drives)
    levels_db = _levels_db(aim.responses, spectra, bright)
    quiet_db = between_db = _power_db(levels_db[_rows(quiet_in(aim))])
    if drives is None:
        seen, unseen = aim.focus.mean_contrast_db, aim.focus.unseen_contrast_db
        between_db += _power_db(-unseen, aim.power) - _power_db(-seen, aim.power)
    loudest = _loudest_other(aim, aim.responses, levels_db)
    each = np.square(np.abs(spectra)).sum(axis=0)
    contact_db = velocity = nan
    if not limb.per_unit_drive:
        contacts = pulse_of(limb, aim.responses.frequencies_hz) ** 2 @ each
        contact_db = float(10.0 * np.log10(contacts.max() / bright))
        velocity = amplitude * fastest_probe(played, limb.sample_rate_hz, limb.band_hz)
    return Way(
        title=title,
        amplitude=amplitude * sqrt(bright / _bright(aim, aim.of_waveform(aim.focus.used_drives))),
        loudest_db=float(levels_db[loudest - 1]),
        loudest=loudest,
        quiet_db=quiet_db,
        between_db=between_db,
        contact_db=contact_db,
        effort_db=float(10.0 * np.log10(each.sum() / bright / least)),
        velocity_m_per_s=velocity,
    )


def _power_db(levels_db: Floats, weights: Floats | None = None) -> float:
    """Return the level of the mean energy."""
    return float(10.0 * np.log10(np.average(10.0 ** (levels_db / 10.0), weights=weights)))


def _levels_db(responses: Responses, spectra: Complexes, bright: float) -> Floats:
    """Return the level of each output re an energy."""
    return power_db(_energy(responses, spectra), bright)


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
        axes=axes_on(limb.name, aim.target.axes),
        inputs=aim.places,
        frequencies_hz=aim.responses.frequencies_hz,
    )
    levels_db = _levels_db(responses, aim.spectra, _bright(aim, aim.spectra, responses))
    loudest = _loudest_other(aim, responses, levels_db)
    return OnLimb(levels_db=levels_db, loudest_db=float(levels_db[loudest - 1]), loudest=loudest)


#: Between sensors a target has to gain so much over the best single input, dB.
LEAST_GAIN_DB = 3.0
# Level re the strong outputs from which another one is louder: less is written as 0.0 dB.
_LOUDER_DB = 0.05
# Share of the amplitude that counts as all of it.
_REACHED = 0.995
#: Nothing is told to be deeper: responses are known to about 30 %.
DEEPEST_DB = -20.0


def sentences(aim: Aim, found: tuple[Way, Way, Way], design: Design) -> tuple[str, ...]:
    """Return what has to be known of a target: what cannot be reached, and what is as good.

    Limits are those of the actuators and of the rig of a design; what else it plays is told.
    """
    single, _, own = found
    said = []
    limited = own.amplitude < _REACHED * aim.target.amplitude
    if limited:
        said.append(_not_within(f"a peak of {aim.target.peak:g} m/s²", own.amplitude))
    if own.velocity_m_per_s > LARGEST_VELOCITY_M_PER_S:
        most = own.amplitude * LARGEST_VELOCITY_M_PER_S / own.velocity_m_per_s
        said.append(_not_within(f"{1e3 * LARGEST_VELOCITY_M_PER_S:g} mm/s", most))
    try:
        margin = margin_of(aim, design)
    except InvalidInputError as error:
        said.append(sentence(str(error)))
    else:
        if margin.factor < 1.0:
            limits = f"the actuator's limits ({margin.words})"
            said.append(_not_within(limits, margin.factor * own.amplitude))
    if own.loudest_db >= _LOUDER_DB and not aim.target.quiet:
        said.append(_louder(aim, found))
    if len(aim.places) > 1:
        gain_db = round(single.between_db - own.between_db, 1)
        said.append(_between(len(aim.places), gain_db, judged=not limited))
    if own.quiet_db < DEEPEST_DB:
        said.append(f"What is quiet is more than {-DEEPEST_DB:g} dB below in the model.")
    if others := tracks_beside(design):
        said.append(f"The rows leave out {counted(others, 'other track')}.")
    return tuple(said)


def _louder(aimed: Aim, found: tuple[Way, Way, Way]) -> str:
    """Return that an output is louder than the strong ones, and what helps, if anything does."""
    single, in_time, own = found
    sharpest = aim(replace(aimed.target, beta=BETA.minimum), aimed.limb)
    tried: dict[str, Way | OnLimb] = {
        "Move it towards Sharp.": on_limb(sharpest, aimed.limb),
        "Move it towards Strong.": in_time,
        "The best input alone does better.": single,
    }
    cure = next((cure for cure, way in tried.items() if way.loudest_db < _LOUDER_DB), "")
    best = own if cure else min((own, *tried.values()), key=lambda way: way.loudest_db)
    louder = f"{output_name(best.loudest, aimed.limb.name).name} is {best.loudest_db:.1f} dB louder"
    if cure:
        return f"With this slider position, {louder}. {cure}"
    return f"Not reachable: {louder} at best."


def _between(n_inputs: int, gain_db: float, *, judged: bool) -> str:
    """Return what inputs gain between the sensors; ``judged``: and whether one does as well."""
    side = "quieter" if gain_db > 0.0 else "louder"
    how = f"{abs(gain_db):.1f} dB {side} than" if gain_db else "as quiet as"
    well = "nearly as well" if gain_db > 0.0 else "as well"
    so = f": one actuator does {well}" if judged and gain_db < LEAST_GAIN_DB else ""
    return f"Between sensors {counted(n_inputs, 'input')} are {how} the best input{so}."


def _not_within(limit: str, most: float) -> str:
    return f"Not reachable within {limit}: {most:.2g} m/s² at most."


def tracks_beside(design: Design) -> int:
    """Return how many tracks of a design play beside those of its target."""
    found = target_in(design)
    own = () if found is None else design.motions[found[0]].clips
    beside = (
        any(clip.id not in own and not clip.muted for clip in track.clips)
        for track in audible_inputs(design.inputs)
    )
    return sum(beside)


def margin_of(aim: Aim, design: Design) -> Margin:
    """Return the gain that the actuators and the rig of a design allow to the drives of a target.

    Raises
    ------
    InvalidInputError
        A place that plays has no actuator.
    """
    actuation, rate_hz = design.actuation, aim.limb.sample_rate_hz
    drives = {
        at: aim.target.amplitude * row
        for at, row in zip(aim.places, aim.played, strict=True)
        if row.any()
    }
    if actuation is None or actuation.equaliser is None or not drives:
        return Margin()
    channels, volts = [], []
    equaliser, band_hz = actuation.equaliser, followed_band(aim.limb.band_hz, rate_hz)
    for at, drive in drives.items():
        actuator = actuation.at(at)
        limits = profile_of(actuator).limits
        if design.rig is not None and (wired := design.rig.channel_of(at)) is not None:
            full = wired.volts_at_full_scale
            device = Limits(peak_voltage_v=None if full is None else abs(full))
            limits = strictest(limits, limits_of(wired), device)
        channels.append(
            RigChannel(place=at, output=at, model=actuator.model, full_scale_v=1.0, limits=limits)
        )
        volts.append(equalised(drive, rate_hz, actuator.model, equaliser, band_hz=band_hz))
    return highest_gain(Rig(channels=tuple(channels)), list(drives), volts, round(rate_hz))
