"""A snapshot and what is predicted for it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.comparing import EDITED, Snapshot

#: What is said where designs are shown as loud as each other.
LEVELS_MATCHED = "levels matched"
#: Why two designs have no difference map.
ELSEWHERE = "Their limbs have their outputs at other places: there is no difference."


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
    late
        Whether ``values`` are those of the design before, until they are known anew.
    """

    snapshot: Snapshot
    values: Mapping[str, Any] | None = None
    problem: str = ""
    gain: float = 1.0
    axes: str = ""
    late: bool = False

    @property
    def name(self) -> str:
        """What a card calls it."""
        return "Edited" if self.snapshot.number == EDITED else str(self.snapshot.number)


def gain_db(compared: Compared) -> float:
    """How much louder than it was stored it is shown, dB."""
    return float(20.0 * np.log10(compared.gain))
