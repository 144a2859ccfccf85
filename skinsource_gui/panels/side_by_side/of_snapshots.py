"""Snapshots: of the present design, and designs of files."""

from collections.abc import Sequence
from typing import ClassVar

from skinsource.base.published import Axes
from skinsource.base.quoting import printable
from skinsource.design.comparing import EDITED, nothing_to_compare, shown
from skinsource.design.design import Design
from skinsource.design.labels import AXES, short_limb_title, word_of
from skinsource.design.view import View
from skinsource.limbs.own_limbs import axes_on
from skinsource.studies import scenes
from skinsource_gui.compared import LEVELS_MATCHED, Compared, alike_in_level
from skinsource_gui.panels.side_by_side.cells import Names
from skinsource_gui.panels.side_by_side.kind import LEVELS, Kind


class OfSnapshots(Kind):
    """As loud as each other where that is wanted."""

    fields: ClassVar[frozenset[str]] = frozenset({"shown", "file"})
    needs_of_snapshots: ClassVar[frozenset[str]] = LEVELS

    def names(self, compared: Sequence[Compared], view: View, *, difference: bool) -> list[Names]:
        return snapshot_names(compared, view.axes, with_limbs=difference)

    def reference(self, compared: Sequence[Compared], design: Design, view: View) -> int:
        held = shown(view.snapshots, design)
        number = EDITED if held is None else held.number
        found = [one.snapshot.number == number for one in compared]
        return found.index(True) if True in found else 0

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        if len(compared) < 2:
            return nothing_to_compare(view.snapshots)
        return super().hindrance(compared, view)

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        # Each has its own gain.
        words = super().about(compared, None, view)
        matched = alike_in_level(compared, matched=view.levels_matched)
        return f"{words} · {LEVELS_MATCHED}" if matched else words


def snapshot_names(
    compared: Sequence[Compared], axes: Axes, *, with_limbs: bool = False
) -> list[Names]:
    """What the snapshots are called; those measured along other axes than ``axes`` say so.

    ``with_limbs``: where they are on several limbs, they say on which.
    """
    found: list[Names] = []
    titles = [printable(scenes.title_of(one.snapshot.design)).strip() for one in compared]
    own_parts = _own_parts([each for each in titles if each])
    several = with_limbs and len({one.snapshot.design.limb for one in compared}) > 1
    for one, title in zip(compared, titles, strict=True):
        along = axes_on(one.snapshot.design.limb, axes)
        other = f" ({word_of(AXES, along).title})" if along != axes else ""
        on_limb = f" on {short_limb_title(one.snapshot.design.limb)}" if several else ""
        other += on_limb
        edited = one.snapshot.number == EDITED
        called = one.name if edited else f"Snapshot {one.name}"
        parts = dict.fromkeys((title, own_parts.get(title, title)))
        longest = tuple(f"{called} · {part}{other}" for part in parts if part and not edited)
        if len(longest) > 1:
            longest = (*longest, f"{one.name} · {own_parts[title]}{other}")
        short = () if edited and not other else (f"{one.name}{on_limb}",)
        found.append((*longest, f"{called}{other}", *short))
    return found


def _own_parts(titles: Sequence[str]) -> dict[str, str]:
    """What each title says that the others do not: ``"Fig. 2B · 50 Hz"`` is ``"50 Hz"``.

    Of titles whose parts, between middle dots, begin alike.
    """
    parts = [one.split(" · ") for one in titles]
    alike = 0
    while parts and all(len(one) > alike + 1 and one[alike] == parts[0][alike] for one in parts):
        alike += 1
    return {one: " · ".join(each[alike:]) for one, each in zip(titles, parts, strict=True)}
