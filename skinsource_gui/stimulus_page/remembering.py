"""What the page remembers from one export to the next, on this machine."""

import json
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QCheckBox, QWidget

from skinsource_gui.stimulus_page.stimulus_form import StimulusForm
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField

# What is a matter of one design, its times, channels and drives, is not among them.
_LISTS = ("format", "rate", "channels", "equaliser")
_NUMBERS = ("other_rate", "fade_in", "fade_out", "lead_in")
_BOXES = ("sync", "dither")
_MOST_CHARACTERS = 10_000


def remembered(form: StimulusForm, machine_rig: str = "") -> str:
    """Write down how ``form`` exports, and for which rig this machine played then."""
    held: dict[str, Any] = {}
    for name in (*_LISTS, *_NUMBERS, *_BOXES):
        held[name] = _value(form.field(name))
    held["choices"] = form.chosen
    held["rig"] = "" if form.rigs.path is None else str(form.rigs.path)
    held["machine_rig"] = machine_rig
    return json.dumps(held)


def recall(form: StimulusForm, text: str, machine_rig: str = "") -> None:
    """Let ``form`` export as it was written down; what is not known is left as it is.

    A rig that this machine has played for only since then goes before the one of then.
    """
    held = _held(text)
    rig = held.get("rig")
    if machine_rig and machine_rig != held.get("machine_rig"):
        rig = machine_rig
    if rig and isinstance(rig, str):
        form.rigs.take(Path(rig))
    if not held:
        return
    # The format first: it decides which choices there are.
    _put(form.field("format"), held.get("format"))
    form.take_format()
    choices = held.get("choices")
    for name, value in choices.items() if isinstance(choices, dict) else ():
        if name in form.chosen:
            _put(form.field(name), value)
    for name in (*_LISTS[1:], *_NUMBERS, *_BOXES):
        # What was chosen in the panel Actuator goes before the equaliser of another design.
        if name != "equaliser" or form.rigs.chosen is None:
            _put(form.field(name), held.get(name))


def _held(text: str) -> dict[str, Any]:
    """What was written down; nothing where another version of the studio wrote it."""
    try:
        held = json.loads(text[:_MOST_CHARACTERS]) if text else {}
    except (ValueError, RecursionError):
        return {}
    return held if isinstance(held, dict) else {}


def _value(widget: QWidget) -> Any:
    if isinstance(widget, ChoiceField):
        return widget.value
    if isinstance(widget, NumberField):
        return widget.value_si
    return isinstance(widget, QCheckBox) and widget.isChecked()


def _put(widget: QWidget, value: Any) -> None:
    with QSignalBlocker(widget):
        if isinstance(widget, ChoiceField):
            if isinstance(value, str) and widget.findData(value) >= 0:
                widget.set_value(value)
        elif isinstance(widget, NumberField):
            if isinstance(value, int | float) and not isinstance(value, bool):
                spec = widget.spec
                if spec.minimum <= value <= spec.maximum:
                    widget.set_value(value)
        elif isinstance(widget, QCheckBox) and isinstance(value, bool):
            widget.setChecked(value)
