"""A partial limb: some places of a person's hand, measured from some inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np

from skinsource.base.arguments import checking, finite_array
from skinsource.base.conventions import Axes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb, limb_like

#: Largest magnitude of a response.
_LARGEST = 1e30


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class PartialLimb:
    """Responses of one person at some outputs; checked when it is made.

    Attributes
    ----------
    person
        Code of the person.
    like
        Name of the limb whose places, axes, sample rate, drive and delay it has.
    inputs, outputs
        Places that were measured, from 1.
    responses : (n_inputs, n_outputs, n_axes, n_taps)
        Of the inputs and outputs that were measured, in their order, m/s².
    mounting, posture, sensor
        How the sensor was fixed, how the hand lay, and what measured.
    dates
        Day on which each output was measured, in their order; empty: not known.

    Raises
    ------
    InvalidInputError
        There is no such place, a place comes twice, or the responses have another shape.
    """

    person: str
    like: str
    inputs: tuple[int, ...]
    outputs: tuple[int, ...]
    responses: Floats
    mounting: str = ""
    posture: str = ""
    sensor: str = ""
    dates: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<PartialLimb of {self.person}: outputs {', '.join(map(str, self.outputs))}>"

    def __post_init__(self) -> None:
        whole = limb_of(self.like)
        for name, places, n in (
            ("inputs", self.inputs, whole.n_inputs),
            ("outputs", self.outputs, whole.n_outputs),
        ):
            if not places or len(set(places)) < len(places) or not {*places} <= {*range(1, n + 1)}:
                raise InvalidInputError(
                    f"{name} are {list(places)}, expected one or more of 1 to {n}, each once"
                )
        expected = "finite numbers in m/s², (n_inputs, n_outputs, n_axes, n_taps)"
        responses = finite_array("responses", self.responses, expected, _LARGEST)
        shape = len(self.inputs), len(self.outputs), whole.n_axes
        if responses.ndim != 4 or responses.shape[:3] != shape or not responses.shape[3]:
            raise InvalidInputError(
                f"responses have the shape {responses.shape}, expected (n_inputs, n_outputs, "
                f"n_axes, n_taps) with {shape} first"
            )
        if self.dates and len(self.dates) != len(self.outputs):
            raise InvalidInputError(
                f"there are {len(self.dates)} dates, expected {len(self.outputs)}, one for each "
                "output"
            )

    @cached_property
    def limb(self) -> Limb:
        """The limb ``like``, with the person's responses where there are some, and 0 elsewhere."""
        whole = limb_of(self.like)
        n_taps = self.responses.shape[-1]
        rows = np.array(self.outputs) - 1

        def read(place: int) -> Floats:
            response = np.zeros((whole.n_outputs, whole.n_axes, n_taps))
            if place in self.inputs:
                response[rows] = self.responses[self.inputs.index(place)]
            return response

        return limb_like(
            whole,
            read_response=read,
            shape=(whole.n_inputs, whole.n_outputs, whole.n_axes, n_taps),
        )

    @property
    def axes(self) -> Axes:
        """Along which it was measured: along others of the limb all responses are 0."""
        measured = self.responses.any(axis=(0, 1, 3))
        return cast(Axes, "".join(np.array([*limb_of(self.like).axes])[measured]))

    def check_measured(self, output: int) -> None:
        """Raise `InvalidInputError` unless an output was measured."""
        if output not in self.outputs:
            raise InvalidInputError(
                f"output {output} of {self.person} was not measured, and nothing can stand in for "
                f"it. Choose one of {', '.join(map(str, self.outputs))}, or measure it."
            )


@checking
def partial(limb: Limb | str, outputs: Sequence[int]) -> PartialLimb:
    """Return some outputs of a limb as if no others had been measured, for trials.

    Parameters
    ----------
    limb
        From `load_limb`, or its name, which becomes the code of the person.
    outputs
        From 1.

    Raises
    ------
    InvalidInputError
        There is no such output, or one comes twice.

    Examples
    --------
    >>> import skinsource as ss
    >>> ss.people.partial("synthetic-1", [9, 21])
    <PartialLimb of synthetic-1: outputs 9, 21>
    """
    whole = limb_of(limb)
    chosen = tuple(outputs)
    inputs = tuple(range(1, whole.n_inputs + 1))
    rows = [output - 1 for output in chosen if 1 <= output <= whole.n_outputs]
    return PartialLimb(
        person=whole.name,
        like=whole.name,
        inputs=inputs,
        outputs=chosen,
        responses=np.stack([whole.response_to(place)[rows] for place in inputs]),
    )
