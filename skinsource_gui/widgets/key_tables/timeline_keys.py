"""Keys of the timeline and of the editor of a clip."""

from skinsource_gui.widgets.key_tables.key_hint import KeyHint

GAIN_CURVE = KeyHint(
    name="gain_curve", words="G", means="show or hide the gain curve of the track", keys=("G",)
)

TIMELINE: tuple[KeyHint, ...] = (
    KeyHint(
        name="nudge",
        words="Left, Right",
        means="move the selected clips by 1 ms; with Shift by 10 ms",
        keys=("Left", "Right", "Shift+Left", "Shift+Right"),
    ),
    KeyHint(
        name="change_track",
        words="Up, Down",
        means="move the selected clips to another track",
        keys=("Up", "Down"),
    ),
    KeyHint(
        name="go",
        words="Ctrl+Left, Ctrl+Right",
        means="select the clip before, the next clip",
        keys=("Ctrl+Left", "Ctrl+Right"),
    ),
    KeyHint(name="below", words="O", means="select the next of clips that overlap", keys=("O",)),
    KeyHint(name="select_all", words="Ctrl+A", means="select all clips", keys=("Ctrl+A",)),
    KeyHint(name="open", words="Enter", means="edit the clip", keys=("Return", "Enter")),
    KeyHint(name="add", words="N", means="add a clip at the playhead", keys=("N",)),
    KeyHint(name="split", words="S", means="split clips at the playhead", keys=("S",)),
    KeyHint(name="repeat", words="R", means="repeat the selected clips", keys=("R",)),
    KeyHint(name="mute", words="M", means="mute the selected clips", keys=("M",)),
    KeyHint(name="duplicate", words="Ctrl+D", means="duplicate clips behind", keys=("Ctrl+D",)),
    KeyHint(name="copy", words="Ctrl+C", means="copy the selected clips", keys=("Ctrl+C",)),
    KeyHint(name="cut", words="Ctrl+X", means="cut the selected clips", keys=("Ctrl+X",)),
    KeyHint(name="paste", words="Ctrl+V", means="paste clips at the playhead", keys=("Ctrl+V",)),
    KeyHint(name="remove", words="Delete", means="remove clips", keys=("Del", "Backspace")),
    GAIN_CURVE,
    KeyHint(
        name="gain_point",
        words="Ctrl+Page Up, Ctrl+Page Down",
        means="choose a point of the gain curve: arrow keys move it, Delete removes it",
        keys=("Ctrl+PgUp", "Ctrl+PgDown"),
    ),
    KeyHint(
        name="gain_add",
        words="Insert",
        means="add a point to the gain curve at the playhead",
        keys=("Ins",),
    ),
    KeyHint(
        name="gain_far",
        words="Shift+Up, Shift+Down",
        means="raise or lower the chosen point of the gain curve by ten steps; where none is "
        "chosen, select the nearest clip of the track above or below besides",
        keys=("Shift+Up", "Shift+Down"),
    ),
    KeyHint(name="marker", words="I", means="put a marker at the playhead", keys=("I",)),
    KeyHint(
        name="playhead",
        words="Home, End",
        means="put the playhead at the start, behind the last clip",
        keys=("Home", "End"),
    ),
    KeyHint(name="give_up", words="Esc", means="give up what the mouse has begun", keys=("Esc",)),
    KeyHint(
        name="zoom_in",
        words="+",
        means="see less of the time",
        keys=("+", "=", "Shift++", "Shift+="),
    ),
    KeyHint(name="zoom_out", words="\u2212", means="see more of the time", keys=("-", "Shift+-")),
    KeyHint(name="whole", words="0", means="see all of the time", keys=("0", "Shift+0")),
)

CLIP_EDITOR: tuple[KeyHint, ...] = (
    KeyHint(name="look", words="V", means="look, and move what is seen", keys=("V",)),
    KeyHint(
        name="pen",
        words="P",
        means="draw; with Shift a line, with the right button back to zero",
        keys=("P",),
    ),
    KeyHint(name="envelope", words="E", means="shape the envelope", keys=("E",)),
    KeyHint(name="glide", words="G", means="shape frequency and amplitude of a glide", keys=("G",)),
    KeyHint(name="flip", words="F", means="change between frequency and amplitude", keys=("F",)),
    KeyHint(
        name="add",
        words="Insert",
        means="add a point halfway to the next one, which changes nothing yet",
        keys=("Ins",),
    ),
    KeyHint(name="point_before", words="Page Up", means="choose the point before", keys=("PgUp",)),
    KeyHint(name="next_point", words="Page Down", means="choose the next point", keys=("PgDown",)),
    KeyHint(
        name="nudge",
        words="Arrow keys",
        means="move the selected points by a step; with Shift by ten",
        keys=(
            *("Left", "Right", "Up", "Down"),
            *("Shift+Left", "Shift+Right", "Shift+Up", "Shift+Down"),
        ),
    ),
    KeyHint(name="remove", words="Delete", means="remove points", keys=("Del", "Backspace")),
    KeyHint(name="give_up", words="Esc", means="give up what has begun", keys=("Esc",)),
    KeyHint(name="zoom_in", words="+", means="zoom in", keys=("+", "=", "Shift++", "Shift+=")),
    KeyHint(name="zoom_out", words="\u2212", means="zoom out", keys=("-", "Shift+-")),
    KeyHint(name="whole", words="0", means="see all of the clip", keys=("0", "Shift+0")),
)

PLAYHEAD: tuple[KeyHint, ...] = (
    KeyHint(
        name="step",
        words="Alt+Left, Alt+Right",
        means="move the playhead by 1 ms; with Shift by 10 ms",
        keys=("Alt+Left", "Alt+Right", "Alt+Shift+Left", "Alt+Shift+Right"),
    ),
    KeyHint(
        name="stop",
        words="Page Up, Page Down",
        means="put the playhead at the end of a clip, or the marker, before or after it",
        keys=("PgUp", "PgDown"),
    ),
)
