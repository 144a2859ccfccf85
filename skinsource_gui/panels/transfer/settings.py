"""The settings of the panel of transfer, which are saved with a design."""

from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.spec import SwitchSpec

COHERENCE = SwitchSpec(label="Coherence", hint="In place of the magnitude")


@dataclass(frozen=True, slots=True, kw_only=True)
class TransferSettings:
    """Whether ``coherence`` is drawn in place of the magnitude."""

    coherence: bool = fields.switch(False, COHERENCE)

    def __post_init__(self) -> None:
        fields.check(self)
