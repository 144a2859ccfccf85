"""Colours of levels that are chosen in front of an audience: they stay through the show."""

from skinsource.design.view import View
from skinsource_gui.widgets.map.level_look import in_colours, level_look


class ChosenColours:
    """Tells what was chosen in the window from what a file or a scene brought.

    Parameters
    ----------
    view
        What is open.
    """

    def __init__(self, view: View) -> None:
        self._opened, self._chosen = level_look(view).colours, ""

    def forget(self, view: View) -> None:
        """Something else was opened, by hand: another show begins."""
        self._opened, self._chosen = level_look(view).colours, ""

    def on(self, view: View, left: View, *, of_file: bool) -> View:
        """The next view in the colours of this show, unless it has some itself.

        ``left`` is what is left for it.  Scenes of the paper have none: they take those of
        whatever was open.  ``of_file``: colours that another file brought go with that.
        """
        now = level_look(left).colours
        if now != self._opened:
            self._chosen = now
        colours = self._chosen if of_file else now
        shown = in_colours(view, colours) if colours else view
        self._opened = level_look(shown).colours
        return shown
