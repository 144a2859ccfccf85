"""How far the calibration of a person is, and the rows that are shown of it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from skinsource.limbs.locations import input_name, output_name
from skinsource_gui.fields.units import minus

if TYPE_CHECKING:
    from skinsource.lab.calibrating import Calibration, Measured, Sitting, Verification
    from skinsource.lab.rig_measuring.measurement import MeasuringSetup
    from skinsource.people import PartialLimb

#: Steps, by their numbers from 0.
MOUNTING, SWEEPS, FOCUS = range(3)
_INTRODUCTION = (
    "One sensor on the skin, two sweeps of each actuator: from them follow drives that are strong "
    "at the sensor. What other places do comes from other people."
)
_NOTHING = "Nothing is measured yet."
_OPENED = "Not verified: opened from a file. Verifying needs a new measurement."


@dataclass(frozen=True, kw_only=True, eq=False)
class CalibrationState:
    """What is known of the calibration of a person.

    Attributes
    ----------
    sitting, setup
        The person and the place of the sensor; the sensor's input on the sound card.
    stand_in
        Whether the stand-in person takes the place of the rig.
    rig_title
        Of the rig of this machine; "": there is none.
    step
        `MOUNTING`, `SWEEPS` or `FOCUS`.
    places
        Of the actuators.
    rows
        Inputs that were measured so far.
    found, verification
        Results; None: there are none yet, and no focus.
    opened
        Who was opened from a file in place of measuring; None: nobody.
    running
        Whether something is played or computed.
    said, warns
        Sentences for the user, and whether they are warnings.
    """

    sitting: "Sitting"
    setup: "MeasuringSetup"
    stand_in: bool = False
    rig_title: str = ""
    step: int = MOUNTING
    places: tuple[int, ...] = ()
    rows: "tuple[Measured, ...]" = ()
    found: "Calibration | None" = None
    verification: "Verification | None" = None
    opened: "PartialLimb | None" = None
    running: bool = False
    said: str = _INTRODUCTION
    warns: bool = False

    @property
    def has_partial(self) -> bool:
        """Whether there are inputs from which a focus follows."""
        found = self.found
        return found is not None and not found.moved and len(found.failures) < len(found.rows)


def whom(state: CalibrationState) -> str:
    """Return who is measured, or was, and where."""
    shown = state.sitting if state.running or state.found is None else state.found.sitting
    name = output_name(shown.output, state.sitting.like).name
    return f"{shown.person or 'Nobody'}, output {shown.output}: {name}"


def sweep_rows(state: CalibrationState) -> list[list[tuple[str, str]]]:
    """Return text and tooltip of the cells of each input."""
    known = {row.place: row for row in state.rows}
    rows = []
    for place in state.places:
        name = input_name(place, state.sitting.like)
        row = known.get(place)
        texts = [f"{place}  {name.short_name}", "", "", ""]
        if row is not None:
            result = " ".join(row.failures) or "accepted"
            texts[1:] = [result, f"{100 * row.coherent:.0f} %", f"{100 * row.peak:.2g} %"]
        elif state.opened is not None:
            texts[1] = "from the file"
        rows.append([(text, name.name if not k else text) for k, text in enumerate(texts)])
    return rows


def verified_rows(state: CalibrationState) -> list[list[tuple[str, str]]]:
    """Return text and tooltip of the cells of each comparison."""
    rows = []
    for check in state.verification.checks if state.verification else ():
        name = output_name(check.output, state.sitting.like)
        predicted = f"{check.predicted_db:.1f}"
        if check.low_db == check.low_db:  # a range
            predicted = f"{check.low_db:.0f} to {check.high_db:.0f}"
        late = f"{1e3 * check.delay_s:z.2f}" if check.delay_s == check.delay_s else "–"
        nmse = f"{check.nmse_db:z.1f}" if check.nmse_db == check.nmse_db else "–"
        numbers = f"{check.measured_db:z.1f}", predicted, nmse, late
        texts = f"{check.output}  {name.short_name}", check.played, *map(minus, numbers)
        rows.append([(text, name.name if not k else text) for k, text in enumerate(texts)])
    return rows


def verdict(state: CalibrationState) -> str:
    """Return in words whether a focus was verified."""
    verified, unverified = state.verification, _NOTHING if state.opened is None else _OPENED
    return unverified if verified is None else minus(verified.words)
