"""What an entry of the table of actions says."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.view import View

#: Asked with what is open now.
Condition = Callable[[Design, View], bool]


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionSpec:
    """One thing that can be done.

    It is either a ``command`` or an ``edit``.

    Attributes
    ----------
    name
        Name of the action, the same for ever.
    text
        What the menu says.
    menu
        Menu it stands in, which the table of menus says; "" for the palette alone.
    submenu
        The one in that menu it stands in; in the menu itself where there is none.
    short
        What its button says in the bar, where that is less.
    hint
        What it does, in a sentence.
    keys
        Shortcuts, first the one that is shown.
    key_elsewhere
        The key that does it where that belongs to a panel: said beside it in the menu.
    keywords
        Other words by which the palette finds it.
    command
        ``"capability.method"``: who does it, and what it is called there.
    argument
        What the command is told, if anything.
    edit
        Makes the edit from the design and the view.
    enabled
        Whether it can be done now; always when not given.
    checked
        Whether it is on now; no switch when not given.
    separated
        Whether a line stands before it.
    group
        Of the switches with the same group, one is on.
    """

    name: str
    text: str
    hint: str
    keys: tuple[str, ...] = ()
    key_elsewhere: str = ""
    menu: str = ""
    submenu: str = ""
    short: str = ""
    keywords: str = ""
    command: str = ""
    argument: str = ""
    edit: Callable[[Design, View], Edit | Refusal] | None = None
    enabled: Condition | None = None
    checked: Condition | None = None
    separated: bool = False
    group: str = ""

    def __post_init__(self) -> None:
        if bool(self.command) == (self.edit is not None):
            raise ValueError(f"action {self.name}: expected either a command or an edit")


def action(name: str, text: str, hint: str, *keys: str, **more: Any) -> ActionSpec:
    """Return an entry of the table; what all have needs no names."""
    return ActionSpec(name=name, text=text, hint=hint, keys=keys, **more)
