"""How long clips are, and all of them together."""

from collections.abc import Mapping

from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource_gui.widgets.time.time_scale import Range

#: Behind the last clip, so much of the time can be seen; at least so much in all.
AFTER_S, LEAST_S = 0.4, 0.5


class ClipLengths:
    """Lengths of the clips of a design; those of clips that are as they were are not asked again.

    Parameters
    ----------
    design
        Whose clips.
    before
        What was known of an earlier design.

    Attributes
    ----------
    design
        Whose clips.
    asked
        How many clips were asked.
    """

    def __init__(self, design: Design, before: "ClipLengths | None" = None) -> None:
        self.design, self.asked = design, 0
        known: Mapping[int, tuple[Clip, float]] = {} if before is None else before._known
        self._known: Mapping[int, tuple[Clip, float]] = {
            clip.id: self._known_or_asked(clip, known) for clip in design.clips
        }
        self._durations_s = {id: duration_s for id, (_, duration_s) in self._known.items()}
        ends = [clip.onset_s + duration_s for clip, duration_s in self._known.values()]
        self._whole_s = (0.0, max(max(ends, default=0.0) + AFTER_S, LEAST_S))

    @property
    def durations_s(self) -> Mapping[int, float]:
        """Length of each clip, by its id."""
        return self._durations_s

    @property
    def whole_s(self) -> Range:
        """From 0 to a little behind the last clip."""
        return self._whole_s

    def of(self, design: Design) -> "ClipLengths":
        """Those of a design, most of whose clips are the same."""
        return self if design is self.design else ClipLengths(design, self)

    def _known_or_asked(
        self, clip: Clip, known: Mapping[int, tuple[Clip, float]]
    ) -> tuple[Clip, float]:
        found = known.get(clip.id)
        if found is not None and found[0] is clip:
            return found
        self.asked += 1
        return clip, clip.duration_s
