"""A panel that is imported when it is first made."""

from dataclasses import dataclass
from importlib import import_module

from skinsource_gui.panel import Panel


@dataclass(frozen=True, slots=True)
class LatePanel:
    """What a window has to know of a panel before it is there.

    Called, it makes the panel: the class that has its name, with "Panel" behind, in the module
    ``panel`` of its folder.

    Attributes
    ----------
    name, title
        Those of its class.
    """

    name: str
    title: str

    @property
    def type(self) -> type[Panel]:
        """Its class, imported now if it was not before."""
        module = import_module(f"skinsource_gui.panels.{self.name}.panel")
        words = (word.capitalize() for word in self.name.split("_"))
        found: type[Panel] = getattr(module, f"{''.join(words)}Panel")
        if (found.name, found.title) != (self.name, self.title):
            raise ValueError(
                f"{found.__name__} says of itself {found.name!r}, {found.title!r}; the table of "
                f"panels says {self.name!r}, {self.title!r}. Make them the same."
            )
        return found

    def __call__(self) -> Panel:
        return self.type()
