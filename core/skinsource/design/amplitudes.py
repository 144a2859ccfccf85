"""Meaning and unit of amplitudes.

They depend on the scaling, on the actuators, and on the drive that the limb's responses answer.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser, PolePairReplacement
from skinsource.base.errors import InvalidInputError, lowered
from skinsource.design.clips import Clip
from skinsource.design.design import AMPLITUDE, Design, Input
from skinsource.design.signal_path import Curve, drive_of_clips
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.samples import Layers, Recording
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import drive_unit_known, facts_of
from skinsource.limbs.scaling import Scaling
from skinsource.signals.resampling import peaks_between
from skinsource.specs.numbers import NumberSpec

#: Unit of a drive whose unit is not known.
ARBITRARY_UNIT = "a.u."
_UNITS: dict[Scaling, str] = {"upstream": "m/s²", "relative": "×", "probe": "m/s²"}
# Under upstream scaling an amplitude is a peak on the skin, and the drive itself has no unit.
_DRIVE_UNITS: dict[Scaling, str] = {"upstream": "1", "relative": "measuring pulse", "probe": "m/s²"}
_MEANINGS: dict[Scaling, str] = {
    "upstream": "Largest acceleration on any axis that all clips together cause",
    "relative": "A factor: 1 is the measuring pulse",
    "probe": "Acceleration of the probe, within about 3 dB",
}
# What follows an amplitude.
_IN_SHORT: dict[Scaling, str] = {
    "upstream": "peak on the skin",
    "relative": "of the measuring pulse",
    "probe": "at the probe",
}
# For limbs whose responses answer a drive of unknown unit.
_MEANINGS_OF_DRIVES: dict[Scaling, str] = {
    "upstream": _MEANINGS["upstream"],
    "relative": "A factor: 1 is one unit of the drive of this limb",
    "probe": f"In the unit of the drive of this limb, which is unknown ({ARBITRARY_UNIT})",
}

# How far sampling or rounding can move a peak of 1.
_ROUNDING = 1e-3
# Least and largest peak of what is meant to peak at 1: a tone that begins at its crest has 1.14.
_LEAST_PEAK, _MOST_PEAK = 0.9, 1.15
# Peaks that differ less from 1 are not said.
_UNSAID = 0.01


def is_gain(design: Design, track: Input, peak: float | None = None) -> bool:
    """Whether the amplitude of an input is a plain factor on what has its own size.

    Recordings have one, and what has another ``peak`` than 1 before the amplitude; it is computed
    where it is not given.  Under upstream scaling it is none, because there the amplitude is the
    peak on the skin.  Muted clips count where all are muted.
    """
    if design.scaling == "upstream":
        return False
    heard = tuple(clip for clip in track.clips if not clip.muted) or track.clips
    if any(_has_its_own_size(clip.waveform) for clip in heard):
        return True
    peak = peak_before_amplitude(design, track) if peak is None else peak
    return not _LEAST_PEAK <= (peak or 1.0) <= _MOST_PEAK


def says_peak(design: Design, track: Input, peak: float | None) -> bool:
    """Whether the ``peak`` of an input before its amplitude is said beside the amplitude."""
    differs = abs((peak or 1.0) - 1.0) > _UNSAID
    return design.scaling != "upstream" and (differs or is_gain(design, track, peak))


def peak_text(design: Design, track: Input, peak: float | None = None) -> str:
    """Return the peak drive of an input, ``"4.88 m/s²"``; empty if it cannot be played.

    ``peak``: that before the amplitude, where it is known.
    """
    peak = peak_before_amplitude(design, track) if peak is None else peak
    return "" if peak is None else f"{abs(track.amplitude) * peak:.3g} {amplitude_unit(design)}"


def peak_before_amplitude(design: Design, track: Input) -> float | None:
    """Return the peak of an input before its amplitude; None if it cannot be played."""
    rate_hz = facts_of(design.limb).sample_rate_hz
    try:
        return _peak_of(track.clips, track.gain_curve, rate_hz, track.location)
    except InvalidInputError:
        return None


def amplitude_text(design: Design, track: Input) -> str:
    """Return the amplitude of an input: ``"2 m/s²"``, or ``"gain 2, peak 9.76 m/s²"``."""
    peak, amplitude = peak_before_amplitude(design, track), f"{track.amplitude:zg}"
    gain = is_gain(design, track, peak)
    text = f"gain {amplitude}" if gain else f"{amplitude} {amplitude_unit(design)}"
    said = peak is not None and says_peak(design, track, peak)
    return f"{text}, peak {peak_text(design, track, peak)}" if said else text


def amplitude_unit(design: Design) -> str:
    """Return the unit of an input's amplitude.

    It is m/s², V at an actuator, × for a plain factor, or `ARBITRARY_UNIT`.
    """
    actuated = design.actuated
    if actuated is not None and actuated.equaliser is None:
        return "V"
    if design.scaling == "probe" and actuated is None and not _unit_known(design):
        return ARBITRARY_UNIT
    return _UNITS[design.scaling]


def amplitude_meaning(design: Design) -> str:
    """Say what an input's amplitude means."""
    if design.actuated is None:
        return (_MEANINGS if _unit_known(design) else _MEANINGS_OF_DRIVES)[design.scaling]
    return " ".join(_through(design.actuated))


def amplitude_in_short(design: Design) -> str:
    """Return what follows the amplitude of an input: ``"at the probe"``."""
    if design.actuated is None:
        return _IN_SHORT[design.scaling]
    return _through(design.actuated)[1]


def amplitude_spec(design: Design) -> NumberSpec:
    """Return the specification of amplitudes with their unit and meaning in a design."""
    unit, meaning = amplitude_unit(design), amplitude_meaning(design)
    return replace(AMPLITUDE, unit=unit, hint=f"{meaning}. {AMPLITUDE.hint}")


def amplitude_note(
    limb: str, digest: str, scaling: Scaling, actuated: Actuation | None = None
) -> str:
    """Say what amplitudes mean where the scaling alone does not; empty where it does."""
    if actuated is not None:
        unit = "V" if actuated.equaliser is None else _UNITS[scaling]
        return f"{lowered(' '.join(_through(actuated)))}, {unit}"
    if scaling == "upstream" or drive_unit_known(limb, digest):
        return ""
    return lowered(_MEANINGS_OF_DRIVES[scaling])


def drive_unit(design: Design, limb: Limb | None = None) -> str:
    """Return the unit of the exported drives of a design.

    Parameters
    ----------
    limb
        The limb of the design, if it is open already.
    """
    actuated = design.actuated
    if actuated is not None:
        return "V" if actuated.equaliser is None else _DRIVE_UNITS[design.scaling]
    known = _unit_known(design) if limb is None else not limb.per_unit_drive
    if known or design.scaling == "upstream":
        return _DRIVE_UNITS[design.scaling]
    return ARBITRARY_UNIT


def equaliser_of(design: Design) -> Equaliser | None:
    """Return the equaliser that a design is exported and played through.

    None where none is chosen, or drives are no accelerations.
    """
    chosen = design.actuation
    return chosen.equaliser if chosen is not None and drive_unit(design) == "m/s²" else None


def _through(actuated: Actuation) -> tuple[str, str]:
    """Return what an amplitude is at an actuator, and where."""
    if actuated.equaliser is None:
        return "Voltage", "at the actuator"
    if isinstance(actuated.equaliser, PolePairReplacement):
        # More at some frequencies, less at others.
        return "Acceleration at the contactor,", "in the mean of the band"
    return "Acceleration", "at the contactor"


def _has_its_own_size(waveform: Waveform) -> bool:
    """Whether a waveform holds a recording that was not scaled to a peak of 1."""
    if isinstance(waveform, Layers):
        return any(_has_its_own_size(part.waveform) for part in waveform.parts if not part.muted)
    if not isinstance(waveform, Recording):
        return False
    return waveform.samples.unit != "" or abs(waveform.samples.peak - 1.0) > _ROUNDING


@lru_cache(maxsize=128)
def _peak_of(
    clips: tuple[Clip, ...], gain_curve: Curve, sample_rate_hz: float, place: int
) -> float:
    _, drive = drive_of_clips(clips, gain_curve, sample_rate_hz, place)
    return drive.factor * float(peaks_between(drive.samples[np.newaxis])[0])


def _unit_known(design: Design) -> bool:
    return drive_unit_known(design.limb, design.limb_digest)
