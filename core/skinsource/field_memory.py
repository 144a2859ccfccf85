"""Remembers the unit field of each input, so that an edit of one input computes one field."""

from collections import OrderedDict
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skinsource.design import Input
from skinsource.limb import Limb
from skinsource.response import Scaling, input_field, unit_gain
from skinsource.waveforms import Waveform

#: About twenty inputs of one second each.
DEFAULT_BUDGET_BYTES = 256 * 2**20


@dataclass(frozen=True, slots=True, eq=False)
class UnitField:
    """Field of one input at amplitude 1.

    Attributes
    ----------
    acceleration : (72 outputs, 3 axes, n_times)
        Before any gain, m/s², read-only.
    gain
        What the scaling multiplies it with.
    """

    acceleration: NDArray[np.float64]
    gain: float


_Key = tuple[str, Waveform, float, int, int, Scaling]


class FieldMemory:
    """Unit fields by limb, waveform, onset, place, length and scaling; least recently used go.

    What comes out does not depend on what is remembered: a field is computed on its own.
    """

    def __init__(self, budget_bytes: int = DEFAULT_BUDGET_BYTES) -> None:
        self._budget_bytes = budget_bytes
        self._fields: OrderedDict[_Key, UnitField] = OrderedDict()
        self.fields_computed = 0

    def unit_fields(
        self,
        limb_data: Limb,
        audible: tuple[Input, ...],
        drives: NDArray[np.float64],
        scaling: Scaling,
    ) -> tuple[UnitField, ...]:
        """Unit field of each audible input, in order."""
        return tuple(
            self._field(limb_data, one, drive, scaling)
            for one, drive in zip(audible, drives, strict=True)
        )

    def _field(
        self, limb: Limb, one: Input, drive: NDArray[np.float64], scaling: Scaling
    ) -> UnitField:
        key = (limb.name, one.waveform, one.onset_s, one.location, drive.size, scaling)
        field = self._fields.pop(key, None)
        if field is None:
            acceleration = input_field(limb, one.location, drive, scaling)
            acceleration.flags.writeable = False
            field = UnitField(acceleration, unit_gain(acceleration, scaling))
            self.fields_computed += 1
        self._fields[key] = field
        self._forget()
        return field

    def _forget(self) -> None:
        held = sum(field.acceleration.nbytes for field in self._fields.values())
        while held > self._budget_bytes and self._fields:
            _, oldest = self._fields.popitem(last=False)
            held -= oldest.acceleration.nbytes
