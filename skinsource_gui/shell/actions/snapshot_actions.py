"""What the Edit menu does with snapshots of the design."""

from skinsource.design import edits
from skinsource.design.comparing import NUMBERS
from skinsource.design.design import Design
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.shell.action_spec import ActionSpec, action


def _has_snapshots(design: Design, view: View) -> bool:
    return bool(view.snapshots)


def _toggle_match(design: Design, view: View) -> Edit | Refusal:
    return edits.match_levels(design, view, not view.levels_matched)


def _has_match_gain(design: Design, view: View) -> bool:
    return view.match_gain(design) != 1.0


def _matched(design: Design, view: View) -> bool:
    return view.levels_matched


SNAPSHOTS: tuple[ActionSpec, ...] = (
    *(
        ActionSpec(
            name=f"store_snapshot_{number}",
            menu="Edit",
            text=f"Store snapshot {number}",
            hint="Keep the design as it is now, to compare others with it",
            keys=(f"Ctrl+{number}",),
            keywords="a/b compare keep variant version",
            command="comparison.store",
            argument=str(number),
            separated=number == NUMBERS[0],
        )
        for number in NUMBERS
    ),
    action(
        "take_snapshot",
        "Edit",
        "Snapshot from a file…",
        "Keep the design of a file as a snapshot, to compare this one with it",
        command="files.take_snapshot",
        keywords="a/b compare design file side by side open",
    ),
    action(
        "toggle_snapshots",
        "Edit",
        "Compare with the one before",
        "Show the other one of the last two snapshots that were shown",
        "X",
        command="comparison.toggle",
        enabled=_has_snapshots,
        keywords="a/b toggle switch exchange snapshot",
    ),
    action(
        "match_levels",
        "Edit",
        "Match levels of snapshots",
        "Show snapshots as loud as each other at their loudest output",
        edit=_toggle_match,
        checked=_matched,
        keywords="a/b loudness gain equal snapshot",
    ),
    action(
        "keep_match_gain",
        "Edit",
        "Keep the match gain",
        "Give the design the amplitudes that it is shown with to match another snapshot",
        edit=edits.keep_match_gain,
        enabled=_has_match_gain,
        keywords="a/b loudness level snapshot amplitude",
    ),
)
