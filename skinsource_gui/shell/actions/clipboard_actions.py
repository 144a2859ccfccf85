"""What the Edit menu does with clips and the clipboard.

The usual keys are those of the timeline: elsewhere they belong to texts and tables.
"""

from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.shell.action_spec import ActionSpec, action
from skinsource_gui.widgets.keys import key_text


def _has_clips(design: Design, view: View) -> bool:
    return bool(design.clips)


def _hint(words: str, name: str) -> str:
    return f"{words} ({key_text('timeline', name)}, in the timeline)"


CLIPBOARD: tuple[ActionSpec, ...] = (
    action(
        "cut_clips",
        "Edit",
        "Cut clips",
        _hint("Move the selected clips to the clipboard", "cut"),
        command="clips.cut",
        key_elsewhere=key_text("timeline", "cut"),
        enabled=_has_clips,
        keywords="clipboard remove move",
        separated=True,
    ),
    action(
        "copy_clips",
        "Edit",
        "Copy clips",
        _hint("Put the selected clips on the clipboard", "copy"),
        command="clips.copy",
        key_elsewhere=key_text("timeline", "copy"),
        enabled=_has_clips,
        keywords="clipboard",
    ),
    action(
        "paste_clips",
        "Edit",
        "Paste clips at playhead",
        _hint("Put the clips of the clipboard at the playhead", "paste"),
        command="clips.paste",
        key_elsewhere=key_text("timeline", "paste"),
        keywords="clipboard insert",
    ),
)
