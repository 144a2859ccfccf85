"""The view on a design, and the settings of panels in it."""

import math
from dataclasses import dataclass

import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.design import View
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec, TextSpec


@pytest.mark.parametrize(
    "panels",
    [
        *[("skin",), (("skin",),), ((1, ()),), (("", ()),)],
        (("skin", ()), ("skin", ())),
        (("skin", (("a", 1), ("a", 2))),),
        *[(("skin", (("a", value),)),) for value in ([1], math.nan, object(), "b" * 20_000)],
        tuple((f"panel {k}", ()) for k in range(10_000)),
    ],
)
def test_settings_that_are_not_plain_pairs_are_refused(panels):
    with pytest.raises(InvalidInputError, match=r"View\.panels is"):
        View(panels=panels)


def test_settings_of_panels_are_held_by_name():
    view = View(panels=(("skin", (("b", 1.5), ("a", None))), ("map", (("c", (1.0, 2.0)),))))
    other = View(panels=(("map", (("c", (1.0, 2.0)),)), ("skin", (("a", None), ("b", 1.5)))))
    assert view == other
    assert hash(view) == hash(other)


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings(fields.CheckedModel):
    style: str = fields.choice("round", ChoiceSpec(label="", options=(("round", ""), ("flat", ""))))
    shown: bool = fields.switch(True, SwitchSpec(label=""))
    zoom: Range | None = fields.interval(None, RangeSpec(label=""))
    note: str = fields.text("", TextSpec(label="", longest=5))


def test_settings_come_back_and_each_panel_has_its_own():
    chosen = Settings(style="flat", shown=False, zoom=(1, 2.5), note="hello")
    view = with_settings(View(axes="z"), "dial", chosen)
    assert settings_of(view, "dial", Settings) == chosen
    assert settings_of(view, "clock", Settings) == Settings()
    assert view.axes == "z"
    # Views that look alike are equal.
    assert with_settings(view, "dial", Settings()) == View(axes="z")


def test_a_field_that_this_version_does_not_know_is_kept():
    view = View(panels=(("dial", (("later", 3), ("style", "flat"))),))
    assert settings_of(view, "dial", Settings) == Settings(style="flat")
    changed = with_settings(view, "dial", Settings(shown=False))
    assert changed.panels == (("dial", (("later", 3), ("shown", False))),)


@pytest.mark.parametrize("field", [("style", "square"), ("shown", 1), ("zoom", (2.0, 1.0))])
def test_a_value_that_does_not_fit_gives_way_to_the_default(field):
    view = View(panels=(("dial", (field,)),))
    assert settings_of(view, "dial", Settings) == Settings()
