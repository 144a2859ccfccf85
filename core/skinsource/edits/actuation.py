"""What predictions go through: actuators, or nothing."""

from dataclasses import replace

from skinsource.chain import Actuation
from skinsource.design import Design
from skinsource.edits.edit import Edit, Refusal
from skinsource.view import View

_NEEDS_PROBE = (
    "Predict through the actuator needs drives that are accelerations or volts. Choose the scaling "
    "Probe acceleration first."
)


def predict_through(design: Design, view: View, actuation: Actuation | None) -> Edit | Refusal:
    """Predict through actuators; None: without, and the present ones are remembered."""
    if actuation is not None and actuation.on and design.scaling != "probe":
        return Refusal(sentence=_NEEDS_PROBE)
    if actuation is None and design.actuation is not None:
        actuation = replace(design.actuation, on=False)
    on = actuation is not None and actuation.on
    if on and design.actuated is not None:
        label = "Change the actuator"
    else:
        label = "Predict through the actuator" if on else "Predict without the actuator"
    return Edit(label=label, design=replace(design, actuation=actuation), view=view)
