"""What pictures and numbers carry out of the studio: stimulus, limbs, and conditions not kept."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

from skinsource.design.comparing import EDITED, Snapshot, shown, together
from skinsource.design.labels import short_limb_title
from skinsource.perception.validity import Judged, in_full, in_short
from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine
from skinsource_gui.state.judging import Judging
from skinsource_gui.state.predicting import on_limb, sources_of_levels, sources_shown, too_large
from skinsource_gui.widgets.copy_button import CopyButton
from skinsource_gui.widgets.pictures.caption import caption_of
from skinsource_gui.widgets.pictures.stimulus_words import stimulus_words
from skinsource_gui.widgets.plot.signal_exports import SignalExports

# What maps are drawn with between outputs: what asks for it draws one.
_MAP = "surface"
_EDITED = "Edited"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Shown:
    """A design that a panel shows: what it is called there, and what evaluation starts from."""

    label: str
    given: Mapping[str, Any]
    present: bool = False


class Carrying:
    """Says what goes with whatever is taken out of a panel, and hands that to all of its exits.

    Parameters
    ----------
    document, engine
        Whose design, and who judges it.
    panels
        Each of them is told once it is made; those that compare say with what.
    catch_up
        Waits until the panels in sight show the present design.
    """

    def __init__(
        self,
        document: Document,
        engine: Engine,
        panels: MadePanels,
        catch_up: Callable[[], None],
    ) -> None:
        self._document, self._judging, self._catch_up = document, Judging(engine), catch_up
        panels.each(self._equip)

    def caption(self, *panels: Panel) -> str:
        """What stands below a picture of these panels."""
        found = self._shown(panels)
        design, compared = self._document.design, self._compared(panels)
        named = [(_words(one), one.design) for one in compared]
        words = caption_of(
            design,
            compared=named,
            limbs=tuple(one.given["limb"] for one in found),
            notes=in_short(self._judged(found, panels)),
        )
        here = shown(compared, design)
        if not compared or all(panel.needs_of_snapshots for panel in panels):
            return words
        elsewhere = stimulus_words(design) if here is None else _words(here)
        return f"{words} Other panels: {elsewhere}."

    def lines(self, *panels: Panel) -> tuple[str, ...]:
        """What stands in a table of their numbers."""
        return in_full(self._judged(self._shown(panels), panels))

    @contextmanager
    def as_stored(self) -> Iterator[None]:
        """Have panels show no matched levels while something of them is taken out."""
        with self._document.as_stored():
            self._catch_up()
            yield

    def _equip(self, panel: Panel) -> None:
        caption, lines = partial(self.caption, panel), partial(self.lines, panel)
        panel.caption, panel.as_stored = caption, self.as_stored
        for exports in panel.findChildren(SignalExports):
            exports.caption, exports.lines, exports.as_stored = caption, lines, self.as_stored
        for button in panel.findChildren(CopyButton):
            button.lines, button.as_stored = lines, self.as_stored

    def _judged(self, found: Sequence[_Shown], panels: Sequence[Panel]) -> list[Judged]:
        judged = [
            Judged(label=one.label)
            if too_large(one.given["limb"])
            else self._judging.judge(one.label, one.given, present=one.present)
            for one in found
        ]
        maps = any(_MAP in _drawn(panel) for panel in panels)
        return judged if maps else [one.without_maps() for one in judged]

    def _compared(self, panels: Sequence[Panel]) -> list[Snapshot]:
        """Snapshots that these panels show side by side, and what is edited, as they stand."""
        together_now = together(self._document.view.snapshots, self._document.design)
        drawn = {
            one.number: one
            for panel in panels
            if panel.needs_of_snapshots
            for one in panel.snapshots_drawn(together_now)
        }
        ordered = sorted(drawn.values(), key=lambda one: one.number)
        return ordered if len(ordered) > 1 else []

    def _shown(self, panels: Sequence[Panel]) -> list[_Shown]:
        """The design in the window, where it is shown, and others that the panels show."""
        design, view = self._document.design, self._document.seen
        compared = self._compared(panels)
        here = shown(compared, design)
        label = short_limb_title(design.limb)
        if compared:
            label = _EDITED if here is None else _words(here)
        found = list[_Shown]()
        if not compared or here is not None or not all(one.needs_of_snapshots for one in panels):
            found.append(_Shown(label=label, given=sources_shown(design, view), present=True))
        beside = dict.fromkeys(limb for panel in panels for limb in panel.needs_on_limbs)
        for limb in beside:
            asked = None if limb == design.limb else on_limb(design, view, limb)
            if asked is not None and not isinstance(asked, str):
                given = sources_of_levels(*asked, match_gain=view.match_gain(design))
                found.append(_Shown(label=short_limb_title(limb), given=given))
        for one in compared:
            if here is None or one.number != here.number:
                given = sources_of_levels(one.design, view)
                found.append(_Shown(label=_words(one), given=given))
        return found


def _words(one: Snapshot) -> str:
    return _EDITED if one.number == EDITED else f"Snapshot {one.number}"


def _drawn(panel: Panel) -> frozenset[str]:
    """All that it asks for."""
    return panel.needs.union(panel.needs_of_snapshots, *panel.needs_on_limbs.values())
