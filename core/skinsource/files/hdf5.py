"""HDF5, imported when the first file is touched.

h5py takes tens of milliseconds to import, and neither the studio's window nor a synthetic limb
needs it.  scipy has no module like this one: ``import scipy`` imports its parts at first use.
"""

import importlib
from typing import Any


def __getattr__(name: str) -> Any:
    if name.startswith("__"):  # what Python asks of every module is not h5py's
        raise AttributeError(name)
    return getattr(importlib.import_module("h5py"), name)
