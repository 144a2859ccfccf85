"""Names of a package that are imported when they are first asked for.

Who needs few names of a large package shall not wait for the others: a start of the studio imports
what its window shows.  Such a package names its parts twice, for type checkers and for Python:

    if TYPE_CHECKING:
        from skinsource.actuators.rigs import Rig
    else:
        __getattr__, __dir__ = late_names(__name__, {"rig": "Rig"})

Who uses it imports the package, ``from skinsource import rigs``, and writes ``rigs.Rig`` where it
is needed; ``from skinsource.actuators.rigs import Rig`` imports the module of that name at once.
"""

import importlib
import sys
from collections.abc import Callable, Mapping, Sequence


def late_names(
    package: str, names: Mapping[str, str], packages: Sequence[str] = ()
) -> tuple[Callable[[str], object], Callable[[], list[str]]]:
    """Return ``__getattr__`` and ``__dir__`` of a package.

    No name may be that of a module of the package: Python would put the module in its place.

    Parameters
    ----------
    package
        Its ``__name__``.
    names
        Those of each module of the package, with spaces between them.
    packages
        Modules of the package that are names of it themselves.
    """
    homes = {name: home for home, group in names.items() for name in group.split()}

    def get(name: str) -> object:
        if name in packages:
            return importlib.import_module(f"{package}.{name}")
        if name not in homes:
            raise AttributeError(f"module '{package}' has no attribute '{name}'")
        found = getattr(importlib.import_module(f"{package}.{homes[name]}"), name)
        # The next time Python finds it by itself.
        setattr(sys.modules[package], name, found)
        return found

    def listed() -> list[str]:
        return sorted({*vars(sys.modules[package]), *homes, *packages})

    return get, listed
