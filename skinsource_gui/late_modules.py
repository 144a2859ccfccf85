"""Modules of other packages that are imported when somebody uses them, and not before.

``import scipy.fft`` runs ``from numpy import *`` on its way, which brings all of numpy: also its
Fortran compiler and its helpers for tests, a third of that import, which the studio never calls.
"""

import importlib.util
import sys
from collections.abc import Sequence

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
