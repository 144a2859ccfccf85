"""Limbs that a lab has measured itself: what they hold, and where they are kept."""

from skinsource.own_limbs.content import (
    MOST_INPUTS,
    MOST_OUTPUTS,
    NAME_RULE,
    OwnLimb,
    is_free_name,
)
from skinsource.own_limbs.known import (
    axes_on,
    drive_unit_known,
    facts_of,
    missing_limb,
    outputs_on,
    own_map,
)
from skinsource.own_limbs.store import (
    install_limb,
    load_own_limb,
    mirror_limb,
    own_limb_names,
    own_limb_path,
    remove_limb,
)

__all__ = [
    "MOST_INPUTS",
    "MOST_OUTPUTS",
    "NAME_RULE",
    "OwnLimb",
    "axes_on",
    "drive_unit_known",
    "facts_of",
    "install_limb",
    "is_free_name",
    "load_own_limb",
    "mirror_limb",
    "missing_limb",
    "outputs_on",
    "own_limb_names",
    "own_limb_path",
    "own_map",
    "remove_limb",
]
