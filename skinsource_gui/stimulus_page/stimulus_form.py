"""How a stimulus is exported, as fields."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QFormLayout, QLabel, QLineEdit, QWidget

from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.base.quoting import quoted
from skinsource.design.amplitudes import drive_unit
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.export.formats.format import StimulusFormat
from skinsource.export.formats.formats import format_named
from skinsource.export.stimulus_export.options import StimulusOptions
from skinsource_gui.stimulus_page import form_fields as specs
from skinsource_gui.stimulus_page.order import Order
from skinsource_gui.stimulus_page.rig_fields import RigFields
from skinsource_gui.theme import set_tone
from skinsource_gui.widgets.fields.choice_field import ChoiceField
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.tooltips import tooltip

#: Of dither; the sidecar names it.
_SEED = 1


class StimulusForm(QWidget):
    """Fields for format, rate and options; rows that mean nothing now are hidden.

    Parameters
    ----------
    design, view
        What is exported, and what is selected there.
    """

    #: The `Order` that the fields make.
    changed = Signal(object)
    #: Why they make none.
    refused = Signal(str)

    def __init__(self, design: Design, view: View, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design, self._view = design, view
        self._about = QLabel()
        self._about.setWordWrap(True)
        self._about.setObjectName("stimulus_format_hint")
        set_tone(self._about, "dim")
        self._choices: dict[str, ChoiceField] = {}
        self._fields: dict[str, ChoiceField] = {
            "format": ChoiceField(specs.FORMAT),
            "rate": ChoiceField(specs.RATE),
            "plays": ChoiceField(specs.part_spec(design, view)),
            "channels": ChoiceField(specs.CHANNELS),
            "time": ChoiceField(specs.time_spec(design)),
            "scale": ChoiceField(specs.SCALE),
        }
        self._numbers: dict[str, NumberField] = {
            "other_rate": NumberField(specs.OTHER_RATE),
            "from": NumberField(specs.time_number("From", design)),
            "to": NumberField(specs.time_number("To", design)),
            "fade_in": NumberField(specs.FADE),
            "fade_out": NumberField(specs.FADE),
            "lead_in": NumberField(specs.LEAD_IN),
            "full_scale": NumberField(specs.scale_number(drive_unit(design))),
        }
        self._map = QLineEdit()
        self.rigs = RigFields(design, view, self)
        self._sync = QCheckBox("Sync channel")
        self._dither = QCheckBox("Dither")
        self._name_parts()
        self._lay_out()
        self._connect()
        self.take_format()

    @property
    def format(self) -> StimulusFormat:
        """The chosen format."""
        return format_named(self._fields["format"].value, Path())

    def field(self, name: str) -> QWidget:
        """The widget of a row."""
        rows: dict[str, QWidget] = {**self._fields, **self._numbers, **self._choices}
        rows |= {"map": self._map, "sync": self._sync, "dither": self._dither}
        rows |= {"rig": self.rigs.rig_field, "actuator": self.rigs.actuator_field}
        rows |= {"equaliser": self.rigs.equaliser_field}
        return rows[name]

    def want(self) -> None:
        """Tell what the fields make."""
        self._show_rows()
        try:
            order = self._order()
        except SkinSourceError as error:
            self.refused.emit(str(error))
        else:
            self.changed.emit(order)

    def _name_parts(self) -> None:
        for name, widget in (*self._fields.items(), *self._numbers.items()):
            widget.setObjectName(f"stimulus_{name}")
        for name, words in (
            ("from", "From"),
            ("to", "To"),
            ("fade_in", "Fade in"),
            ("fade_out", "Fade out"),
            ("lead_in", "Lead-in"),
            ("other_rate", "Other rate"),
            ("full_scale", "Drive at full scale"),
        ):
            self._numbers[name].setAccessibleName(words)
        self._numbers["to"].set_value(specs.end_s(self._design))
        self._numbers["other_rate"].set_value(48_000)
        self._numbers["full_scale"].set_value(1.0)
        self._map.setObjectName("stimulus_map")
        self._map.setAccessibleName("Channel map")
        self._map.setPlaceholderText("as they are")
        self._map.setToolTip(
            tooltip(
                "Channel map",
                "For each output of the device, from the first on, the channel that it gets: "
                "2, 1, 0, 3; 0 leaves an output silent",
            )
        )
        self._sync.setObjectName("stimulus_sync")
        self._sync.setToolTip("A last channel with a pulse at full scale where the design begins")
        self._dither.setObjectName("stimulus_dither")
        self._dither.setToolTip(
            "Noise of one step before rounding, so that the error does not follow the signal"
        )

    def _lay_out(self) -> None:
        self._form = QFormLayout(self)
        self._form.setContentsMargins(0, 0, 0, 0)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        fields, numbers = self._fields, self._numbers
        for label, widget in (
            ("Format", fields["format"]),
            ("", self._about),
            ("Rate", fields["rate"]),
            ("", numbers["other_rate"]),
            ("Plays", fields["plays"]),
            ("Channels", fields["channels"]),
            ("Map", self._map),
            ("Time", fields["time"]),
            ("From", numbers["from"]),
            ("To", numbers["to"]),
            ("Fade in", numbers["fade_in"]),
            ("Fade out", numbers["fade_out"]),
            ("Lead-in", numbers["lead_in"]),
            ("Rig", self.rigs.rig_field),
            ("Actuator", self.rigs.actuator_field),
            ("Equaliser", self.rigs.equaliser_field),
            ("Full scale", fields["scale"]),
            ("", numbers["full_scale"]),
            ("", self._sync),
            ("", self._dither),
        ):
            self._form.addRow(label, widget)

    def _connect(self) -> None:
        for name, field in self._fields.items():
            if name == "format":
                field.chosen.connect(self.take_format)
            else:
                field.chosen.connect(self.want)
        for number in self._numbers.values():
            number.edited.connect(self.want)
        self.rigs.changed.connect(self.want)
        self.rigs.refused.connect(self.refused)
        self._map.textChanged.connect(self.want)
        for box in (self._sync, self._dither):
            box.toggled.connect(self.want)

    def take_format(self) -> None:
        """Show the choices of the format, and its usual rate."""
        format = self.format
        for field in self._choices.values():
            self._form.removeRow(field)
        self._choices = {}
        position: Any = self._form.getWidgetPosition(self._about)
        for row, (name, spec) in enumerate(format.choices.items(), start=position[0] + 1):
            field = ChoiceField(spec)
            field.setObjectName(f"stimulus_choice_{name}")
            field.chosen.connect(self.want)
            self._form.insertRow(row, spec.label, field)
            self._choices[name] = field
        self._fields["rate"].set_value(str(format.rate_hz or specs.RATES_HZ[0]))
        self.setTabOrder(self._fields["format"], self._fields["rate"])
        before: QWidget = self._fields["format"]
        for field in self._choices.values():
            self.setTabOrder(before, field)
            before = field
        self.setTabOrder(before, self._fields["rate"])
        self._about.setText(f"{format.hint}.")
        self.want()

    def _show_rows(self) -> None:
        format, chosen = self.format, self.chosen
        shown: Mapping[QWidget, bool] = {
            self._fields["rate"]: not format.fixed_rate,
            self._numbers["other_rate"]: not format.fixed_rate
            and self._fields["rate"].value == specs.OTHER,
            self._fields["plays"]: self._fields["plays"].count() > 1,
            self._map: self._fields["channels"].value != "files",
            self._numbers["from"]: self._fields["time"].value == "part",
            self._numbers["to"]: self._fields["time"].value == "part",
            self.rigs.actuator_field: self.rigs.can_choose_actuator,
            self.rigs.equaliser_field: self.rigs.can_equalise,
            self._fields["scale"]: not self._scale_is_known,
            self._numbers["full_scale"]: self._own_scale,
            self._dither: format.rounds(chosen),
        }
        for widget, visible in shown.items():
            self._form.setRowVisible(widget, visible)
        unit = drive_unit(self._design) if self.rigs.equaliser is None else "V"
        self._numbers["full_scale"].set_spec(specs.scale_number(unit))

    @property
    def chosen(self) -> dict[str, str]:
        """What was chosen of what the format offers."""
        return {name: field.value for name, field in self._choices.items()}

    def _order(self) -> Order:
        chosen, format = self.chosen, self.format
        plays, channels = self._fields["plays"].value, self._fields["channels"].value
        from_s, to_s = self._part()
        rounds = format.rounds(chosen) and self._dither.isChecked()
        per: Literal["place", "input"] = "place" if channels == "place" else "input"
        options = StimulusOptions(
            per=per,
            one_file_per_input=channels == "files",
            inputs=self._view.selected_inputs if plays == "tracks" else None,
            clips=self._view.selected_clips if plays == "clips" else None,
            from_s=from_s,
            to_s=to_s,
            fade_in_s=self._numbers["fade_in"].value_si,
            fade_out_s=self._numbers["fade_out"].value_si,
            lead_in_s=self._numbers["lead_in"].value_si,
            sync=self._sync.isChecked(),
            channel_map=() if channels == "files" else channel_map_of(self._map.text()),
            full_scale=self._numbers["full_scale"].value_si if self._own_scale else None,
            dither_seed=_SEED if rounds else None,
            choices=chosen,
        )
        return Order(
            format=format,
            rate_hz=self._rate_hz(),
            options=options,
            actuation=self.rigs.actuation,
            rig=self.rigs.rig,
            equaliser=self.rigs.equaliser,
        )

    @property
    def _own_scale(self) -> bool:
        return not self._scale_is_known and self._fields["scale"].value == "own"

    @property
    def _scale_is_known(self) -> bool:
        """Whether the rig says what full scale is."""
        return self.rigs.equaliser is not None and self.rigs.rig is not None

    def _rate_hz(self) -> int:
        rate = self._fields["rate"].value
        return round(self._numbers["other_rate"].value_si) if rate == specs.OTHER else int(rate)

    def _part(self) -> tuple[float | None, float | None]:
        time = self._fields["time"].value
        if time == "loop":
            return self._design.loop_s or (None, None)
        if time == "part":
            return self._numbers["from"].value_si, self._numbers["to"].value_si
        return None, None


def channel_map_of(text: str) -> tuple[int, ...]:
    """The numbers in a text, apart by commas or spaces.

    Raises
    ------
    InvalidInputError
        There is something else in it.
    """
    words = text.replace(",", " ").split()
    try:
        return tuple(int(word) for word in words)
    except ValueError:
        raise InvalidInputError(
            f"Channel map is {quoted(text)}, expected whole numbers such as 2, 1, 0, 3"
        ) from None
