"""A number field for a level."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from skinsource.fields import NumberSpec
from skinsource_gui.panels.skin.level_range import HIGHEST_DB, LOWEST_DB
from skinsource_gui.widgets.fields.number_field import NumberField

_UNIT = "dB"


class LevelField(NumberField):
    """A level in dB, typed, dragged, or stepped with the arrow keys or the wheel."""

    #: A level the user entered.
    level_chosen = Signal(float)

    def __init__(self, name: str, words: str, parent: QWidget | None = None) -> None:
        spec = NumberSpec(label=words, unit=_UNIT, minimum=LOWEST_DB, maximum=HIGHEST_DB, step=1.0)
        super().__init__(spec, parent, widest_unit=_UNIT)
        self.setObjectName(name)
        self.edited.connect(self._tell)

    def show_level(self, level_db: float) -> None:
        """Show a level without telling that it was chosen; what is being typed stays."""
        self.set_value(round(level_db, 1))

    def _tell(self, level_db: float) -> None:
        self.level_chosen.emit(level_db)
