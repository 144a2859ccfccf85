"""What only the traces look at."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import ChoiceSpec

LAYOUT = ChoiceSpec(
    label="Layout",
    options=(("overlaid", "Overlaid"), ("stacked", "Stacked")),
    hint="All curves over each other, or each in its own row",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class TracesSettings:
    """How traces are drawn: ``layout`` is ``"overlaid"`` or ``"stacked"``."""

    layout: str = fields.choice("overlaid", LAYOUT)

    def __post_init__(self) -> None:
        fields.check(self)
