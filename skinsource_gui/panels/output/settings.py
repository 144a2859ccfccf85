"""How the panel of the output shows what is chosen there."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.spec import SwitchSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class OutputSettings(fields.CheckedModel):
    """Whether parameters, figures and responses are unfolded."""

    more: bool = fields.switch(False, SwitchSpec(label="More"))
