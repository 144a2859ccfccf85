"""The rules from all that plays to what a prediction is not good for, and how fast probes are."""

from skinsource.arrays import Floats
from skinsource.chain import Actuation
from skinsource.limb import PUBLISHED, Limb
from skinsource.scaling.response_scaling import Scaling
from skinsource.validity import (
    SPATIAL_LIMIT_HZ,
    Finding,
    Findings,
    are_probe_accelerations,
    fastest_probe,
    found_in_drives,
    found_in_outputs,
    found_in_setup,
)
from skinsource.voices import UnplayableInput, unplayable_words


def validity(
    place_drives: tuple[tuple[int, Floats], ...],
    above_noise_db: Floats | None,
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
    unplayable_inputs: tuple[UnplayableInput, ...],
) -> Findings:
    """Conditions of the measurement, and whether they are kept: see `skinsource.validity`."""
    synthetic = limb_data.synthetic
    places = [place for place, _ in place_drives]
    return (
        *_left_out(unplayable_inputs),
        *found_in_drives(
            place_drives,
            limb_data.sample_rate_hz,
            scaling,
            probe=actuation is None,
            unit_known=not limb_data.per_unit_drive,
            band_hz=limb_data.band_hz,
            # Where a lab put its outputs is another matter.
            spatial_limit_hz=SPATIAL_LIMIT_HZ if limb_data.name in PUBLISHED else None,
        ),
        found_in_outputs(above_noise_db, synthetic=synthetic, silent=not place_drives),
        *found_in_setup(synthetic=synthetic, scaling=scaling, places=places),
    )


def fastest_probe_m_per_s(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
) -> float | None:
    """Largest velocity of any probe, in m/s; None: not known, or actuators move in their place."""
    if not are_probe_accelerations(limb_data, scaling, actuated=actuation is not None):
        return None
    drives = [samples for _, samples in place_drives]
    return fastest_probe(drives, limb_data.sample_rate_hz, limb_data.band_hz)


def _left_out(unplayable: tuple[UnplayableInput, ...]) -> Findings:
    """Say that a prediction is not of all inputs, wherever its numbers are taken."""
    words = unplayable_words(unplayable)
    if not words:
        return ()
    sentence = f"{words} The prediction leaves out what cannot be played."
    return (Finding(name="inputs", state="left", sentence=sentence, in_short=sentence),)


RULES = (validity, fastest_probe_m_per_s)
