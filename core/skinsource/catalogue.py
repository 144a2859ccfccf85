"""Which limbs there are."""

from skinsource.dataset.store import is_installed, load_measured_limb
from skinsource.errors import UnknownLimbError
from skinsource.limb import LIMB_NAMES, Limb
from skinsource.quoting import quoted
from skinsource.synthetic import load_synthetic_limb


def available_limbs() -> tuple[str, ...]:
    """Names of the limbs that can be loaded now, measured ones first."""
    installed = is_installed()
    return tuple(name for name in LIMB_NAMES if installed or not name.startswith("measured"))


def load_limb(name: str) -> Limb:
    """Open a limb.  Its responses are read when touched.

    Parameters
    ----------
    name
        ``"measured-1"`` to ``"measured-4"``, ``"synthetic-1"`` to ``"synthetic-4"``.

    Raises
    ------
    UnknownLimbError
        There is no such limb.
    DatasetMissingError
        It is a measured one, and the measured dataset is not installed.
    """
    if not isinstance(name, str) or name not in LIMB_NAMES:
        raise UnknownLimbError(
            f"the limb {quoted(name)} is not available here; choose one of "
            f"{', '.join(available_limbs())}"
        )
    kind, number = name.split("-")
    load = load_measured_limb if kind == "measured" else load_synthetic_limb
    return load(int(number))


def default_limb() -> str:
    """Name of the limb to start on: measured where installed, else synthetic."""
    return available_limbs()[0]
