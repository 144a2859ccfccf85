"""Keeps PySide6 from reading the source of all that is imported after it.

PySide6 looks into the source of each module for its own name, because code that uses it may have
asked for other spellings (``from __feature__ import snake_case``).  The studio asks for none, and
has no use for a tenth of its start being spent on that.  There is no setting for it: what looks
is replaced, in the versions that the project is pinned to.
"""

import sys
from types import ModuleType

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
