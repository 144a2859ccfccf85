"""What only one panel looks at."""

from dataclasses import dataclass

import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec, TextSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    style: str = fields.choice("round", ChoiceSpec(label="", options=(("round", ""), ("flat", ""))))
    shown: bool = fields.switch(True, SwitchSpec(label=""))
    zoom: Range | None = fields.interval(None, RangeSpec(label=""))
    note: str = fields.text("", TextSpec(label="", longest=5))

    def __post_init__(self):
        fields.check(self)


def test_a_view_that_holds_nothing_gives_the_defaults():
    assert settings_of(View(), "dial", Settings) == Settings()


def test_settings_come_back_and_each_panel_has_its_own():
    chosen = Settings(style="flat", shown=False, zoom=(1, 2.5), note="hello")
    view = with_settings(View(axes="z"), "dial", chosen)
    assert settings_of(view, "dial", Settings) == chosen
    assert settings_of(view, "clock", Settings) == Settings()
    assert view.axes == "z"


def test_views_that_look_alike_are_equal():
    view = with_settings(View(), "dial", Settings(style="flat"))
    assert view != View()
    assert with_settings(view, "dial", Settings()) == View()


def test_a_field_that_this_version_does_not_know_is_kept():
    view = View(panels=(("dial", (("later", 3), ("style", "flat"))),))
    assert settings_of(view, "dial", Settings) == Settings(style="flat")
    changed = with_settings(view, "dial", Settings(shown=False))
    assert changed.panels == (("dial", (("later", 3), ("shown", False))),)


@pytest.mark.parametrize(
    "field",
    [("style", "square"), ("style", 1), ("shown", 1), ("zoom", (2.0, 1.0)), ("note", "longer")],
)
def test_a_value_that_does_not_fit_gives_way_to_the_default(field):
    view = View(panels=(("dial", (field,)),))
    assert settings_of(view, "dial", Settings) == Settings()
    with pytest.raises(InvalidInputError, match=f"Settings.{field[0]} "):
        Settings(**dict([field]))
