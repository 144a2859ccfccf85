"""Which of the designs is the one in the window, and what is said of all of them."""

from collections.abc import Sequence

import numpy as np

from skinsource.choice_words import signal_words, span_words
from skinsource.comparing import EDITED, nothing_to_compare, shown
from skinsource.decibels import FLOOR_DB
from skinsource.design import Design
from skinsource.view import View
from skinsource_gui.compared import LEVELS_MATCHED, Compared
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings

SILENT = "Silent: nothing is driven"
ALONE = "There is no other limb with these outputs. Choose some under Limbs."


def reference_of(
    compared: Sequence[Compared], design: Design, view: View, settings: SideBySideSettings
) -> int:
    """Which of them is the one in the window; the first where none is."""
    if settings.of == "limbs":
        found = [one.snapshot.design.limb == design.limb for one in compared]
    else:
        held = shown(view.snapshots, design)
        number = EDITED if held is None else held.number
        found = [one.snapshot.number == number for one in compared]
    return found.index(True) if True in found else 0


def hindrance(compared: Sequence[Compared], view: View, settings: SideBySideSettings) -> str:
    """Why nothing can be compared, in a sentence; empty where something can."""
    if settings.of == "snapshots" and len(compared) < 2:
        return nothing_to_compare(view.snapshots)
    if settings.of == "limbs" and len(compared) == 1:
        return ALONE
    known = [one.values["output_levels_db"] for one in compared if one.values is not None]
    silent = bool(known) and all(float(np.max(levels)) <= FLOOR_DB for levels in known)
    return SILENT if silent else ""


def about(view: View, settings: SideBySideSettings) -> str:
    """What the levels are."""
    words = [f"RMS of {signal_words(view.axes, view.method)}", span_words(view.span)]
    if settings.of == "snapshots" and view.levels_matched:
        words.append(LEVELS_MATCHED)
    return " · ".join(words)
