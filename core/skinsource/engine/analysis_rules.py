"""Rules for the panels of analysis: actuators, noise, single axes, outputs, sensation and more."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np
import scipy

from skinsource.actuators.actuation import Actuation, ActuatorProfile, transfers_of
from skinsource.actuators.rigs import Rig, limits_of
from skinsource.base.conventions import Band, Floats
from skinsource.base.job import Stop, stop_if
from skinsource.design.panel_settings import SpectrogramSettings
from skinsource.design.signal_path import Drive, UnplayableInput, Voice, unplayable_text
from skinsource.engine import level_rules
from skinsource.engine.actuator_demand import Demand, actuator_at, demand_of, profile_of
from skinsource.engine.gains import Placed, Responses
from skinsource.engine.moments import Moments, Projection
from skinsource.engine.spectra import TotalSpectrum
from skinsource.engine.streaming import StreamedVibration, Vibration, loudest_energies
from skinsource.engine.transforms import Played, forward
from skinsource.limbs.limb import PUBLISHED, Limb
from skinsource.limbs.scaling import Scaling, per_probe_acceleration
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.perception.thresholds import (
    CHANNELS,
    PerceptionSettings,
    sensation_magnitude,
    site_offsets_db,
    table_threshold,
    threshold_rms,
    weighted_rms,
)
from skinsource.perception.validity import (
    SPATIAL_LIMIT_HZ,
    Finding,
    Findings,
    are_probe_accelerations,
    drive_findings,
    fastest_probe,
    noise_findings,
    setup_findings,
)
from skinsource.signals.analysis.noise import (
    LEAST_ABOVE_NOISE_DB,
    noise_rms,
    predicted_noise_energy,
    tells_noise,
    windowed_noise_energy,
)
from skinsource.signals.analysis.spectrogram import Spectrogram, spectrogram
from skinsource.signals.analysis.statistics import (
    Statistics,
    band_rms,
    crest_factor,
    dominant_frequency,
    onset_time,
)
from skinsource.signals.analysis.transfer import Transfer, transfer_function
from skinsource.signals.analysis.wave_speed import (
    TravellingWave,
    line_distances_mm,
    straightness,
    travelling_wave,
)
from skinsource.signals.analysis.windows import Windows
from skinsource.signals.loudest_window import Span, window_samples
from skinsource.signals.projection import MainAxes, main_axes
from skinsource.signals.resampling import peaks_between


def actuator_looked_at(
    chosen_actuation: Actuation | None, rig: Rig | None, actuator_demand: Demand
) -> ActuatorProfile | None:
    """The actuator of the demand, with the limits that it has in the rig; None: none is chosen."""
    if chosen_actuation is None:
        return None
    place = actuator_demand.place
    shown = profile_of(actuator_at(chosen_actuation, place))
    channel = None if rig is None or place is None else rig.channel_of(place)
    return shown if channel is None else replace(shown, limits=limits_of(channel))


def actuator_demand(
    sampled_voices: tuple[Placed, ...],
    selected_input: int | None,
    sample_rate_hz: float,
    band_hz: Band | None,
    scaling: Scaling,
    chosen_actuation: Actuation | None,
) -> Demand:
    """Demand on the actuator at the location of the selected input."""
    return demand_of(
        chosen_actuation, sampled_voices, selected_input, sample_rate_hz, band_hz, scaling=scaling
    )


def place_drives(
    responses: Responses, placed: tuple[Placed, ...], stop: Stop
) -> tuple[tuple[int, Floats], ...]:
    """Sum of all drives at each location, (location, (n_times,)), scaled as the responses are.

    In probe scaling that is the acceleration of the probe, m/s².
    """
    moving = responses.moving(placed, stop)
    length = max((player.end for player, _, _ in moving), default=0)
    played: dict[int, Floats] = {}
    for player, _, gain in moving:
        total = played.setdefault(player.voice.location, np.zeros(length))
        total[player.start : player.end] += player.voice.amplitude * gain * player.drive.samples
    return tuple(played.items())


def noise_energy(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
    match_gain: float,
) -> Floats | None:
    """Energy of the noise of the responses in the prediction, (n_outputs, n_axes).

    None in silence, and where the noise of a response is not known, see `place_noise`.
    """
    noise = _noise_of_places(place_drives, limb_data)
    if noise is None:
        return None
    energies = {}
    for location, played in place_drives:
        path = _noise_path(limb_data, scaling, actuation, location)
        shaped = scipy.signal.oaconvolve(played, path)
        energies[location] = float(np.vecdot(shaped, shaped))
    return match_gain**2 * predicted_noise_energy(energies, noise, limb_data.n_taps)


def output_noise_rms(
    noise_energy: Floats | None, projection: Projection, record_samples: int
) -> Floats | None:
    """RMS of the noise in each projected signal over the whole record, (n_outputs,)."""
    if noise_energy is None:
        return None
    return _projected_rms(noise_energy, projection, record_samples)


def above_noise_db(record_rms: Floats, output_noise_rms: Floats | None) -> Floats | None:
    """Level of each output above that of its noise, (n_outputs,), dB; None: it is not known."""
    if output_noise_rms is None:
        return None
    ratio = np.divide(
        record_rms, output_noise_rms, out=np.zeros_like(record_rms), where=output_noise_rms > 0.0
    )
    with np.errstate(divide="ignore"):
        return np.maximum(20.0 * np.log10(ratio), -200.0)


def place_noise(limb: Limb, location: int) -> Floats | None:
    """Return the RMS of the noise in responses to a location, (n_outputs, n_axes), or None.

    Synthetic limbs have no noise, and some imported limbs too few samples before the pulse.
    """
    rate, before_s = limb.sample_rate_hz, limb.pre_trigger_delay_s
    if limb.synthetic or not tells_noise(rate, before_s):
        return None
    return noise_rms(limb.response_to(location), rate, before_s)


@lru_cache(maxsize=8)
def _inverse_pulse(n_taps: int, sample_rate_hz: float) -> Floats:
    pulse = np.zeros(n_taps)
    pulse[n_taps // 2] = 1.0
    inverse_pulse = per_probe_acceleration(pulse, sample_rate_hz)
    inverse_pulse.flags.writeable = False
    return inverse_pulse


def _noise_of_places(
    place_drives: tuple[tuple[int, Floats], ...], limb: Limb
) -> dict[int, Floats] | None:
    """Return the noise by location that plays; None where none plays, or a noise is not known."""
    noise_by_place = {location: place_noise(limb, location) for location, _ in place_drives}
    noise = {location: rms for location, rms in noise_by_place.items() if rms is not None}
    return noise if noise and len(noise) == len(noise_by_place) else None


def _projected_rms(energy: Floats, projection: Projection, n_times: int) -> Floats:
    """Return the RMS over ``n_times`` along a projection, from energies of axes, (..., n_axes)."""
    chosen = energy[..., list(projection.axis_numbers)]
    if projection.directions is not None:
        chosen = chosen * np.square(projection.directions)
    return np.sqrt(chosen.sum(axis=-1) / n_times)


def _divided_by_pulse(limb: Limb, scaling: Scaling) -> bool:
    """Return whether responses, and their noise, are divided by the measuring pulse."""
    return scaling == "probe" and not limb.per_unit_drive


def _noise_path(limb: Limb, scaling: Scaling, actuation: Actuation | None, location: int) -> Floats:
    """Return the impulse response of the path of the noise in responses to a location, (n,).

    In probe scaling that is the inverse pulse, with its middle at half of its length.  Through an
    actuator it is followed by the impulse response of equaliser and actuator.
    """
    rate = limb.sample_rate_hz
    path = np.ones(1)
    if _divided_by_pulse(limb, scaling):
        path = _inverse_pulse(limb.n_taps, rate)
    if actuation is None:
        return path
    transfers = transfers_of(actuation, rate, limb.band_hz)
    return scipy.signal.oaconvolve(path, transfers[actuation.at(location).place].samples)


def single_axes(limb_data: Limb) -> tuple[Projection, ...]:
    """Projections on each axis of the limb by itself, whatever axes are chosen."""
    along = np.ones((limb_data.n_outputs, 1))
    return tuple(Projection((number,), along) for number in range(limb_data.n_axes))


def axis_record_rms(
    single_axes: tuple[Projection, ...],
    moments: Moments,
    total_spectrum: TotalSpectrum | None,
    record_samples: int,
) -> tuple[Floats, ...]:
    """RMS over the whole record along each axis, (n_outputs,) each, in m/s²."""
    return tuple(
        level_rules.record_rms(moments, axis, total_spectrum, record_samples)
        for axis in single_axes
    )


def axis_levels_db(
    single_axes: tuple[Projection, ...],
    axis_record_rms: tuple[Floats, ...],
    span: Span,
    limb_data: Limb,
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    stop: Stop,
) -> tuple[Floats, ...]:
    """RMS level along each axis, (n_outputs,) each, in dB re 1 m/s², as if it were chosen alone."""
    levels_db = []
    for axis, record in zip(single_axes, axis_record_rms, strict=True):
        loudest = level_rules.loudest_rms(
            span, limb_data, axis, total_spectrum, streamed_vibration, stop
        )
        levels_db.append(level_rules.output_levels_db(level_rules.output_rms(record, loudest)))
    return tuple(levels_db)


def axis_surface_levels_db(
    surface: SurfaceOperator, axis_levels_db: tuple[Floats, ...]
) -> tuple[Floats, ...]:
    """The same over the back of hand and arm, (rows, columns) each; NaN outside the outline."""
    return tuple(surface.interpolate(levels) for levels in axis_levels_db)


def axis_above_noise_db(
    single_axes: tuple[Projection, ...],
    axis_record_rms: tuple[Floats, ...],
    noise_energy: Floats | None,
    record_samples: int,
) -> tuple[Floats | None, ...]:
    """Level along each axis above that of its noise, (n_outputs,) each, dB; None: not known."""
    return tuple(
        above_noise_db(record, output_noise_rms(noise_energy, axis, record_samples))
        for axis, record in zip(single_axes, axis_record_rms, strict=True)
    )


def stimulus_start_s(placed: tuple[Placed, ...], sample_rate_hz: float) -> float:
    """Start of the first audible input, s; 0 where there is none."""
    return min((player.start for player in placed if player.moves), default=0) / sample_rate_hz


def output_statistics(
    axis_traces: Floats,
    selected_traces: Floats,
    selected_projection: Projection,
    shown_outputs: tuple[int, ...],
    output_rms: Floats,
    response_time_s: Floats,
    stimulus_start_s: float,
    sample_rate_hz: float,
    stop: Stop,
) -> Statistics:
    """Figures of the selected outputs; the RMS is that of the map.

    Delays count from the start of the first input.  The dominant frequency is that of the motion
    along the chosen axes, as a magnitude is rectified and has twice that frequency.
    """
    rms = output_rms[[output - 1 for output in shown_outputs]]
    peak = peaks_between(selected_projection.waves(axis_traces, selected_traces), stop=stop)
    n_times = selected_traces.shape[-1]
    dominant_hz = np.empty(len(shown_outputs))
    for row, traces in enumerate(axis_traces):
        stop_if(stop)
        spectra = forward(traces, n_times)
        if selected_projection.directions is None:
            power = np.sum(np.square(np.abs(spectra)), axis=0)
        else:
            power = np.square(np.abs(selected_projection.directions[row] @ spectra))
        dominant_hz[row] = dominant_frequency(power, sample_rate_hz / n_times)
    return Statistics(
        rms=rms,
        peak=peak,
        crest=crest_factor(peak, rms),
        dominant_hz=dominant_hz,
        delay_s=onset_time(selected_traces, response_time_s) - stimulus_start_s,
    )


def spectrogram_output(
    shown_outputs: tuple[int, ...], spectrogram_settings: SpectrogramSettings
) -> int:
    """Output of the spectrogram; 0 where none is selected."""
    chosen = spectrogram_settings.output
    return chosen if chosen in shown_outputs else (shown_outputs or (0,))[-1]


def spectrogram_window_s(spectrogram_settings: SpectrogramSettings) -> float:
    """Length of the window of the spectrogram."""
    return spectrogram_settings.window_s


def output_spectrogram(
    selected_traces: Floats,
    shown_outputs: tuple[int, ...],
    spectrogram_output: int,
    spectrogram_window_s: float,
    sample_rate_hz: float,
    stop: Stop,
) -> Spectrogram | None:
    """Spectrogram of one of the selected outputs; None where none is selected."""
    if not spectrogram_output:
        return None
    row = selected_traces[shown_outputs.index(spectrogram_output)]
    return spectrogram(row, sample_rate_hz, spectrogram_window_s, stop)


def output_band_rms(
    vibration: Vibration,
    axis_numbers: tuple[int, ...],
    limb_data: Limb,
    sample_rate_hz: float,
    record_samples: int,
    stop: Stop,
) -> tuple[Floats, Floats] | None:
    """Middles of bands of 2 Hz, Hz, and RMS of outputs in each, (n_outputs, n_axes, n_bins), m/s².

    See `band_rms`; over the record of levels.  None for a vibration that is too long to be
    transformed at once.
    """
    if vibration.streamed is not None:
        return None
    outputs = tuple(range(1, limb_data.n_outputs + 1))
    transforms = vibration.transforms(outputs, axis_numbers, stop)
    frequency_hz, rms = band_rms(transforms, vibration.n_times, sample_rate_hz, limb_data.band_hz)
    return frequency_hz, rms * np.sqrt(vibration.n_times / record_samples)


def output_main_axes(axis_traces: Floats, axis_numbers: tuple[int, ...]) -> MainAxes | None:
    """Direction in which each selected output moves most; None where a single axis is chosen."""
    return main_axes(axis_traces) if len(axis_numbers) > 1 else None


#: Level of an output without sensation.
SILENT_DB = -200.0
_NO_SCALE = "Sensation levels need accelerations: choose the scaling Probe acceleration"
_NO_SITES = "Which outputs lie on hairy skin is known only for the published limbs"
_OWN = "own"
# Padding before and after a drive, into which a weighted drive rings.
_ROOM_S = 0.2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sensation:
    """Levels above the detection threshold, of the loudest 100 ms.

    Attributes
    ----------
    by_channel
        For ``"P"`` and ``"NP I"``, or for ``"own"`` thresholds: (n_outputs,), dB.
    level_db : (n_outputs,)
        The highest level of all channels.
    strength : (n_outputs,) or None
        See `skinsource.perception.sensation_magnitude`; None for thresholds of one's own.
    problem
        Why there are no levels; "" where there are.
    band_hz
        Frequencies that count: those at which the limb was measured, or, where they are not known,
        those of one's own thresholds.
    """

    by_channel: Mapping[str, Floats]
    level_db: Floats
    strength: Floats | None = None
    problem: str = ""
    band_hz: Band | None = None


def sensation(
    perception_settings: PerceptionSettings,
    total_spectrum: TotalSpectrum | None,
    streamed_vibration: StreamedVibration | None,
    limb_data: Limb,
    scaling: Scaling,
    stop: Stop,
) -> Sensation:
    """Level of each output above thresholds; energies add up over axes and frequencies."""
    table = perception_settings.thresholds
    problem = _problem_text(limb_data, scaling, own_thresholds=bool(table))
    if problem:
        return Sensation(by_channel={}, level_db=np.zeros(0), problem=problem)
    rate = limb_data.sample_rate_hz
    band_hz = limb_data.band_hz or (table[0][0], table[-1][0])
    offsets: dict[Any, Floats] = {} if table else {**site_offsets_db(limb_data.name)}
    levels_db: dict[Any, Floats] = {}
    every = Projection(tuple(range(limb_data.n_axes)), None)
    for channel in (_OWN,) if table else CHANNELS:
        weights = partial(_weights, channel=channel, settings=perception_settings, band_hz=band_hz)
        total, streamed = total_spectrum, streamed_vibration
        if streamed is not None:
            streamed = streamed.played_through(partial(_filtered, weights=weights, rate=rate))
        elif total is not None:
            total = total.times(weights(_bins_hz(total.n_fft, rate)))
        energy = loudest_energies(total, streamed, every, limb_data, stop)
        with np.errstate(divide="ignore"):
            level = 10.0 * np.log10(energy / window_samples(rate))
        levels_db[channel] = np.maximum(level - offsets.get(channel, 0.0), SILENT_DB)
    return Sensation(
        by_channel=levels_db,
        level_db=np.array(list(levels_db.values())).max(axis=0),
        strength=None if table else sensation_magnitude(levels_db),
        band_hz=band_hz,
    )


def sensation_db(sensation: Sensation) -> Floats:
    """Level of each output above threshold, (n_outputs,), dB; empty where it is not known."""
    return sensation.level_db


def surface_sensation_db(surface: SurfaceOperator, sensation_db: Floats) -> Floats | None:
    """Level above threshold over the back of hand and arm, (rows, columns)."""
    return surface.interpolate(sensation_db) if sensation_db.size else None


def contact_weighted_rms(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
) -> tuple[tuple[int, float], ...] | None:
    """Acceleration of each probe, weighted with Wh of ISO 5349-1, RMS while it moves, m/s².

    None where drives are not accelerations.
    """
    if not are_probe_accelerations(limb_data, scaling, actuated=actuation is not None):
        return None
    return tuple(
        (location, weighted_rms(np.trim_zeros(played), limb_data.sample_rate_hz))
        for location, played in place_drives
        if played.any()
    )


def _problem_text(limb: Limb, scaling: Scaling, *, own_thresholds: bool) -> str:
    if scaling != "probe":
        return _NO_SCALE
    # Another limb may have as many outputs at other positions.
    return _NO_SITES if limb.name not in PUBLISHED and not own_thresholds else ""


def _weights(
    frequency_hz: Floats,
    channel: str,
    settings: PerceptionSettings,
    band_hz: Band,
) -> Floats:
    """Return one over the threshold within the band, else 0: nothing was measured there."""
    low, high = band_hz
    inside = (frequency_hz >= low) & (frequency_hz <= high)
    at = np.where(inside, frequency_hz, low)
    if channel == _OWN:
        threshold = table_threshold(settings.thresholds, at)
    elif channel == "P":
        threshold = threshold_rms(at, "P", area_cm2=settings.area_cm2)
    else:
        threshold = threshold_rms(at, "NP I")
    return np.where(inside, 1.0 / threshold, 0.0)


def _filtered(played: Played, weights: Callable[[Floats], Floats], rate: float) -> Played:
    """Return the drive after a weighting; it begins a little earlier and ends later."""
    room = round(_ROOM_S * rate)
    samples = np.pad(played.drive.samples, room)
    n_fft = scipy.fft.next_fast_len(samples.size, real=True)
    frequency_hz = _bins_hz(n_fft, rate)
    weighted = scipy.fft.irfft(scipy.fft.rfft(samples, n_fft) * weights(frequency_hz), n_fft)
    first = played.start - room
    weighted = weighted[max(-first, 0) : samples.size]
    return replace(played, drive=Drive(weighted, played.drive.factor), start=max(first, 0))


def _bins_hz(n_fft: int, rate: float) -> Floats:
    return np.arange(n_fft // 2 + 1, dtype=np.float64) * (rate / n_fft)


def validity(
    place_drives: tuple[tuple[int, Floats], ...],
    above_noise_db: Floats | None,
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
    unplayable_inputs: tuple[UnplayableInput, ...],
) -> Findings:
    """Conditions of the measurement, and whether the prediction meets them."""
    synthetic, published = limb_data.synthetic, limb_data.name in PUBLISHED
    note = limb_data.note if published else ""
    places = [location for location, _ in place_drives]
    return (
        *_left_out(unplayable_inputs),
        *drive_findings(
            place_drives,
            limb_data.sample_rate_hz,
            scaling,
            probe=actuation is None,
            unit_known=not limb_data.per_unit_drive,
            band_hz=limb_data.band_hz,
            # The limit holds for the output positions of the published limbs only.
            spatial_limit_hz=SPATIAL_LIMIT_HZ if published else None,
        ),
        noise_findings(above_noise_db, synthetic=synthetic, silent=not place_drives),
        *setup_findings(synthetic=synthetic, scaling=scaling, places=places, note=note),
    )


def fastest_probe_m_per_s(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
) -> float | None:
    """Largest velocity of any probe, m/s; None: not known, or actuators replace the probes."""
    if not are_probe_accelerations(limb_data, scaling, actuated=actuation is not None):
        return None
    drives = [samples for _, samples in place_drives]
    return fastest_probe(drives, limb_data.sample_rate_hz, limb_data.band_hz)


def _left_out(unplayable: tuple[UnplayableInput, ...]) -> Findings:
    """Return the finding that a prediction leaves inputs out, if it does."""
    text = unplayable_text(unplayable)
    if not text:
        return ()
    sentence = f"{text} The prediction leaves out inputs that cannot be played."
    return (Finding(name="inputs", state="left", sentence=sentence, in_short=sentence),)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LineWave:
    """A wave along the selected outputs.

    Attributes
    ----------
    outputs
        Outputs with a position on the map, in the order in which they were selected.
    wave
        Delays and levels of the wave along ``axis``.
    axis
        ``"z"``, or the last axis of a limb that has no z.
    """

    outputs: tuple[int, ...]
    wave: TravellingWave
    axis: str = "z"


def transfer_place(voices: tuple[Voice, ...], selected_input: int | None) -> int:
    """Input location of the transfer function: that of the selected input, or of the first.

    0 where there is no input.
    """
    chosen = next((voice.location for voice in voices if voice.id == selected_input), None)
    return chosen or next((voice.location for voice in voices), 0)


def transfer(
    limb_data: Limb,
    driven_limb: Limb,
    transfer_place: int,
    shown_outputs: tuple[int, ...],
    axis_numbers: tuple[int, ...],
    scaling: Scaling,
    actuation: Actuation | None,
) -> Transfer | None:
    """Transfer function from one input location to the selected outputs; None without either.

    In probe scaling it is per m/s² of the probe, otherwise per sample of 1 of the drive.
    """
    if not (transfer_place and shown_outputs):
        return None
    rows = [output - 1 for output in shown_outputs]
    rate, n_taps = driven_limb.sample_rate_hz, driven_limb.n_taps
    response = driven_limb.response_to(transfer_place)[rows][:, list(axis_numbers)]
    if _divided_by_pulse(driven_limb, scaling):
        response = per_probe_acceleration(response, rate)
    noise = place_noise(limb_data, transfer_place)
    sigma = np.zeros(response.shape[:2]) if noise is None else noise[rows][:, list(axis_numbers)]
    path = _noise_path(limb_data, scaling, actuation, transfer_place)
    # Behind an actuator responses are longer than the measured, noisy part.
    share = limb_data.n_taps / n_taps
    gain = np.sqrt(share) * np.abs(scipy.fft.rfft(path, n_taps))
    return transfer_function(response, rate, sigma, gain, band_hz=driven_limb.band_hz)


def line_wave(
    vibration: Vibration,
    shown_outputs: tuple[int, ...],
    limb_data: Limb,
    above_noise_db: Floats | None,
    sample_rate_hz: float,
    record_samples: int,
    stop: Stop,
) -> LineWave | None:
    """Wave along the line of the selected outputs; None: fewer than two have a position.

    It is that along z, the only axis with the same meaning at every sensor.
    """
    limb_map = limb_data.map
    places = limb_map.output_positions
    outputs = tuple(k for k in shown_outputs if np.isfinite(places[k - 1]).all())
    if len(outputs) < 2:
        return None
    rows = [output - 1 for output in outputs]
    mm_per_px = limb_data.hand_length_mm / limb_map.hand_length_px
    # An imported limb may lack z: its last axis is taken.
    axis = limb_data.axes.index("z") if "z" in limb_data.axes else limb_data.n_axes - 1
    # Levels are over the record, whatever rings beyond it.
    over_record = np.sqrt(vibration.n_times / record_samples)
    traces = over_record * vibration.traces(outputs, (axis,), stop)[:, 0]
    trusted = None if above_noise_db is None else above_noise_db[rows] >= LEAST_ABOVE_NOISE_DB
    distance_mm = line_distances_mm(places[rows], mm_per_px)
    wave = travelling_wave(
        traces, distance_mm, sample_rate_hz, trusted, stop, straight=straightness(places[rows])
    )
    return LineWave(outputs=outputs, wave=wave, axis=limb_data.axes[axis])


_LEAST_RATIO = 10.0 ** (LEAST_ABOVE_NOISE_DB / 20.0)


def noise_rms_of_windows(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
    match_gain: float,
    projection: Projection,
    windows: Windows,
) -> Floats | None:
    """RMS of the noise in each projected signal in each window, (n_windows, n_outputs), m/s².

    None where the noise is not known, as for `noise_energy`.
    """
    noise = _noise_of_places(place_drives, limb_data)
    if noise is None:
        return None
    n_taps = limb_data.n_taps
    delay = n_taps // 2 if _divided_by_pulse(limb_data, scaling) else 0
    later = replace(windows, first_sample=windows.first_sample + delay)
    drives = {
        location: scipy.signal.oaconvolve(
            played, _noise_path(limb_data, scaling, actuation, location)
        )
        for location, played in place_drives
    }
    energy = windowed_noise_energy(drives, noise, n_taps, later)
    return match_gain * _projected_rms(energy, projection, windows.window_samples)


def noisy_outputs_of_windows(
    rms_of_windows: Floats, noise_rms_of_windows: Floats | None
) -> tuple[tuple[int, ...], ...]:
    """Outputs that are mostly noise in each window; none where the noise is not known."""
    if noise_rms_of_windows is None:
        return ((),) * len(rms_of_windows)
    noisy = rms_of_windows < _LEAST_RATIO * noise_rms_of_windows
    return tuple(tuple(int(k) + 1 for k in np.flatnonzero(row)) for row in noisy)


def windows_in_noise(
    rms_of_windows: Floats, noise_rms_of_windows: Floats | None, limb_data: Limb
) -> tuple[bool, ...]:
    """Whether all outputs on the map together are mostly noise in each window.

    The extent of such a window is that of the noise.
    """
    if noise_rms_of_windows is None:
        return (False,) * len(rms_of_windows)
    placed = np.isfinite(limb_data.map.output_positions[:, 0])
    signal, noise = (
        np.sqrt(np.sum(np.square(rms[:, placed]), axis=1))
        for rms in (rms_of_windows, noise_rms_of_windows)
    )
    return tuple(bool(below) for below in signal < _LEAST_RATIO * noise)
