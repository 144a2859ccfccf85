"""From what is written down of a voice to the samples it plays: the one place drives come from."""

from skinsource.chain.actuation import Actuation, ActuatorAt
from skinsource.chain.amplitudes import (
    ARBITRARY_UNIT,
    amplitude_meaning,
    amplitude_note,
    amplitude_text,
    amplitude_unit,
    drive_unit,
    is_gain,
    peak_text,
)
from skinsource.chain.chain import Chain, Curve, Part
from skinsource.chain.drive import LARGEST, Drive, drive_of, drive_played, first_unusable
from skinsource.chain.followed import refuse_unfollowed
from skinsource.chain.of_rig import actuation_of_rig
from skinsource.chain.placing import drive_of_clips, placed_chain
from skinsource.chain.transfer import Transfer, transfers_of

__all__ = [
    "ARBITRARY_UNIT",
    "LARGEST",
    "Actuation",
    "ActuatorAt",
    "Chain",
    "Curve",
    "Drive",
    "Part",
    "Transfer",
    "actuation_of_rig",
    "amplitude_meaning",
    "amplitude_note",
    "amplitude_text",
    "amplitude_unit",
    "drive_of",
    "drive_of_clips",
    "drive_played",
    "drive_unit",
    "first_unusable",
    "is_gain",
    "peak_text",
    "placed_chain",
    "refuse_unfollowed",
    "transfers_of",
]
