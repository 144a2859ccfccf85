"""The present design on several limbs."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from skinsource.design.design import Design
from skinsource.design.labels import AXES, limb_word, short_limb_title, word_of
from skinsource.design.view import View
from skinsource.limbs.limb import PUBLISHED
from skinsource_gui.compared import Compared
from skinsource_gui.panels.side_by_side.cells import Names
from skinsource_gui.panels.side_by_side.kind import LEVELS, Kind
from skinsource_gui.panels.side_by_side.settings import SideBySideSettings

ALONE = "There is no other limb with these outputs. Choose some under Limbs."


class OfLimbs(Kind):
    """The design in the window is one of the sides: it is predicted once, for all panels."""

    fields: ClassVar[frozenset[str]] = frozenset({"shown", "limbs"})

    def needs_on_limbs(
        self, settings: SideBySideSettings, limb: str
    ) -> Mapping[str, frozenset[str]]:
        return dict.fromkeys(settings.chosen(limb), LEVELS)

    def names(self, compared: Sequence[Compared], view: View, *, difference: bool) -> list[Names]:
        """Those measured along other axes than those of the view say so."""
        found: list[Names] = []
        for one in compared:
            limb = one.snapshot.design.limb
            title = limb_word(limb).title
            other = f" ({word_of(AXES, one.axes).title})" if one.axes not in ("", view.axes) else ""
            number = title.split()[1] if limb in PUBLISHED else limb
            found.append((f"{title}{other}", short_limb_title(limb), number))
        return found

    def reference(self, compared: Sequence[Compared], design: Design, view: View) -> int:
        found = [one.snapshot.design.limb == design.limb for one in compared]
        return found.index(True) if True in found else 0

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        if len(compared) == 1:
            return compared[0].problem or ALONE
        return super().hindrance(compared, view)
