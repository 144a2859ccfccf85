"""Four synthetic limbs that need no measured data: dispersive surface waves on the drawn hand.

A short pulse starts a wave in soft skin; it travels along paths inside the hand, and loses
amplitude at the joints that it crosses.

Hands and forearms are drawn in ``data/hands``, one file for each limb.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.base.assets import data_folder
from skinsource.base.conventions import (
    N_AXES,
    N_INPUTS,
    N_OUTPUTS,
    N_TAPS,
    SAMPLE_RATE_HZ,
    VOLAR_OUTPUTS,
    Complexes,
    Floats,
)
from skinsource.limbs.limb import Limb, LimbMap, limb_like
from skinsource.limbs.locations import ARM_REGIONS, DIGITS, INPUTS, OUTPUTS

#: Outline pixels in one hand length.
HAND_LENGTH_PX = 400.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandShape:
    """A right hand and arm seen from the back, in outline pixels, x right, y up, thumb left.

    Attributes
    ----------
    outline : (n_vertices, 2)
        Closed simple polygon, counter-clockwise, last vertex not repeated.
    input_positions : (20, 2)
        Input places, seen through the hand.
    output_positions : (72, 2)
        Sensors; the six volar ones seen through the arm.
    digit_axes
        For digits I to V the base knuckle, joints and tip, (3, 2) for the thumb, else (4, 2).
    wrist : (2,)
        Middle of the wrist.
    wrist_ends : (2, 2)
        Radial and ulnar end of the wrist line.
    creases
        Lines of a palmar drawing: fingers, palm, wrist; open polylines (n, 2).  Of hand 1, which
        the studio shows.
    """

    outline: Floats
    input_positions: Floats
    output_positions: Floats
    digit_axes: tuple[Floats, ...]
    wrist: Floats
    wrist_ends: Floats
    creases: tuple[Floats, ...]

    def limb_map(self) -> LimbMap:
        """Return the part of this drawing that a `Limb` carries."""
        outputs = self.output_positions.copy()
        outputs[np.array(VOLAR_OUTPUTS) - 1] = np.nan
        return LimbMap(
            outline=self.outline,
            output_positions=_read_only(outputs),
            input_positions=self.input_positions,
            hand_length_px=HAND_LENGTH_PX,
        )


@cache
def drawn_hand(number: int) -> HandShape:
    """Return the hand of synthetic limb 1 to 4; its arrays cannot be written to."""
    text = (data_folder() / "hands" / f"{number}.json").read_text(encoding="utf-8")
    drawing = json.loads(text)
    return HandShape(
        outline=_read_only(drawing["outline"]),
        input_positions=_read_only(drawing["input_positions"]),
        output_positions=_read_only(drawing["output_positions"]),
        digit_axes=tuple(map(_read_only, drawing["digit_axes"])),
        wrist=_read_only(drawing["wrist"]),
        wrist_ends=_read_only(drawing["wrist_ends"]),
        creases=tuple(map(_read_only, drawing.get("creases", ()))),
    )


def _read_only(points: Any) -> Floats:
    array: Floats = np.array(points, np.float64)
    array.flags.writeable = False
    return array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Paths:
    """Paths from every input to every output.

    Attributes
    ----------
    lengths_px : (20, 72)
        Along the hand: a wave leaves a digit through its base knuckle and reaches the arm
        through the wrist.
    knuckles : (20, 72)
        How many base knuckles are crossed: 0, 1 or 2.
    wrists : (20, 72)
        Whether the wrist is crossed: 0 or 1.
    """

    lengths_px: Floats
    knuckles: Floats
    wrists: Floats


def paths_in(shape: HandShape) -> Paths:
    """Return the paths between all places of a hand."""
    outputs = shape.output_positions
    digit_in = _digits([place.region for place in INPUTS])
    digit_out = _digits([place.region for place in OUTPUTS])
    on_arm = np.array([place.region in ARM_REGIONS for place in OUTPUTS])
    bases = np.array([axis[0] for axis in shape.digit_axes])

    leave = np.where((digit_in >= 0)[:, None], bases[digit_in], shape.input_positions)
    enter = np.where((digit_out >= 0)[:, None], bases[digit_out], outputs)
    first = _distances(shape.input_positions, leave)
    last = _distances(outputs, enter)
    across = _path_lengths(leave, enter, on_arm, shape.wrist_ends)
    lengths = first[:, None] + across + last[None, :]

    same = (digit_in[:, None] == digit_out[None, :]) & (digit_in >= 0)[:, None]
    direct = _distances(shape.input_positions[:, None], outputs[None, :])
    crossings = (digit_in >= 0)[:, None].astype(float) + (digit_out >= 0)[None, :]
    return Paths(
        lengths_px=np.where(same, direct, lengths),
        knuckles=np.where(same, 0.0, crossings),
        wrists=np.broadcast_to(on_arm.astype(float), (N_INPUTS, N_OUTPUTS)),
    )


def _digits(regions: list[str]) -> NDArray[np.int64]:
    """Return the digit (0 to 4) of each region, -1 for the hand and the arm."""
    names = [f"digit {digit}" for digit in DIGITS]
    return np.array([names.index(region) if region in names else -1 for region in regions])


def _distances(start: Floats, stop: Floats) -> Floats:
    return np.asarray(np.linalg.norm(stop - start, axis=-1))


def _path_lengths(leave: Floats, enter: Floats, on_arm: NDArray[np.bool_], ends: Floats) -> Floats:
    """Return lengths, (20, 72): straight in the hand, to the arm through the wrist."""
    start, stop = leave[:, None, :], enter[None, :, :]
    straight = _distances(start, stop)
    # The wrist line is level, so a straight line crosses it at this share of its height.
    level = ends[0, 1]
    drop = np.where(on_arm, start[..., 1] - stop[..., 1], 1.0)
    share = (start[..., 1] - level) / drop
    x = np.clip(start[..., 0] + share * (stop[..., 0] - start[..., 0]), ends[0, 0], ends[1, 0])
    gate = np.stack([x, np.full_like(x, level)], axis=-1)
    return np.where(on_arm, _distances(start, gate) + _distances(gate, stop), straight)


# Rayleigh waves in an incompressible half-space run at this share of the shear speed.
_RAYLEIGH_SHARE = 0.955
# The pulse is made at this multiple of the sample rate, so that filters stay causal.
_OVERSAMPLING = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class Skin:
    """Fractional Voigt skin: shear modulus mu0 + mu1 (i w / w0)^a.

    Attributes
    ----------
    static_shear_modulus_pa, rising_shear_modulus_pa
        mu0 and mu1.
    exponent, reference_frequency_hz
        a and w0 / 2 pi.
    density_kg_m3
        Mass per volume.
    """

    static_shear_modulus_pa: float
    rising_shear_modulus_pa: float
    exponent: float
    reference_frequency_hz: float
    density_kg_m3: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Pulse:
    """The short knock that starts a wave.

    Attributes
    ----------
    width_ms, delay_ms
        Width of the rectangle; time of its centre, before the filters delay it further.
    low_pass_hz, low_pass_order, high_pass_hz, high_pass_order
        Causal Butterworth filters.
    """

    width_ms: float
    delay_ms: float
    low_pass_hz: float
    low_pass_order: int
    high_pass_hz: float
    high_pass_order: int


def wavenumber(frequency_hz: Floats, skin: Skin) -> Complexes:
    """Return the complex wavenumber k of a surface wave, rad/m, shaped as ``frequency_hz``.

    With time dependence exp(+i w t) a wave is exp(-i k r); the imaginary part is negative, so
    waves decay.  k(w) = w / (0.955 sqrt(mu(w) / rho)), mu(w) a fractional Voigt modulus, whose
    fit to skin is described by Kearney et al. (2015).
    """
    ratio = 1j * np.asarray(frequency_hz) / skin.reference_frequency_hz
    modulus = skin.static_shear_modulus_pa + skin.rising_shear_modulus_pa * ratio**skin.exponent
    speed = _RAYLEIGH_SHARE * np.sqrt(modulus / skin.density_kg_m3)
    return np.asarray(2 * np.pi * np.asarray(frequency_hz) / speed)


def pulse_spectrum(pulse: Pulse, n_times: int, sample_rate_hz: float) -> Complexes:
    """Return the one-sided spectrum of the sampled pulse, (n_times // 2 + 1,).

    The filters act on the continuous pulse and the result is then sampled, which keeps silence
    before the pulse; filtering forwards and backwards would ring before it.
    """
    n_fine = n_times * _OVERSAMPLING
    frequency = scipy.fft.rfftfreq(n_fine, 1 / (sample_rate_hz * _OVERSAMPLING))
    s: Complexes = np.asarray(1j * frequency, dtype=np.complex128)
    low = _butterworth(s / pulse.low_pass_hz, pulse.low_pass_order)
    # A high pass is a low pass of the inverse frequency; nothing passes at zero.
    high = np.zeros_like(low)
    high[1:] = _butterworth(pulse.high_pass_hz / s[1:], pulse.high_pass_order)
    width_s, delay_s = pulse.width_ms / 1e3, pulse.delay_ms / 1e3
    turn = np.exp(-2j * np.pi * frequency * delay_s)
    fine = scipy.fft.irfft(np.sinc(frequency * width_s) * low * high * turn, n_fine)
    return np.asarray(scipy.fft.rfft(fine[::_OVERSAMPLING]))


def _butterworth(s: Complexes, order: int) -> Complexes:
    """Return the analogue low-pass prototype with its edge at |s| = 1, same shape as ``s``."""
    angles = np.pi * (2 * np.arange(order) + 1) / (2 * order) + np.pi / 2
    denominator = np.ones_like(s)
    for pole in np.exp(1j * angles):
        denominator *= s - pole
    return 1 / denominator


def bending_boost(frequency_hz: Floats, mode_hz: Floats, gain: float, quality: float) -> Complexes:
    """Return the resonance added by a bending digit, (n_modes, n_frequencies).

    gain wm^2 / (wm^2 - w^2 + i w wm / Q), a damped oscillator: causal.
    """
    ratio = np.asarray(frequency_hz)[None, :] / np.asarray(mode_hz)[:, None]
    return np.asarray(gain / (1 - ratio**2 + 1j * ratio / quality))


# Long enough that ringing past the last tap does not wrap round to the first.
_N_FFT = 1024
# The level of all inputs is such that this one, the pad of digit III, reaches a given peak.
_REFERENCE_INPUT = 8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SyntheticModel:
    """Everything a response needs that does not depend on the input place.

    Attributes
    ----------
    shape
        The drawn hand.
    hand_length_mm
        Size of the hand.
    pulse : (n_frequencies,)
        Spectrum of the input pulse, scaled to m/s².
    wavenumber_rad_m : (n_frequencies,)
        Complex.
    bending : (72, n_frequencies)
        Resonance at each output.
    bending_share, path_m, amplitude : (20, 72)
        How far the resonance is built up; length of the path with its depth; loss at joints and
        by spreading.
    normal : (20,)
        Share of the motion along z, against 1 along the skin.
    direction_rad : (72,)
        Direction of x and y at each output: the sensors are not aligned.
    """

    shape: HandShape
    hand_length_mm: float
    pulse: Complexes
    wavenumber_rad_m: Complexes
    bending: Complexes
    bending_share: Floats
    path_m: Floats
    amplitude: Floats
    normal: Floats
    tangential: float
    direction_rad: Floats

    def response_to(self, location: int) -> Floats:
        """Return the responses to one input place, (72 outputs, 3 axes, 522 taps), in m/s².

        S(w) sqrt(r0 / (r0 + r)) exp(-i k r) 10^(-L/20) B(w), split over the axes.
        """
        row = location - 1
        wave = np.exp(-1j * self.wavenumber_rad_m * self.path_m[row][:, None])
        wave *= self.pulse
        wave *= 1 + self.bending * self.bending_share[row][:, None]
        wave *= self.amplitude[row][:, None]
        normal = scipy.fft.irfft(wave, _N_FFT)[:, :N_TAPS]
        # A quarter of a period between the motions: particles go round in ellipses.
        tangential = self.tangential * scipy.fft.irfft(1j * wave, _N_FFT)[:, :N_TAPS]
        response = np.empty((N_OUTPUTS, N_AXES, N_TAPS))
        response[:, 0] = np.cos(self.direction_rad)[:, None] * tangential
        response[:, 1] = np.sin(self.direction_rad)[:, None] * tangential
        response[:, 2] = self.normal[row] * normal
        return response


@cache
def synthetic_model(number: int) -> SyntheticModel:
    """Prepare synthetic limb 1 to 4 from the shipped parameters; its arrays cannot be written."""
    shared = _parameters()
    limb = next(entry for entry in shared["limbs"] if entry["number"] == number)
    model = _prepare(shared, limb)
    for field in fields(model):
        value = getattr(model, field.name)
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return model


@cache
def _parameters() -> dict[str, Any]:
    text = (data_folder() / "synthetic-limbs.json").read_text(encoding="utf-8")
    return json.loads(text)


def _prepare(shared: Mapping[str, Any], limb: Mapping[str, Any]) -> SyntheticModel:
    shape = drawn_hand(limb["number"])
    skin = Skin(**shared["skin"])
    stiffness = skin.rising_shear_modulus_pa * limb["shear_factor"]
    skin = replace(skin, rising_shear_modulus_pa=stiffness)
    random = np.random.default_rng(limb["seed"])
    bending, spreading = shared["bending"], shared["spreading"]
    spread = random.uniform(-1, 1, N_OUTPUTS) * bending["frequency_spread"]
    mode_hz = bending["frequency_hz"] * limb["bending_factor"] * (1 + spread)

    paths = paths_in(shape)
    along_mm = paths.lengths_px * limb["hand_length_mm"] / HAND_LENGTH_PX
    on_palm = np.array([place.region == "hand" for place in INPUTS])
    depth_mm = np.where(on_palm, spreading["palm_depth_mm"], spreading["digit_depth_mm"])
    path_mm = np.hypot(along_mm, depth_mm[:, None])
    loss_db = limb["losses"]["knuckle_db"] * paths.knuckles
    loss_db = loss_db + limb["losses"]["wrist_db"] * paths.wrists
    radius_mm = spreading["source_radius_mm"]
    amplitude = np.sqrt(radius_mm / (radius_mm + path_mm)) * 10 ** (-loss_db / 20)

    frequency_hz = scipy.fft.rfftfreq(_N_FFT, 1 / SAMPLE_RATE_HZ)
    polarisation = shared["polarisation"]
    in_axis = np.array([place.contact == "in-axis" for place in INPUTS])
    model = SyntheticModel(
        shape=shape,
        hand_length_mm=limb["hand_length_mm"],
        pulse=pulse_spectrum(Pulse(**shared["pulse"]), _N_FFT, SAMPLE_RATE_HZ),
        wavenumber_rad_m=wavenumber(frequency_hz, skin),
        bending=bending_boost(frequency_hz, mode_hz, bending["gain"], bending["quality"]),
        bending_share=np.clip((along_mm - bending["from_mm"]) / bending["over_mm"], 0, 1),
        path_m=path_mm / 1e3,
        amplitude=amplitude,
        normal=np.where(
            in_axis, polarisation["in_axis_normal"], polarisation["perpendicular_normal"]
        ),
        tangential=polarisation["tangential"],
        direction_rad=random.uniform(0, 2 * np.pi, N_OUTPUTS),
    )
    reference = model.response_to(_REFERENCE_INPUT)
    scale = shared["peak_of_input_8_m_s2"] / np.abs(reference).max()
    return replace(model, pulse=model.pulse * scale)


def load_synthetic_limb(number: int) -> Limb:
    """Return synthetic limb ``number``, 1 to 4, named "synthetic-1" to "synthetic-4".

    Responses are computed when touched, one input place at a time, without noise; the same
    numbers come out at every load.
    """
    model = synthetic_model(number)
    return Limb(
        name=f"synthetic-{number}",
        hand_length_mm=model.hand_length_mm,
        synthetic=True,
        map=model.shape.limb_map(),
        read_response=model.response_to,
    )


def synthetic_person(number: int, *, hand_length_mm: float, seed: int) -> Limb:
    """Return a limb that is like synthetic limb ``number``, but somebody else's.

    Its size and all that is drawn at random are other ones: the resonances, and the directions of
    the sensors.

    Parameters
    ----------
    hand_length_mm
        Size of the hand, which is drawn as that of the limb.
    seed
        Of what is drawn at random.
    """
    shared = _parameters()
    limb = next(entry for entry in shared["limbs"] if entry["number"] == number)
    model = _prepare(shared, limb | {"hand_length_mm": hand_length_mm, "seed": seed})
    return limb_like(
        load_synthetic_limb(number),
        hand_length_mm=hand_length_mm,
        read_response=model.response_to,
        note="A stand-in person, not measured.",
    )
