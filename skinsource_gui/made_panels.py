"""The panels of a window that somebody has looked at."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

from skinsource_gui.panel import Panel

#: Does what is to be done once with each panel.
Meet = Callable[[Panel], object]


class MadePanels:
    """Makes each panel when it first comes into sight or is asked for, and knows those it made.

    What has to do with panels goes through those there are, each time anew, and says with `each`
    what is to be done with one when it is made.

    Parameters
    ----------
    makers
        What makes each, by its name, in the order in which the keyboard reaches them.
    """

    def __init__(self, makers: Mapping[str, Callable[[], Panel]]) -> None:
        self._makers = makers
        self._made: dict[str, Panel] = {}
        self._in_order: tuple[Panel, ...] = ()
        self._meetings: list[Meet] = []

    @classmethod
    def of(cls, *panels: Panel) -> "MadePanels":
        """Panels that stand already."""
        made = cls({panel.name: partial(_itself, panel) for panel in panels})
        for panel in panels:
            made[panel.name]
        return made

    def __iter__(self) -> Iterator[Panel]:
        # One that is made meanwhile does not come into it.
        return iter(self._in_order)

    def __contains__(self, name: str) -> bool:
        """Whether the panel of that name was made."""
        return name in self._made

    def __getitem__(self, name: str) -> Panel:
        """The panel of that name; it is made if nobody has wanted it before."""
        panel = self._made.get(name)
        if panel is None:
            panel = self._made[name] = self._makers[name]()
            self._in_order = tuple(self._made[one] for one in self._makers if one in self._made)
            for meet in tuple(self._meetings):
                meet(panel)
        return panel

    def each(self, meet: Meet) -> None:
        """Have ``meet`` called for each panel there is, and for each other once it is made."""
        self._meetings.append(meet)
        for panel in self._in_order:
            meet(panel)


def _itself(panel: Panel) -> Panel:
    return panel
