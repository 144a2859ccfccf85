"""What the mouse does in the panels, in one table: the keys page, the palette and tooltips read it.

The gestures themselves are made where they happen; a test makes each that is listed for the
timeline.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class MouseHint:
    """A gesture.

    Attributes
    ----------
    name
        What it is called at its place.
    words
        What a hand does.
    means
        What comes of it, in a few words that can begin a sentence.
    """

    name: str
    words: str
    means: str

    @property
    def sentence(self) -> str:
        """What comes of it, and by what: ``"stretch a clip in time – drag its start …"``."""
        return f"{self.means} – {self.words[:1].lower()}{self.words[1:]}"


def _hints(*rows: tuple[str, str, str]) -> tuple[MouseHint, ...]:
    return tuple(MouseHint(name=name, words=words, means=means) for name, words, means in rows)


#: By the place where they work: heading on the keys page, and its gestures.
MOUSE: dict[str, tuple[str, tuple[MouseHint, ...]]] = {
    "clips": (
        "Mouse on the clips of the timeline",
        _hints(
            ("move", "Drag a clip", "move it in time, or to another track"),
            ("along", "Drag a clip with Shift", "move it along time alone"),
            ("copy", "Drag a clip with Ctrl", "copy it"),
            ("free", "Drag a clip with Alt", "move it without snapping"),
            ("trim", "Drag the start or the end of a clip", "trim a clip, to play less or more"),
            (
                "stretch",
                "Drag the start or the end of a clip with Shift or Alt",
                "stretch a clip in time",
            ),
            ("fade", "Drag an upper corner of a clip", "fade a clip in or out"),
            ("place", "Drag a clip onto the hand", "give it another place"),
            ("select", "Click a clip", "select it; with Ctrl add it, or take it out"),
            ("below", "Click a selected clip again", "select the next of clips that overlap"),
            ("open", "Double-click a clip", "edit it, large"),
            ("add", "Double-click an empty stretch of a track", "add a clip there"),
            ("frame", "Drag across empty ground", "select the clips in the frame; with Ctrl add"),
            ("menu", "Right button on a clip or a track", "split, repeat, mute, remove, and more"),
            ("zoom", "Turn the wheel with Ctrl", "see less or more of the time"),
            ("pan", "Turn the wheel with Shift, or drag with the middle button", "see other times"),
        ),
    ),
    "ruler": (
        "Mouse on the ruler of the timeline",
        _hints(
            ("playhead", "Click or drag on the ruler", "put the playhead there"),
            (
                "loop",
                "Drag on the ruler with Shift",
                "draw a loop, played again and again",
            ),
            ("loop_end", "Drag an end of the loop", "make the loop longer or shorter"),
            ("marker", "Double-click the ruler", "put a marker there"),
            ("move_marker", "Drag the flag of a marker", "move a marker"),
        ),
    ),
    "gain_curve": (
        "Mouse on the gain curve of a track, once G shows it",
        _hints(
            ("point", "Drag a point of the gain curve", "change gain and time; with Ctrl finely"),
            ("segment", "Drag the gain curve up or down", "raise or lower a stretch of it"),
            ("add", "Double-click the gain curve", "add a point to the gain curve"),
            ("draw", "Drag from the gain curve with Ctrl", "add a point and move it"),
        ),
    ),
    "clip_editor": (
        "Mouse in the editor of a clip",
        _hints(
            ("pen", "With Draw: drag", "draw samples; with Shift a straight line"),
            ("zero", "With Draw: drag with the right button", "draw back to zero"),
            ("add", "With Envelope: click on the curve", "add a point that changes nothing yet"),
            ("put", "With Envelope: double-click beside the curve", "add a point just there"),
            ("point", "With Envelope: drag a point", "move it; with Ctrl finely"),
            ("segment", "With Envelope: drag the curve between two points", "raise or lower both"),
            ("frame", "With Envelope: drag across empty ground", "select the points in the frame"),
            (
                "bend",
                "With Envelope: click on the curve with Alt",
                "let it go on straight, smoothly, or held",
            ),
            (
                "menu",
                "With Envelope: right button on a point",
                "remove it, or let the curve go on otherwise",
            ),
            ("zoom", "Turn the wheel over the clip", "see less or more; with Shift other times"),
        ),
    ),
    "curve": (
        "Mouse on a small curve",
        _hints(
            ("add", "Click on the curve", "add a point that changes nothing yet"),
            ("put", "Double-click beside the curve", "add a point just there"),
            ("point", "Drag a point", "move it"),
            ("menu", "Right button on a point", "remove it, or let the curve go on otherwise"),
        ),
    ),
    "hand": (
        "Mouse on the hand",
        _hints(
            (
                "place",
                "Click a place on the hand",
                "place an input there, or select the one that is there",
            ),
            ("move", "Drag an input to another place", "move it"),
            (
                "toggle",
                "Ctrl or Shift and click an input",
                "add it to the selected ones, or take it out",
            ),
            (
                "besides",
                "Ctrl or Shift and click an empty place",
                "place an input and select it besides the others",
            ),
            ("another", "Ctrl+Shift and click an input", "place one more at the same place"),
            (
                "menu",
                "Right button on an input",
                "mute, solo, duplicate, remove it; in the list also move it",
            ),
        ),
    ),
    "tabs": (
        "Mouse on tabs of panels",
        _hints(("list", "Right button on the tabs", "list the panels in one place")),
    ),
    "heads": (
        "Mouse on the heads of tracks",
        _hints(("order", "Drag a row of the list", "reorder the inputs")),
    ),
    "library": (
        "Mouse in the library",
        _hints(
            ("drag", "Drag a preset onto a place or a track", "place it there"),
            (
                "open",
                "Double-click a preset",
                "place it at the playhead, on the selected track",
            ),
        ),
    ),
    "number": (
        "Mouse on a number",
        _hints(
            (
                "drag",
                "Drag on a number, or turn the wheel",
                "change it; with Ctrl finely, with Shift coarsely",
            ),
            ("type", "Double-click a number", "type it, with or without its unit"),
        ),
    ),
    "pictures": (
        "Mouse on the skin map and on plots",
        _hints(
            (
                "select",
                "Click an output on the skin map",
                "select it; with Ctrl or Shift add it, or take it away",
            ),
            ("frame", "Drag across the skin map", "select all outputs in the frame"),
            (
                "menu",
                "Right button on the map or a plot",
                "save its picture, take its numbers, and more",
            ),
            (
                "zoom",
                "Turn the wheel on the map, on traces or spectra",
                "zoom at the pointer; a double-click shows all of it",
            ),
            ("stretch", "Drag across traces or spectra", "zoom to that stretch"),
        ),
    ),
}


def gesture(place: str, name: str) -> MouseHint:
    """The gesture that is called ``name`` at a place."""
    return next(one for one in MOUSE[place][1] if one.name == name)
