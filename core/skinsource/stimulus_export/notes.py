"""What is said of an export beside its numbers: on the sheet, in a terminal, in the sidecars."""

from skinsource.stimulus.wiring import FULL_SCALE_UNIT
from skinsource.stimulus_export.edges import edge_words
from skinsource.stimulus_export.preparing import Prepared

# What samples are that were not equalised, by the unit of the drive.
_RAW = {
    "m/s²": "raw accelerations",
    "V": "volts of the design",
    FULL_SCALE_UNIT: "volts of the design",
}


def edges_of(ready: Prepared) -> str:
    """Which channels begin or end hard, in words; "": none."""
    return edge_words([one.stimulus for _, one in ready.files], ready.cut)


def loses_of(ready: Prepared) -> str:
    """What of the drive is not in the files, in words; "": nothing."""
    return ready.format.loses(ready.files[0][1].choices)


def equalised_of(ready: Prepared) -> str:
    """What the samples are equalised for, and by which equaliser, in words."""
    if ready.equaliser is None:
        return f"Not equalised ({_RAW.get(ready.drives.unit, 'raw drives')})"
    through = ready.actuation if ready.rig is None else ready.rig
    title = through.title if through is not None and through.title else "the rig"
    return f"Equalised for {title} ({ready.equaliser.title.lower()})"


def calibration_of(ready: Prepared) -> str:
    """Whether m/s² follow from the samples, in words."""
    return ready.files[0][1].calibration
