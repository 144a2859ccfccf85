"""How the panel of the output shows what is chosen there."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec

PICTURE = ChoiceSpec(label="Picture", options=(("response", "Response"), ("step", "Step")))
LAYOUT = ChoiceSpec(label="Layout", options=(("overlaid", "Overlaid"), ("stacked", "Stacked")))


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputSettings(fields.CheckedModel):
    """How the panel shows what is chosen there.

    Attributes
    ----------
    more
        Whether parameters, figures and responses are unfolded.
    picture
        ``"response"`` over frequency or ``"step"`` over time.
    """

    more: bool = fields.switch(False, SwitchSpec(label="More"))
    picture: str = fields.choice("response", PICTURE)
    layout: str = fields.choice("overlaid", LAYOUT)
    zoom: Range | None = fields.interval(None, RangeSpec(label="Zoom"))
