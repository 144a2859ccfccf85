"""Keys on the chain of effects of a clip, on a list of parts, and on a small curve."""

from skinsource_gui.widgets.key_tables.key_hint import KeyHint

_ARROWS = ("Left", "Right", "Up", "Down")

CURVE: tuple[KeyHint, ...] = (
    KeyHint(name="left", words="Left", means="move the point earlier", keys=("Left",)),
    KeyHint(name="right", words="Right", means="move the point later", keys=("Right",)),
    KeyHint(name="up", words="Up", means="raise the point", keys=("Up",)),
    KeyHint(name="down", words="Down", means="lower the point", keys=("Down",)),
    *(
        KeyHint(
            name=f"far_{key.lower()}",
            words=f"Shift+{key}",
            means="the same, by ten steps",
            keys=(f"Shift+{key}",),
        )
        for key in _ARROWS
    ),
    KeyHint(name="before", words="Page Up", means="go to the point before", keys=("PgUp",)),
    KeyHint(name="after", words="Page Down", means="go to the point after", keys=("PgDown",)),
    KeyHint(name="first", words="Home", means="go to the first point", keys=("Home",)),
    KeyHint(name="last", words="End", means="go to the last point", keys=("End",)),
    KeyHint(
        name="segment",
        words="S",
        means="let the curve go on straight, smoothly, or held",
        keys=("S",),
    ),
    KeyHint(
        name="add",
        words="Insert or +",
        means="add a point after this one",
        keys=("Ins", "+"),
    ),
    KeyHint(
        name="remove",
        words="Delete",
        means="remove the point",
        keys=("Del", "Backspace"),
    ),
)
EFFECTS: tuple[KeyHint, ...] = (
    KeyHint(name="up", words="Up", means="go to the effect before", keys=("Up",)),
    KeyHint(name="down", words="Down", means="go to the effect after", keys=("Down",)),
    KeyHint(name="first", words="Home", means="go to the first effect", keys=("Home",)),
    KeyHint(name="last", words="End", means="go to the last effect", keys=("End",)),
    KeyHint(
        name="shift_up",
        words="Alt+Up",
        means="let the effect come earlier in the chain",
        keys=("Alt+Up",),
    ),
    KeyHint(
        name="shift_down",
        words="Alt+Down",
        means="let the effect come later in the chain",
        keys=("Alt+Down",),
    ),
    KeyHint(
        name="open",
        words="Enter or Space",
        means="show or hide the settings of the effect",
        keys=("Return", "Enter", "Space"),
    ),
    KeyHint(name="switch", words="M", means="switch the effect on or off", keys=("M",)),
    KeyHint(
        name="remove",
        words="Delete",
        means="remove the effect",
        keys=("Del", "Backspace"),
    ),
)
PARTS: tuple[KeyHint, ...] = (
    KeyHint(name="up", words="Up", means="go to the part before", keys=("Up",)),
    KeyHint(name="down", words="Down", means="go to the part after", keys=("Down",)),
    KeyHint(name="first", words="Home", means="go to the first part", keys=("Home",)),
    KeyHint(name="last", words="End", means="go to the last part", keys=("End",)),
    KeyHint(name="shift_up", words="Alt+Up", means="move the part up", keys=("Alt+Up",)),
    KeyHint(name="shift_down", words="Alt+Down", means="move the part down", keys=("Alt+Down",)),
    KeyHint(
        name="open",
        words="Enter or Space",
        means="show or hide the settings of the part",
        keys=("Return", "Enter", "Space"),
    ),
    KeyHint(name="remove", words="Delete", means="remove the part", keys=("Del", "Backspace")),
)
