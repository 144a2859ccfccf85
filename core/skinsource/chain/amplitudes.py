"""What an amplitude means: a matter of the scaling, of actuators, and of what the limb answers."""

from typing import Protocol

from skinsource.chain.actuation import Actuation
from skinsource.limb import Limb
from skinsource.own_limbs import drive_unit_known
from skinsource.scaling.response_scaling import Scaling

#: Arbitrary units: that of a drive of which nobody says what it is.
ARBITRARY_UNIT = "a.u."
_UNITS: dict[Scaling, str] = {"upstream": "m/s²", "relative": "×", "probe": "m/s²"}
# Under upstream scaling an amplitude is a peak on the skin: the drive has no unit of its own.
_DRIVE_UNITS: dict[Scaling, str] = {"upstream": "1", "relative": "measuring pulse", "probe": "m/s²"}
_MEANINGS: dict[Scaling, str] = {
    "upstream": "The highest acceleration on any one axis that all clips together cause",
    "relative": "A factor: 1 is the measuring pulse",
    "probe": "Acceleration of the probe, within about 3 dB",
}
# Where responses answer a drive of unknown unit.
_MEANINGS_OF_DRIVES: dict[Scaling, str] = {
    "upstream": _MEANINGS["upstream"],
    "relative": "A factor: 1 is one unit of the drive that the responses of this limb answer",
    "probe": "In the unit of the drive that the responses of this limb answer; which one is not "
    f"known ({ARBITRARY_UNIT})",
}


class Driven(Protocol):
    """What amplitudes of a design depend on."""

    @property
    def limb(self) -> str:
        """Whose responses answer the drives."""

    @property
    def limb_digest(self) -> str:
        """Which limb of that name is meant; empty: whatever has it."""

    @property
    def scaling(self) -> Scaling:
        """What an amplitude of 1 is."""

    @property
    def actuated(self) -> Actuation | None:
        """Actuators that the drives go through."""


def amplitude_unit(design: Driven) -> str:
    """Unit of an input's amplitude.

    m/s², V at an actuator, × for a plain factor, or `ARBITRARY_UNIT`.
    """
    actuated = design.actuated
    if actuated is not None and actuated.equaliser is None:
        return "V"
    if design.scaling == "probe" and actuated is None and not _unit_known(design):
        return ARBITRARY_UNIT
    return _UNITS[design.scaling]


def amplitude_meaning(design: Driven) -> str:
    """What an input's amplitude is, in words."""
    if design.actuated is None:
        return (_MEANINGS if _unit_known(design) else _MEANINGS_OF_DRIVES)[design.scaling]
    volts = design.actuated.equaliser is None
    return "Voltage at the actuator" if volts else "Acceleration of the contactor"


def amplitude_note(
    limb: str, digest: str, scaling: Scaling, actuated: Actuation | None = None
) -> str:
    """What amplitudes are where that does not follow from the scaling; empty where it does."""
    if actuated is not None or scaling == "upstream" or drive_unit_known(limb, digest):
        return ""
    meaning = _MEANINGS_OF_DRIVES[scaling]
    return f"{meaning[:1].lower()}{meaning[1:]}"


def drive_unit(design: Driven, limb: Limb | None = None) -> str:
    """Unit of what a design plays, as it is exported.

    Parameters
    ----------
    limb
        That of the design, where it is open already.
    """
    actuated = design.actuated
    if actuated is not None:
        return "V" if actuated.equaliser is None else _DRIVE_UNITS[design.scaling]
    known = _unit_known(design) if limb is None else not limb.per_unit_drive
    if known or design.scaling == "upstream":
        return _DRIVE_UNITS[design.scaling]
    return ARBITRARY_UNIT


def _unit_known(design: Driven) -> bool:
    return drive_unit_known(design.limb, design.limb_digest)
