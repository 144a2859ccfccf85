"""What stands above the maps of windows: when each is, in as many words as there is room for."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QRectF

from skinsource_gui.panels.windowed.content import WindowedContent, time_number, window_words


@dataclass(frozen=True, slots=True)
class WindowTitles:
    """Words above maps.

    Attributes
    ----------
    words
        For each window; empty where there is no room for them.
    by_begin
        Whether they are only when windows begin: how long they are is said elsewhere.
    """

    words: tuple[str, ...]
    by_begin: bool


def window_titles(
    bounds_s: Sequence[tuple[float, float]],
    cells: Sequence[QRectF],
    width_of: Callable[[str], float],
) -> WindowTitles:
    """Begin and end of each window; or where that is too wide their begins, or every n-th begin.

    Parameters
    ----------
    bounds_s
        Begin and end of each, s.
    cells
        Where the maps are, row by row.
    width_of
        Width of words, px.
    """
    until_s = max((end for _, end in bounds_s), default=0.0)
    whole = tuple(window_words(one, until_s) for one in bounds_s)
    least = min((cell.width() for cell in cells), default=0.0)
    if all(width_of(words) <= least for words in whole):
        return WindowTitles(whole, by_begin=False)
    begins = tuple(time_number(begin, until_s) for begin, _ in bounds_s)
    widest = max(map(width_of, begins)) + width_of(" ")
    every = next(n for n in range(1, len(cells) + 1) if widest <= n * least or n == len(cells))
    columns = sum(cell.top() == cells[0].top() for cell in cells)
    named = (words if k % columns % every == 0 else "" for k, words in enumerate(begins))
    return WindowTitles(tuple(named), by_begin=True)


def head_words(
    content: WindowedContent,
    cells: Sequence[QRectF],
    width_of: Callable[[str], float],
    room: float,
) -> str:
    """What the times above all maps are, in as many words as fit into ``room``; "" if none do."""
    titles = window_titles(content.bounds_s, cells, width_of)
    phrases = content.begin_phrases if titles.by_begin else content.time_phrases
    return next((one for one in phrases if width_of(one) <= room), "")
