"""Four invented limbs that need no measured data: dispersive waves on the drawn hand."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any

import numpy as np
import scipy

from skinsource.arrays import Complexes, Floats
from skinsource.errors import UnknownLimbError
from skinsource.files.assets import data_folder
from skinsource.hand.anatomy import HandProportions
from skinsource.hand.outline import HandShape, hand_shape
from skinsource.limb import N_AXES, N_OUTPUTS, N_TAPS, SAMPLE_RATE_HZ, Limb, check_input_location
from skinsource.locations import INPUTS
from skinsource.quoting import quoted
from skinsource.synthetic.geodesic import paths_in
from skinsource.synthetic.skin_model import (
    Pulse,
    Skin,
    bending_boost,
    pulse_spectrum,
    wavenumber,
)

#: Numbers of the built-in synthetic limbs.
SYNTHETIC_LIMBS = (1, 2, 3, 4)

# Long enough that what rings past the last tap does not come round to the first.
_N_FFT = 1024
# The level of all inputs is set so that this one, the pad of digit III, reaches a given peak.
_REFERENCE_INPUT = 8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SyntheticModel:
    """Everything a response needs that does not depend on the input place.

    Attributes
    ----------
    shape
        The drawn hand.
    hand_length_mm, seed
        Size of the hand; start of its random numbers.
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
    seed: int
    pulse: Complexes
    wavenumber_rad_m: Complexes
    bending: Complexes
    bending_share: Floats
    path_m: Floats
    amplitude: Floats
    normal: Floats
    tangential: float
    direction_rad: Floats

    def response_to(self, location: int, noise_rms_m_s2: float = 0.0) -> Floats:
        """Impulse responses to one input place, (72 outputs, 3 axes, 522 taps), in m/s².

        Parameters
        ----------
        location
            Input place, 1 to 20.
        noise_rms_m_s2
            Rms of white noise added per axis, the same at every call.  The default adds none,
            and the built-in limbs have none; 0.006 is about the floor of real recordings.

        Raises
        ------
        InvalidInputError
            There is no such input place.
        """
        check_input_location(location)
        row = location - 1
        response = _response(self, row)
        if noise_rms_m_s2 > 0:
            random = np.random.default_rng((self.seed, location))
            response += noise_rms_m_s2 * random.standard_normal(response.shape)
        return response


def _response(model: SyntheticModel, row: int) -> Floats:
    """S(w) sqrt(r0 / (r0 + r)) exp(-i k r) 10^(-L/20) B(w), split over the axes."""
    wave = np.exp(-1j * model.wavenumber_rad_m * model.path_m[row][:, None])
    wave *= model.pulse
    wave *= 1 + model.bending * model.bending_share[row][:, None]
    wave *= model.amplitude[row][:, None]
    normal = scipy.fft.irfft(wave, _N_FFT)[:, :N_TAPS]
    # A quarter of a period between the motions: particles go round in ellipses.
    tangential = model.tangential * scipy.fft.irfft(1j * wave, _N_FFT)[:, :N_TAPS]
    response = np.empty((N_OUTPUTS, N_AXES, N_TAPS))
    response[:, 0] = np.cos(model.direction_rad)[:, None] * tangential
    response[:, 1] = np.sin(model.direction_rad)[:, None] * tangential
    response[:, 2] = model.normal[row] * normal
    return response


def synthetic_model(number: int) -> SyntheticModel:
    """Prepare a built-in synthetic limb from the shipped parameters.

    Each is prepared once and kept, 0.7 MB; its arrays cannot be written to.

    Parameters
    ----------
    number
        1 to 4.

    Raises
    ------
    UnknownLimbError
        There is no such limb.
    """
    if number not in SYNTHETIC_LIMBS or isinstance(number, bool):
        raise UnknownLimbError(
            f"synthetic limb {quoted(number)} does not exist: there are the limbs 1 to "
            f"{len(SYNTHETIC_LIMBS)}. Choose one of them."
        )
    return _model(int(number))


@cache
def standard_hand() -> HandShape:
    """Return the hand that all synthetic limbs are variations of; the studio draws it."""
    shape = hand_shape(_proportions(_parameters()["hand"]))
    _read_only(shape)
    return shape


@cache
def _model(number: int) -> SyntheticModel:
    shared = _parameters()
    limb = next(entry for entry in shared["limbs"] if entry["number"] == number)
    model = _prepared(shared, limb)
    _read_only(model.shape)
    _read_only(model)
    return model


def _read_only(held: HandShape | SyntheticModel) -> None:
    for one in fields(held):
        value = getattr(held, one.name)
        for array in value if isinstance(value, tuple) else (value,):
            if isinstance(array, np.ndarray):
                array.flags.writeable = False


@cache
def _parameters() -> dict[str, Any]:
    text = (data_folder() / "synthetic-limbs.json").read_text(encoding="utf-8")
    parameters: dict[str, Any] = json.loads(text)
    return parameters


def _proportions(hand: Mapping[str, Any]) -> HandProportions:
    lists = {key: tuple(value) for key, value in hand.items() if isinstance(value, list)}
    return HandProportions(**{**hand, **lists})


def _prepared(shared: Mapping[str, Any], limb: Mapping[str, Any]) -> SyntheticModel:
    shape = hand_shape(_proportions({**shared["hand"], **limb["hand"]}))
    skin = Skin(**shared["skin"])
    stiffness = skin.rising_shear_modulus_pa * limb["shear_factor"]
    skin = replace(skin, rising_shear_modulus_pa=stiffness)
    random = np.random.default_rng(limb["seed"])
    bending, spreading = shared["bending"], shared["spreading"]
    spread = random.uniform(-1, 1, N_OUTPUTS) * bending["frequency_spread"]
    mode_hz = bending["frequency_hz"] * limb["bending_factor"] * (1 + spread)

    paths = paths_in(shape)
    along_mm = paths.lengths_px * limb["hand_length_mm"] / shape.hand_length_px
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
        seed=limb["seed"],
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
    reference = _response(model, _REFERENCE_INPUT - 1)
    scale = shared["peak_of_input_8_m_s2"] / np.abs(reference).max()
    return replace(model, pulse=model.pulse * scale)


def load_synthetic_limb(number: int) -> Limb:
    """Built-in synthetic limb ``number``, 1 to 4, named "synthetic-1" to "synthetic-4".

    Responses are computed when touched, one input place at a time, without noise; the same
    numbers come out at every load.

    Raises
    ------
    UnknownLimbError
        There is no such limb.
    """
    model = synthetic_model(number)
    return Limb(
        name=f"synthetic-{number}",
        hand_length_mm=model.hand_length_mm,
        synthetic=True,
        map=model.shape.limb_map(),
        read_response=model.response_to,
    )
