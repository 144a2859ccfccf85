"""Keys in the library."""

from skinsource_gui.widgets.key_tables.key_hint import KeyHint

LIBRARY: tuple[KeyHint, ...] = (
    KeyHint(
        name="walk",
        words="Up, Down, Home, End",
        means="look at another preset",
        keys=("Up", "Down", "Home", "End"),
    ),
    KeyHint(
        name="place",
        words="Enter",
        means="place the preset at the playhead, on the selected track",
        keys=("Return", "Enter"),
    ),
    KeyHint(name="rename", words="F2", means="rename a preset of your own", keys=("F2",)),
    KeyHint(
        name="remove",
        words="Delete",
        means="delete a preset of your own",
        keys=("Del", "Backspace"),
    ),
    KeyHint(name="search", words="S", means="search", keys=("S",)),
)
