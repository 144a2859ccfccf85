"""What stands at the numbers of a scale of colours that may not reach to all values."""

from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.map.small_map import Range


def tick_text(
    value: float, range_db: Range, reached_db: Range | None, *, signed: bool = False
) -> str:
    """A number of a scale; "≤ −20" or "≥ +20" at an end whose colour values beyond it have too.

    Parameters
    ----------
    value
        The number.
    range_db
        Values of the lowest and the highest colour.
    reached_db
        The smallest and the largest value there is; None: all lie within the range.
    signed
        Whether numbers have their sign.
    """
    words = minus(f"{value:+g}" if signed and value != 0.0 else f"{value:g}")
    if reached_db is None:
        return words
    if value <= range_db[0] and reached_db[0] < range_db[0]:
        return f"≤ {words}"
    if value >= range_db[1] and reached_db[1] > range_db[1]:
        return f"≥ {words}"
    return words
