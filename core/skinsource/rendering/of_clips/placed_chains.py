"""Chains of tracks: put together once for the clips of each."""

from skinsource.chain import Chain, Curve, placed_chain
from skinsource.clips import Clip

_Known = tuple[tuple[Clip, ...], Curve, float, tuple[int, Chain]]
#: Far more than a design has tracks.
_MOST = 1000


class PlacedChains:
    """The latest chain of each track; it takes a look at the clips to see whether it still is."""

    def __init__(self) -> None:
        self._known: dict[int, _Known] = {}

    def of(
        self, id: int, clips: tuple[Clip, ...], gain_curve: Curve, sample_rate_hz: float
    ) -> tuple[int, Chain]:
        """Start and chain of the track with this id, see `placed_chain`."""
        known = self._known.get(id)
        if known is not None and known[0] is clips and known[1:3] == (gain_curve, sample_rate_hz):
            return known[3]
        found = placed_chain(clips, gain_curve, sample_rate_hz)
        if len(self._known) >= _MOST:
            self._known.clear()
        self._known[id] = clips, gain_curve, sample_rate_hz, found
        return found
