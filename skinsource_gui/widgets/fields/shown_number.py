"""A number as a field shows it."""

from dataclasses import dataclass

from PySide6.QtGui import QFontMetrics

from skinsource.base.errors import InvalidInputError
from skinsource.specs.fields import NumberSpec
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.fields.units import (
    EDITED_DIGITS,
    SHOWN_DIGITS,
    display_unit,
    number_text,
    parse_number,
    range_text,
    with_unit,
)
from skinsource_gui.widgets.tooltips import tooltip

#: Before a number that has more digits than are shown, and in place of one that has no room.
ROUNDED, NO_ROOM = "≈", "…"
# So many digits are rounded to without a mark.
_ENOUGH_DIGITS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class ShownNumber:
    """A value and what it may be.

    Attributes
    ----------
    spec
        What is allowed.
    value_si
        The value, in SI units.
    """

    spec: NumberSpec
    value_si: float

    @property
    def symbol(self) -> str:
        """Unit in which it is shown."""
        return display_unit(self.spec.unit, self.value_si).symbol

    def beside(self, *, editing: bool) -> str:
        """What stands beside it: words for what is no number have no unit."""
        return "" if self._unset and not editing else self.symbol

    @property
    def _unset(self) -> bool:
        return bool(self.spec.unset) and self.value_si == 0.0

    @property
    def long_text(self) -> str:
        """As it is edited."""
        return number_text(self.value_si, self.spec.unit, EDITED_DIGITS)

    @property
    def copied_text(self) -> str:
        """As it goes to the clipboard, with its unit."""
        return with_unit(self.long_text, display_unit(self.spec.unit, self.value_si))

    def fitting_text(self, metrics: QFontMetrics, room_px: float) -> str:
        """With as many digits as there is room for; ≈ marks one that was rounded to 1 or 2 digits.

        A number whose first digits are out of sight is another number: rather none is shown.
        """
        if self._unset and metrics.horizontalAdvance(self.spec.unset) <= room_px:
            return self.spec.unset
        texts = [
            minus(number_text(self.value_si, self.spec.unit, digits))
            for digits in range(SHOWN_DIGITS, 0, -1)
        ]
        enough = SHOWN_DIGITS - _ENOUGH_DIGITS + 1
        texts[enough:] = [f"{ROUNDED}{text}" for text in texts[enough:] if text != texts[0]]
        fitting = (text for text in texts if metrics.horizontalAdvance(text) <= room_px)
        return next(fitting, NO_ROOM)

    def parsed(self, text: str) -> float | None:
        """Value of a text, in SI units; None if it is not allowed."""
        try:
            return parse_number(text, self.spec, self.value_si)
        except InvalidInputError:
            return None

    def is_meant_by(self, typed_si: float) -> bool:
        """Whether typing ``typed_si`` changes nothing: what is shown may be rounded."""
        short = number_text(self.value_si, self.spec.unit)
        return typed_si in (self.value_si, self.parsed(self.long_text), self.parsed(short))

    def help(self) -> str:
        """What it is, what is allowed, and how it is changed."""
        return tooltip(
            f"{self.spec.label}, {range_text(self.spec)}",
            self.spec.about,
            "Drag, turn the wheel or press ↑ ↓: the next round number (Ctrl: finer, Shift or "
            "Page Up, Page Down: ten times as far)",
            "Double-click or type to enter a number",
        )
