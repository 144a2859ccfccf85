"""Faster imports: modules that load only when they are used, and no reading of sources by PySide6.

``import scipy.fft`` runs ``from numpy import *``, which also imports the Fortran compiler of numpy
and its helpers for tests, a third of the time, which the studio never calls.

PySide6 searches the source of each module for its own name, because code may use other spellings
(``from __feature__ import snake_case``).  The studio does not, and this takes a tenth of its start.
There is no setting for it: the function that searches is replaced, in the pinned versions.
"""

import importlib.util
import sys
from collections.abc import Sequence

UNCALLED = ("numpy.f2py", "numpy.testing")


def make_lazy(names: Sequence[str] = UNCALLED) -> None:
    """Make each module of ``names`` lazy: it runs when an attribute of it is first used.

    Modules that are imported already stay as they are; those that do not exist are ignored.
    """
    for name in names:
        spec = None if name in sys.modules else importlib.util.find_spec(name)
        if spec is None or spec.loader is None:
            continue
        spec.loader = importlib.util.LazyLoader(spec.loader)
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
        package, _, own_name = name.rpartition(".")
        setattr(sys.modules[package], own_name, module)


_SEARCHES, _FEATURE = "_mod_uses_pyside", "shibokensupport.feature"


def leave_sources_unread() -> bool:
    """Keep PySide6 from reading sources; return whether its version allows that.

    PySide6 has to be imported before.
    """
    feature = sys.modules.get(_FEATURE)
    if not hasattr(feature, _SEARCHES):
        return False
    setattr(feature, _SEARCHES, lambda _module: True)
    return True
