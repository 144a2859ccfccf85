"""Between what is looked at and what a design is predicted through."""

from dataclasses import replace
from typing import Any

from skinsource.actuator_demand.settings import ActuatorSettings
from skinsource.actuators import MeasuredResponse, names, profile
from skinsource.chain import Actuation, ActuatorAt
from skinsource.equalising import Equaliser, PolePairReplacement, RegularisedInverse
from skinsource.fields import specs_of


def actuation_of(settings: ActuatorSettings) -> Actuation | None:
    """What predictions go through under these settings; None for a shape."""
    model: Any = settings.model
    if model is None:
        return None
    equaliser: Any = settings.made(model)
    one = ActuatorAt(actuator=settings.profile.title, model=model)
    return Actuation(actuators=(one,), equaliser=equaliser)


def settings_through(settings: ActuatorSettings, actuated: Actuation | None) -> ActuatorSettings:
    """The settings that stand for what a design is predicted through.

    As they were where it is not, or goes through what no settings stand for.
    """
    if actuated is None or len(actuated.actuators) > 1:
        return settings
    (one,) = actuated.actuators
    if isinstance(one.model, MeasuredResponse):
        found = settings.with_measured(one.model, one.actuator)
        found = replace(found, **_of(actuated.equaliser))
        return found if actuation_of(found) == actuated else settings
    listed = next((name for name in names() if profile(name).title == one.actuator), None)
    if listed is None or type(profile(listed).model) is not type(one.model):
        return settings
    before = profile(listed).model
    changed = tuple(
        (name, getattr(one.model, name))
        for name in specs_of(one.model)
        if getattr(one.model, name) != getattr(before, name)
    )
    found = replace(settings, actuator=listed, parameters=changed, **_of(actuated.equaliser))
    # The same values in another order are the same settings.
    if dict(found.parameters) == dict(settings.parameters):
        found = replace(found, parameters=settings.parameters)
    return found if actuation_of(found) == actuated else settings


def _of(equaliser: Equaliser | None) -> dict[str, Any]:
    """Settings of an equaliser."""
    if isinstance(equaliser, RegularisedInverse):
        phase, boost_db = equaliser.phase, equaliser.boost_db
        return {"equaliser": "inverse", "boost_db": boost_db, "phase": phase}
    if isinstance(equaliser, PolePairReplacement):
        return {"equaliser": "pole_pair", "new_quality": equaliser.new_quality}
    return {"equaliser": "none"}
