"""What the panel draws, as plain arrays."""

from functools import lru_cache
from typing import Any

import numpy as np

from skinsource.actuators.actuator import Actuator, ResponseShape
from skinsource.actuators.equalising import curves
from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.base.published import Band
from skinsource.engine.actuator_demand import ActuatorSettings
from skinsource_gui.widgets.plot.axis_spec import XAxis
from skinsource_gui.widgets.plot.curves import CurveName, Curves

# What is drawn at least, and how far beyond the band: what the equaliser lets go is seen.
_SHOWN_HZ, _BELOW, _ABOVE, _POINTS = (10.0, 2000.0), 0.4, 2.0, 500
#: A step of the drive, low-passed by the band, and what comes after it.
STEP_RATE_HZ, STEP_S, STEP_AT_S = 13_000, 0.1, 0.01

TIME_AXIS = XAxis(titles=("Time (ms)",), unit="ms", factor=1e3, column="time_s")
_BEFORE = CurveName(number=0, short="Actuator", full="The actuator alone, re its mean in the band")
_FILTER = CurveName(number=0, short="Filter", full="Voltage that the equaliser asks for")
_AFTER = CurveName(number=0, short="Equalised", full="Both together: what the contactor does")
_PUBLISHED = CurveName(number=0, short="As listed", full="The actuator before it was changed")
_ALONE = CurveName(number=0, short="1 V", full="Acceleration after 1 V came on")


@lru_cache(maxsize=8)
def frequencies_of(band_hz: Band) -> Floats:
    """Frequencies that are drawn on a limb that is followed in a band, (500,)."""
    low = min(_SHOWN_HZ[0], _BELOW * band_hz[0])
    found = np.geomspace(low, max(_SHOWN_HZ[1], _ABOVE * band_hz[1]), _POINTS)
    found.flags.writeable = False
    return found


@lru_cache(maxsize=8)
def frequency_axis(band_hz: Band) -> XAxis:
    """The axis of these frequencies."""
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


def response_curves(settings: ActuatorSettings, band_hz: Band) -> Curves:
    """Gains over frequency: of the actuator, of the filter, and of both."""
    frequency_hz = frequencies_of(band_hz)
    model = settings.model
    published: Any = settings.profile.model
    rows: list[tuple[CurveName, Floats]]
    if isinstance(published, ResponseShape) or model is None:
        rows = [(_BEFORE, decibels(np.abs(published.shape(frequency_hz))))]
        return _drawn(frequency_hz, rows, "dB", ("a shape without a scale", "shape"))
    equaliser = settings.made(model)
    if equaliser is None:
        rows = [(_BEFORE, _alone_db(model, band_hz))]
    else:
        found = curves(equaliser, model, frequency_hz, band_hz)
        rows = [
            (_BEFORE, found.before_db),
            (_FILTER, found.filter_db),
            (_AFTER, found.after_db),
        ]
    if isinstance(published, Actuator) and model != published:
        rows.append((_PUBLISHED, _alone_db(published, band_hz)))
    return _drawn(frequency_hz, rows, "dB re the mean in the band")


def step_curves(settings: ActuatorSettings) -> Curves | None:
    """Acceleration after a voltage of 1 V came on; None for a shape."""
    model, published = settings.model, settings.profile.model
    if model is None:
        return None
    n = int(STEP_S * STEP_RATE_HZ)
    time_s = np.arange(n) / STEP_RATE_HZ - STEP_AT_S
    voltage = (time_s >= 0.0).astype(float)
    rows = [(_ALONE, model.simulate(voltage, STEP_RATE_HZ).acceleration)]
    if isinstance(published, Actuator) and model != published:
        rows.append((_PUBLISHED, published.simulate(voltage, STEP_RATE_HZ).acceleration))
    return _drawn(time_s, rows, "", ("acceleration after a step of 1 V", "step of 1 V"))


def _alone_db(model: Actuator, band_hz: Band) -> Floats:
    frequency_hz = frequencies_of(band_hz)
    gain = np.abs(model.response(frequency_hz))
    in_band = gain[(band_hz[0] <= frequency_hz) & (band_hz[1] >= frequency_hz)]
    moving = in_band[in_band > 0.0]
    mean = float(np.exp(np.mean(np.log(moving)))) if moving.size else 1.0
    return decibels(gain / mean)


def _drawn(
    x: Floats,
    rows: list[tuple[CurveName, Floats]],
    level_words: str,
    scaling: tuple[str, ...] = (),
) -> Curves:
    """Curves of rows: levels where there are words for them, else accelerations."""
    unit = "db" if level_words else "m_per_s2"
    return Curves(
        x=x,
        y=np.stack([values for _, values in rows]),
        names=tuple(name for name, _ in rows),
        kind="level" if level_words else "amplitude",
        level_words=level_words,
        scaling=scaling,
        columns=tuple(f"{name.short.lower().replace(' ', '_')}_{unit}" for name, _ in rows),
    )
