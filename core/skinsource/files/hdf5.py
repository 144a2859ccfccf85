"""HDF5, imported when the first file is touched.

h5py takes tens of milliseconds to import, and neither the studio's window nor a synthetic limb
needs it.  scipy has no module like this one: ``import scipy`` imports its parts at first use.
"""

import importlib
from types import ModuleType
from typing import Any


def __getattr__(name: str) -> Any:
    if name.startswith("__"):  # what Python asks of every module is not h5py's
        raise AttributeError(name)
    return getattr(_h5py(), name)


def own_member(group: Any, name: str, kind: type) -> Any:
    """Member of a group that lies in this very file and is of ``kind``; None where none is."""
    # A link could lead into any other file.
    is_here = isinstance(group.get(name, getlink=True), _h5py().HardLink)
    member = group[name] if is_here else None
    return member if isinstance(member, kind) else None


def _h5py() -> ModuleType:
    return importlib.import_module("h5py")
