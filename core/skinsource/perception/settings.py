"""What is chosen of thresholds."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from skinsource import fields
from skinsource.fields import NumberSpec, PlainSpec, TextSpec
from skinsource.perception.threshold_table import ThresholdTable
from skinsource.perception.thresholds import REFERENCE_AREA_CM2

AREA = NumberSpec(
    label="Area",
    unit="cm²",
    minimum=0.01,
    maximum=100.0,
    step=0.1,
    hint="Area that moves: 2.9 cm² for waves that spread; smaller ones raise the threshold of P",
)
TABLE = PlainSpec(label="Own thresholds")
SOURCE = TextSpec(label="File of own thresholds", longest=200, one_line=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class PerceptionSettings:
    """Thresholds that levels are held against.

    Attributes
    ----------
    area_cm2
        See `skinsource.perception.threshold_rms`.
    table
        Own thresholds, see `read_threshold_table`; none: those of the model.
    source
        Name of the file that they come from.
    """

    area_cm2: float = fields.number(REFERENCE_AREA_CM2, AREA)
    table: Any = fields.field(TABLE, ())
    source: str = fields.text("", SOURCE)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def thresholds(self) -> ThresholdTable:
        """Own thresholds; none where what is held is no table."""
        pairs = self.table if isinstance(self.table, tuple) else ()
        # A file is held flat: frequency, threshold, frequency, ...
        numbers = [one for one in pairs if isinstance(one, int | float)]
        found = tuple(zip(numbers[::2], numbers[1::2], strict=False))
        rising = all(a[0] < b[0] for a, b in pairwise(found))
        sound = all(f > 0.0 and a > 0.0 for f, a in found)
        return found if len(found) > 1 and rising and sound else ()


def held(table: ThresholdTable) -> tuple[float, ...]:
    """A table as settings hold it."""
    return tuple(number for pair in table for number in pair)
