"""How strong an input of amplitude 1 is."""

from typing import Literal, get_args

from skinsource.arguments import one_of

Scaling = Literal["upstream", "relative", "probe"]
SCALINGS: tuple[Scaling, ...] = get_args(Scaling)


def check_scaling(scaling: str) -> None:
    """Raise `InvalidInputError` unless ``scaling`` is one of `SCALINGS`."""
    one_of("scaling", scaling, SCALINGS)
