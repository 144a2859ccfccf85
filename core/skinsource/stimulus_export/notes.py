"""What is said of an export beside its numbers: on the sheet, in a terminal, in the sidecars."""

from skinsource.stimulus_export.edges import edge_words
from skinsource.stimulus_export.preparing import Prepared


def edges_of(ready: Prepared) -> str:
    """Which channels begin or end hard, in words; "": none."""
    return edge_words([one.stimulus for _, one in ready.files], ready.cut)


def loses_of(ready: Prepared) -> str:
    """What of the drive is not in the files, in words; "": nothing."""
    return ready.format.loses(ready.files[0][1].choices)


def calibration_of(ready: Prepared) -> str:
    """Whether m/s² follow from the samples, in words."""
    return ready.files[0][1].calibration
