"""Curves and predicted figures of an actuator, as plain data, and the table of figures."""

from dataclasses import dataclass
from math import isnan

import numpy as np
from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, Qt

from skinsource.actuators.actuation import ActuatorProfile
from skinsource.actuators.actuator import Actuator
from skinsource.actuators.equalising import Equaliser, curves, mean_of
from skinsource.actuators.prediction import Prediction, breaches
from skinsource.base.conventions import LARGEST_VELOCITY_M_PER_S, Band, Floats
from skinsource.base.decibels import decibels
from skinsource.design.display_units import value_text
from skinsource.engine.actuator_demand import LONGEST_S, Demand
from skinsource.limbs.locations import input_name
from skinsource.specs import fields
from skinsource.specs.spec import SwitchSpec
from skinsource_gui.plots.curves import CurveName, Curves
from skinsource_gui.plots.ranges import XAxis
from skinsource_gui.qt.buttons import page_button, page_label, show_or_hide
from skinsource_gui.qt.layouts import in_column, named
from skinsource_gui.qt.theme import UNIT_PX, current_theme, set_tone
from skinsource_gui.state.panel import PREPARING


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputSettings(fields.CheckedModel):
    """Whether parameters, figures and responses are unfolded."""

    more: bool = fields.switch(False, SwitchSpec(label="More"))


# Smallest drawn range of frequencies, and how far it extends beyond the band, in factors.
_SHOWN_HZ, _BELOW, _ABOVE, _POINTS = (10.0, 2000.0), 0.4, 2.0, 500
_BEFORE = CurveName(number=0, short="Actuator", full="The actuator alone, re its mean in the band")
_FILTER = CurveName(number=0, short="Filter", full="Voltage from the equaliser")
_AFTER = CurveName(number=0, short="Equalised", full="Actuator with its equaliser")
_PUBLISHED = CurveName(number=0, short="As listed", full="Actuator with its listed parameters")


def frequencies_of(band_hz: Band) -> Floats:
    """Return the frequencies that are drawn on a limb with this band, (500,)."""
    low = min(_SHOWN_HZ[0], _BELOW * band_hz[0])
    return np.geomspace(low, max(_SHOWN_HZ[1], _ABOVE * band_hz[1]), _POINTS)


def frequency_axis(band_hz: Band) -> XAxis:
    """Return the axis of these frequencies."""
    shown = frequencies_of(band_hz)
    return XAxis(
        titles=(
            f"Frequency (Hz) · followed from {band_hz[0]:.4g} to {band_hz[1]:.4g} Hz, "
            "shaded outside",
            "Frequency (Hz)",
        ),
        unit="Hz",
        column="frequency_hz",
        extent=(float(shown[0]), float(shown[-1])),
        log=True,
        band=band_hz,
    )


def response_curves(
    model: Actuator, listed: Actuator | None, equaliser: Equaliser | None, band_hz: Band
) -> Curves:
    """Return gains over frequency: of the actuator, of the filter, and of both.

    ``listed``: the actuator before its parameters were changed; None where it is not listed.
    """
    frequency_hz = frequencies_of(band_hz)
    rows: list[tuple[CurveName, Floats]]
    if equaliser is None:
        rows = [(_BEFORE, _alone_db(model, band_hz))]
    else:
        responses = curves(equaliser, model, frequency_hz, band_hz)
        rows = [
            (_BEFORE, responses.before_db),
            (_FILTER, responses.filter_db),
            (_AFTER, responses.after_db),
        ]
    if listed is not None and model != listed:
        rows.append((_PUBLISHED, _alone_db(listed, band_hz)))
    return Curves(
        x=frequency_hz,
        y=np.stack([values for _, values in rows]),
        names=tuple(name for name, _ in rows),
        kind="level",
        level_text="dB re the mean in the band",
        columns=tuple(f"{name.short.lower().replace(' ', '_')}_db" for name, _ in rows),
    )


def _alone_db(model: Actuator, band_hz: Band) -> Floats:
    frequency_hz = frequencies_of(band_hz)
    gain = np.abs(model.response(frequency_hz))
    in_band = gain[(band_hz[0] <= frequency_hz) & (band_hz[1] >= frequency_hz)]
    return decibels(gain / mean_of(in_band)) if in_band.any() else decibels(gain)


_DIGITS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One row of the table of predicted figures.

    Attributes
    ----------
    label, value, limit
        Texts; the limit is empty where there is none.
    exceeded
        Whether the limit is exceeded.
    """

    label: str
    value: str
    limit: str = ""
    exceeded: bool = False


_ROWS = (
    ("Peak acceleration", "peak_acceleration_m_per_s2", "m/s²", None),
    ("Displacement", "peak_displacement_m", "m", "displacement_m"),
    ("Peak voltage", "peak_voltage_v", "V", "peak_voltage_v"),
    ("RMS voltage", "rms_voltage_v", "V", "rms_voltage_v"),
    ("Slew rate", "slew_v_per_s", "V/s", "slew_v_per_s"),
    ("Peak current", "peak_current_a", "A", "peak_current_a"),
    ("RMS current", "rms_current_a", "A", "rms_current_a"),
    ("Mean power", "mean_power_w", "W", None),
    ("Duration", "duration_s", "s", "duration_s"),
    ("Duty cycle", "duty", "%", "duty"),
    ("Temperature rise", "temperature_rise_k", "K", None),
)


def rows_of(shown: ActuatorProfile, prediction: Prediction) -> tuple[Figure, ...]:
    """Return a row for each figure that is known, with its limit."""
    limits = shown.limits
    exceeded = {breach.name for breach in breaches(prediction, limits)}
    rows = []
    for label, name, unit, limit_name in _ROWS:
        value = getattr(prediction, name)
        limit = None if limit_name is None else getattr(limits, limit_name)
        # The duration is that of the design: only a limit makes it worth a row.
        if not isnan(value) and (limit is not None or name != "duration_s"):
            rows.append(
                Figure(
                    label=label,
                    value=_value_text(value, unit),
                    limit="" if limit is None else _value_text(limit, unit),
                    exceeded=limit_name in exceeded,
                )
            )
    # Above this velocity nothing breaks, but linearity of the skin was not measured.
    velocity = Figure(
        label="Peak velocity",
        value=_value_text(prediction.peak_velocity_m_per_s, "mm/s"),
        limit=_value_text(LARGEST_VELOCITY_M_PER_S, "mm/s"),
        exceeded=prediction.linear_share > 1.0,
    )
    return (rows[0], velocity, *rows[1:])


def _value_text(value: float, unit: str) -> str:
    if unit == "mm/s":
        return f"{1e3 * value:.{_DIGITS}g} mm/s"
    if unit == "%":
        return f"{100.0 * value:.{_DIGITS}g} %"
    return value_text(value, unit, _DIGITS)


class FiguresTable(QtWidgets.QLabel):
    """A table of label, value and limit; what exceeds its limit is red.

    Attributes
    ----------
    figures
        What it shows.
    """

    def __init__(self) -> None:
        super().__init__()
        named(self, "actuator_figures", "Predicted figures")
        self.setTextFormat(Qt.TextFormat.RichText)
        self.figures: tuple[Figure, ...] = ()

    def show_figures(self, figures: tuple[Figure, ...]) -> None:
        """Show these rows."""
        self.figures = figures
        self.setText(f"<table>{''.join(map(_row, figures))}</table>" if figures else "")
        self.setAccessibleDescription(
            "; ".join(
                f"{figure.label} {figure.value}" + (", beyond its limit" if figure.exceeded else "")
                for figure in figures
            )
        )

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.show_figures(self.figures)


def _row(figure: Figure) -> str:
    """Return a row of the table, as HTML."""
    theme = current_theme()
    colour = theme.error if figure.exceeded else theme.text
    limit = f"of {figure.limit}" if figure.limit else ""
    cells = (theme.dim, "left", figure.label), (colour, "right", figure.value)
    return "<tr>{}</tr>".format(
        "".join(
            f'<td align="{side}" style="color:{shade};padding-right:{UNIT_PX // 2}px">{text}</td>'
            for shade, side, text in (*cells, (colour, "left", limit))
        )
    )


_NOTHING = "No active input: add one to see the demands on the actuator"


class DemandView(QtWidgets.QWidget):
    """What a design asks of the actuator, in a line, or the reason why it cannot be played.

    Attributes
    ----------
    heading, refusal, limits, mend, table
        Its parts; the table of all figures is laid out elsewhere.
    """

    def __init__(self) -> None:
        super().__init__()
        self.heading = page_label("actuator_heading")
        self.refusal = page_label("actuator_refusal")
        self.limits = page_label("actuator_limits", tone="error")
        self.table = FiguresTable()
        self.mend = page_button("actuator_mend", "", "Change the clips so that it can follow")
        parts = self.heading, self.refusal, self.limits
        column = in_column(*parts, of=self, margins=0, gap_px=UNIT_PX // 4)
        column.addWidget(self.mend, 0, Qt.AlignmentFlag.AlignLeft)

    def show_demand(
        self, demand: Demand, shown: ActuatorProfile | None, *, mend: str = "", limb: str = ""
    ) -> None:
        """Show the figures of an actuator; ``mend``: the edit that lets it follow, if any."""
        rows: tuple[Figure, ...] = ()
        if shown is not None and demand.figures is not None:
            rows = rows_of(shown, demand.figures)
        self.table.show_figures(rows)
        reason = demand.refusal
        if shown is not None and demand.place is None:
            reason = reason or _NOTHING
        show_or_hide(self.refusal, reason)
        # Silence and results that are not ready yet are no errors.
        quiet = demand.place is None or demand.refusal in ("", PREPARING)
        set_tone(self.refusal, "dim" if quiet else "error")
        beyond = _beyond(rows)
        show_or_hide(self.limits, beyond)
        show_or_hide(self.mend, mend)
        text = ""
        if shown is not None and demand.place is not None:
            place = f"Place {demand.place}, {input_name(demand.place, limb).name}"
            peak = next((f": peak {row.value}" for row in rows if row.label == "Peak voltage"), "")
            part = f" in its strongest {LONGEST_S:g} s" if demand.part else ""
            gain = "" if shown.gain_calibrated else " (uncalibrated gain)"
            text = f"{place}{peak}{part}{gain}"
        show_or_hide(self.heading, text)


def _beyond(rows: tuple[Figure, ...]) -> str:
    """Return a sentence that names the figures beyond their limits; "" where there are none."""
    names = [row.label.lower() for row in rows if row.exceeded]
    return f"Beyond its limit: {', '.join(names)}" if names else ""
