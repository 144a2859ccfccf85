"""The line below the hand."""

from collections.abc import Callable

from skinsource.limbs.locations import input_words
from skinsource_gui.panels.hand.hand_state import HandState

#: What an empty hand asks for.
HINT = "Click a place on the hand"


def caption_of(state: HandState, limb: str, fits: Callable[[str], bool]) -> str:
    """What is said below the hand: a note, the place that is meant, or what can be done.

    Where the pointer is at another place than the ring, both are named.  The longest words that
    fit are taken, else the shortest.
    """
    if state.note:
        return state.note
    ringed = state.selected_site if state.cursor is None else state.cursor
    there = state.target or state.hovered
    if there is None and ringed is None:
        return HINT if not state.marks else ""
    if state.target is None and there and ringed and there != ringed:
        wanted = _both(there, ringed, "Keys" if state.cursor else "Selected", limb)
    else:
        site = there or ringed or 0
        place = input_words(site, limb)
        wanted = (f"{site} · {place.name}", f"{site} · {place.short_name}")
    return next((one for one in wanted if fits(one)), wanted[-1])


def _both(there: int, ringed: int, ring: str, limb: str) -> tuple[str, ...]:
    at, rung = input_words(there, limb), input_words(ringed, limb)
    return (
        f"Pointer: {there} · {at.name}  |  {ring}: {ringed} · {rung.name}",
        f"Pointer: {there} · {at.short_name}  |  {ring}: {ringed} · {rung.short_name}",
        f"Pointer: {there} · {at.short_name}  |  {ring}: {ringed}",
        f"Pointer: {there}  |  {ring}: {ringed}",
    )
