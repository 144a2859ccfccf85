"""A snapshot and what is predicted for it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import printable
from skinsource.design.comparing import gain_text, match_text
from skinsource.design.design import EDITED, Design, Snapshot, View
from skinsource.design.signal_path import unplayable_text
from skinsource.studies import scenes

#: The note where designs are shown with matched levels.
LEVELS_MATCHED = "levels matched"
#: The note in place of a design that drives nothing.
SILENT = "No active input"
#: Why two designs have no difference map.
SILENCE = "One of them is silent: there is no difference in dB."
ELSEWHERE = "Their limbs have outputs at different places, so no difference is shown."


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Compared:
    """One of the designs side by side.

    Attributes
    ----------
    snapshot
        The design and its number; 0: what is edited, or was when another one was shown.
    values
        Quantities by name, of the design as it was stored; None while they are not known.
    problem
        Why there are none.
    gain
        Factor with which it is shown now, so that it is as loud as the others.
    axes
        Which of the limb's axes take part; empty: those of the view.
    is_stale
        Whether ``values`` are those of the design before, until they are known anew.
    """

    snapshot: Snapshot
    values: Mapping[str, Any] | None = None
    problem: str = ""
    gain: float = 1.0
    axes: str = ""
    is_stale: bool = False

    @property
    def left_out(self) -> str:
        """A sentence on the inputs that its values are without; "" where there are none."""
        return unplayable_text((self.values or {}).get("unplayable_inputs", ()))

    @property
    def title(self) -> str:
        """The snapshot's own title, or that of its design."""
        title = self.snapshot.title or scenes.title_of(self.snapshot.design)
        return printable(title).strip()

    @property
    def name(self) -> str:
        """Its number on a card."""
        return "Working" if self.snapshot.number == EDITED else str(self.snapshot.number)


def is_silent(compared: Compared) -> bool:
    """Return whether the design is known to be silent: nothing can be matched to it."""
    values = compared.values
    return values is not None and float(np.max(values["output_levels_db"])) <= FLOOR_DB


def have_matching_level(compared: Sequence[Compared], *, matched: bool) -> bool:
    """Return whether levels are ``matched``, and the first design has a level to match."""
    first = min(compared, key=lambda design: design.snapshot.number, default=None)
    return matched and first is not None and not (is_silent(first) or first.problem)


def display_gain_text(design: Design | None, view: View) -> str:
    """Return the note on the gain with which the design in the window is shown."""
    return "" if design is None else match_text(view.match_gain(design))


def matched_text(compared: Sequence[Compared]) -> str:
    """Return the gains with which designs are shown: ``"2: −3.2 dB, matched"``; or ""."""
    gains = [(design.name, gain_text(design.gain)) for design in compared]
    text = ", ".join(f"{name}: {gain}" for name, gain in gains if gain)
    return f"{text}, matched" if text else ""


def gain_db(compared: Compared) -> float:
    """Return the gain with which a design is shown, dB."""
    return float(20.0 * np.log10(compared.gain))
