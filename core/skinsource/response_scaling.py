"""How strong an input of amplitude 1 is."""

from typing import Literal, get_args

from skinsource.errors import InvalidInputError
from skinsource.wording import quoted

Scaling = Literal["upstream", "relative", "probe"]
SCALINGS: tuple[Scaling, ...] = get_args(Scaling)


def check_scaling(scaling: str) -> None:
    """Raise `InvalidInputError` unless ``scaling`` is one of `SCALINGS`."""
    if scaling not in SCALINGS:
        raise InvalidInputError(
            f"scaling {quoted(scaling)} is not known; choose from {', '.join(SCALINGS)}"
        )
