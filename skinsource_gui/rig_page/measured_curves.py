"""What was measured of an actuator, beside what is known of it."""

import numpy as np

from skinsource.actuators.actuator import Actuator
from skinsource.actuators.catalog import names, profile
from skinsource.actuators.rigs import RigChannel
from skinsource.base.arrays import Floats
from skinsource.base.decibels import decibels
from skinsource.base.published import BAND_HZ
from skinsource.lab.rig_measuring import ChannelMeasurement
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.plot.axis_spec import XAxis
from skinsource_gui.widgets.plot.curves import CurveName, Curves

_MEASURED = CurveName(number=1, short="Measured", full="What was measured now")
_MODEL = CurveName(number=2, short="Model", full="What the library knows of the actuator")
_BEFORE = CurveName(number=3, short="Before", full="What the channel has from before")


def model_of(channel: RigChannel) -> Actuator | None:
    """How the channel moves as far as a model says; None: there is none."""
    if channel.model is not None:
        return channel.model
    if channel.actuator in names():
        found = profile(channel.actuator).model
        return found if isinstance(found, Actuator) else None
    return None


def axis_of(found: ChannelMeasurement) -> XAxis:
    """Frequencies of the measurement."""
    points = found.response.points
    return XAxis(
        titles=("Frequency (Hz)",),
        unit="Hz",
        column="frequency_hz",
        extent=(points[0][0], points[-1][0]),
        log=True,
        # An actuator belongs to no limb: shown is where most know how skin answers.
        band=BAND_HZ,
    )


def measured_curves(found: ChannelMeasurement, channel: RigChannel) -> Curves:
    """Gains at the points that were measured: measured, of the model, and of the time before."""
    hz = np.array([point[0] for point in found.response.points])
    rows: list[tuple[CurveName, Floats]] = [(_MEASURED, _db(found.response, hz))]
    model = model_of(channel)
    if model is not None:
        rows.append((_MODEL, _db(model, hz)))
    if channel.measured is not None and channel.measured != found.response:
        rows.append((_BEFORE, _db(channel.measured, hz)))
    return Curves(
        x=hz,
        y=np.stack([values for _, values in rows]),
        names=tuple(name for name, _ in rows),
        kind="level",
        level_words="dB re 1 m/s² per V",
        columns=tuple(f"{name.short.lower()}_db" for name, _ in rows),
    )


def beside_the_model(found: ChannelMeasurement, channel: RigChannel) -> tuple[str, ...]:
    """How far the gain is from that of the model, as a sentence; nothing without a model."""
    model = model_of(channel)
    if model is None:
        return ()
    hz = np.array([point[0] for point in found.response.points])
    apart_db = _db(found.response, hz) - _db(model, hz)
    worst = int(np.abs(apart_db).argmax())
    away = minus(f"{apart_db[worst]:+z.1f} dB")
    return (f"It is at most {away} from the model, at {hz[worst]:.3g} Hz.",)


def _db(model: Actuator, hz: Floats) -> Floats:
    return decibels(np.abs(model.response(hz)))
