"""All limbs that can be loaded, by name."""

from skinsource.base.arguments import checking
from skinsource.base.conventions import LIMB_NAMES
from skinsource.base.errors import InvalidInputError, UnknownLimbError, quoted
from skinsource.limbs.dataset.store import is_installed, load_measured_limb
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of, load_own_limb, missing_limb, own_limb_names
from skinsource.limbs.synthetic import load_synthetic_limb


def available_limbs() -> tuple[str, ...]:
    """Return the names of the limbs that can be loaded now: measured, synthetic and imported.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.available_limbs()[-1])
    synthetic-4
    """
    installed = is_installed()
    built_in = (name for name in LIMB_NAMES if installed or not name.startswith("measured"))
    return *built_in, *own_limb_names()


@checking
def load_limb(name: str, digest: str = "") -> Limb:
    """Open a limb.  Its responses are read when touched.

    Parameters
    ----------
    name
        ``"measured-1"`` to ``"measured-4"``, ``"synthetic-1"`` to ``"synthetic-4"``, or that of a
        limb that was imported.
    digest
        Of an imported limb, as a design knows it; empty: whichever has this name.

    Raises
    ------
    UnknownLimbError
        There is no such limb.
    InvalidInputError
        The imported limb of this name has other numbers than ``digest`` says.
    FileFormatError, StorageError
        Its file is damaged, or cannot be read.
    DatasetMissingError
        It is a measured one, and the measured dataset is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> limb = ss.load_limb("synthetic-1")
    >>> print(limb.n_inputs, limb.n_outputs, limb.axes, limb.sample_rate_hz)
    20 72 xyz 1300.0
    """
    if isinstance(name, str) and name in own_limb_names():
        if digest and facts_of(name).known:
            missing = missing_limb(name, digest)
            if missing:
                raise InvalidInputError(missing)
        return load_own_limb(name)
    if not isinstance(name, str) or name not in LIMB_NAMES:
        if isinstance(name, str) and digest:
            # None of the others is that of the design: which to import is what matters.
            raise UnknownLimbError(missing_limb(name, digest))
        raise UnknownLimbError(
            f"the limb {quoted(name)} is not available here; choose one of "
            f"{', '.join(available_limbs())}"
        )
    kind, number = name.split("-")
    load = load_measured_limb if kind == "measured" else load_synthetic_limb
    return load(int(number))


def limb_of(limb: Limb | str) -> Limb:
    """Return a limb, which is opened where only its name is given.

    Raises
    ------
    InvalidInputError
        It is neither a limb nor the name of one.
    """
    if isinstance(limb, str):
        return load_limb(limb)
    if not isinstance(limb, Limb):
        raise InvalidInputError(f"limb is {quoted(limb)}, expected a Limb or the name of one")
    return limb


def default_limb() -> str:
    """Return the name of the limb to start on: measured where installed, else synthetic."""
    return available_limbs()[0]
