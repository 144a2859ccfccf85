"""Modules of other packages that are imported when somebody uses them, and not before.

``import scipy.fft`` runs ``from numpy import *`` on its way, which brings all of numpy: also its
Fortran compiler and its helpers for tests, a third of that import, which the studio never calls.
"""

import importlib.util
import sys
from collections.abc import Sequence
from types import ModuleType

UNCALLED = ("numpy.f2py", "numpy.testing")


def leave_for_use(names: Sequence[str] = UNCALLED) -> None:
    """Have each of ``names`` run when something of it is first asked for; none of them runs now.

    What was imported already stays as it is, and what does not exist is left to who imports it.
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


# Keeps PySide6 from reading the source of all that is imported after it.
#
# PySide6 looks into the source of each module for its own name, because code that uses it may have
# asked for other spellings (``from __feature__ import snake_case``).  The studio asks for none, and
# has no use for a tenth of its start being spent on that.  There is no setting for it: what looks
# is replaced, in the versions that the project is pinned to.

_LOOKS, _WHERE = "_mod_uses_pyside", "shibokensupport.feature"


def leave_sources_unread() -> bool:
    """Have each module taken for one that uses PySide6 as it is; whether PySide6 lets us.

    To be called once PySide6 is imported; another version than the pinned ones may go on reading.
    """
    feature = sys.modules.get(_WHERE)
    if not hasattr(feature, _LOOKS):
        return False
    setattr(feature, _LOOKS, _uses_it_as_it_is)
    return True


def _uses_it_as_it_is(module: ModuleType) -> bool:
    del module
    return True
