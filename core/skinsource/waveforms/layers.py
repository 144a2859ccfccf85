"""Several clips as one waveform."""

from dataclasses import dataclass
from functools import reduce
from typing import ClassVar, Literal

import numpy as np

from skinsource import fields
from skinsource.arrays import Floats
from skinsource.clips.clip import Clip
from skinsource.fields import ChoiceSpec, ListSpec, RecipeSpec
from skinsource.waveforms.instants import count_of

Mode = Literal["sum", "product"]

#: Clips in one group; groups may stand in groups.
MAX_PARTS = 100

PARTS = ListSpec(
    label="Parts",
    of=RecipeSpec(label="Clip", kinds=lambda: (Clip,)),
    fewest=1,
    most=MAX_PARTS,
    hint="Clips, as they lie to each other",
)
MODE = ChoiceSpec(
    label="Together",
    options=(("sum", "Sum"), ("product", "Product")),
    hint="A product is 0 where one of the parts does not play",
)


@dataclass(frozen=True, slots=True)
class Layers:
    r"""Clips that are added up, or multiplied, and played as one; its peak need not be 1.

    .. math:: x(t) = \sum_k g_k x_k(t - t_k) \quad\text{or}\quad \prod_k g_k x_k(t - t_k)

    Each part is sampled at its own instants.  A muted one takes no part, but its length counts.

    Attributes
    ----------
    parts
        Clips; their onsets count from the start of the whole.
    mode
        ``"sum"`` or ``"product"``; the product is 0 where a part does not play.
    """

    title: ClassVar[str] = "Layers"

    parts: tuple[Clip, ...] = fields.field(PARTS, factory=lambda: (Clip(),))
    mode: Mode = fields.choice("sum", MODE)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def duration_s(self) -> float:
        """To the end of the last part."""
        return max(one.end_s for one in self.parts)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,); its peak follows from the parts."""
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        heard = [self._placed(one, n, sample_rate_hz, shift_s) for one in self._in_order()]
        if not heard:
            return np.zeros(n)
        together = np.multiply if self.mode == "product" else np.add
        total: Floats = reduce(together, heard)
        return total

    def _in_order(self) -> list[Clip]:
        # The order in which they are listed plays no part, not even for rounding.
        return sorted(
            (one for one in self.parts if not one.muted),
            key=lambda one: (one.onset_s, one.gain, repr(one)),
        )

    def _placed(self, one: Clip, n: int, sample_rate_hz: float, shift_s: float) -> Floats:
        first, own = one.sampled(sample_rate_hz, shift_s)
        found = np.zeros(n)
        within = own[: max(n - first, 0)]
        found[first : first + within.size] = one.gain * within
        return found
