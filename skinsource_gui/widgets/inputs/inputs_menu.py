"""What the right button offers to do with inputs, wherever they are shown."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial

from PySide6.QtWidgets import QMenu

from skinsource.design import edits
from skinsource.design.design import Design, Input
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.widgets.keys import KEYS, key_text

#: What is done to the inputs of these ids.
InputEdit = Callable[[Design, View, Iterable[int]], Edit | Refusal]


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One line of the menu.

    Attributes
    ----------
    words
        What it says; where braces stand, how many inputs it is about if there are several.
    key
        What the table of keys calls the key that does the same.
    edit
        What it does.
    on
        Whether an input has it already; None where that is no question.
    separated
        Whether a line stands before it.
    """

    words: str
    key: str
    edit: InputEdit
    on: Callable[[Input], bool] | None = None
    separated: bool = False


#: What can be done to inputs wherever they are.
ENTRIES = (
    Entry(words="Mute{}", key="mute", edit=edits.toggle_mute, on=lambda one: one.muted),
    Entry(words="Solo{}", key="solo", edit=edits.toggle_solo, on=lambda one: one.solo),
    Entry(words="Duplicate{}", key="duplicate", edit=edits.duplicate_inputs, separated=True),
    Entry(words="Remove{}", key="remove", edit=edits.remove_inputs),
)
#: What can be done to them in a list besides.
ORDER = (
    Entry(
        words="Move{} up",
        key="shift_up",
        edit=partial(edits.shift_inputs, down=False),
        separated=True,
    ),
    Entry(words="Move{} down", key="shift_down", edit=partial(edits.shift_inputs, down=True)),
)


def fill_inputs_menu(
    menu: QMenu,
    chosen: Sequence[Input],
    act: Callable[[InputEdit], None],
    *,
    place: str,
    entries: Iterable[Entry] = ENTRIES,
) -> None:
    """Offer what can be done with some inputs.

    Parameters
    ----------
    menu
        To which the lines are added.
    chosen
        The inputs; without any, nothing can be done.
    act
        Does to them what is chosen.
    place
        Where this is, as the table of keys calls it.
    entries
        What is offered.
    """
    several = f" {len(chosen)} inputs" if len(chosen) > 1 else ""
    for entry in entries:
        if entry.separated:
            menu.addSeparator()
        words = entry.words.format(several)
        key = key_text(place, entry.key) if entry.key in KEYS[place].gestures else ""
        action = menu.addAction(f"{words}\t{key}" if key else words)
        action.setEnabled(bool(chosen))
        action.setCheckable(entry.on is not None)
        action.setChecked(bool(chosen) and entry.on is not None and all(map(entry.on, chosen)))
        action.triggered.connect(partial(_act, act, entry.edit))


def _act(act: Callable[[InputEdit], None], edit: InputEdit, _checked: bool = False) -> None:
    act(edit)
