"""How large a picture is, and in which colours."""

from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QFormLayout, QLabel, QWidget

from skinsource import fields
from skinsource.fields import ChoiceSpec, NumberSpec, specs_of
from skinsource_gui.theme import LIGHT, THEMES, Theme, theme_of, theme_words
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.fields.number_typing import FINISHERS
from skinsource_gui.widgets.pictures.layouts import LAYOUTS, OWN, PER_INCH, layout_of

LAYOUT = ChoiceSpec(
    label="For",
    options=((OWN, "A size of its own"), *((one.name, one.title) for one in LAYOUTS)),
    hint="Width and height for a column of a paper, a slide, or a poster",
)
_SIDE: dict[str, Any] = {
    "unit": "px",
    "minimum": 100,
    "maximum": 20000,
    "step": 100.0,
    "whole": True,
}
_HINT = "Of pixels; in SVG and PDF 96 of them are an inch"
WIDTH = NumberSpec(label="Width", hint=_HINT, **_SIDE)
HEIGHT = NumberSpec(label="Height", hint=_HINT, **_SIDE)
DPI = NumberSpec(
    label="Resolution",
    unit="dpi",
    minimum=24,
    maximum=2400,
    step=10.0,
    whole=True,
    hint="Dots in an inch of a PNG; at 96 dpi it has as many pixels as width and height say. SVG "
    "and PDF are lines, and have none",
)
COLOURS = ChoiceSpec(
    label="Colours",
    options=tuple((name, theme_words(name)) for name in THEMES),
    hint="Light for paper and most slides",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions:
    """What is asked before a picture is written.

    Attributes
    ----------
    layout
        Name of a layout, or `OWN`.
    width_px, height_px
        Its size.
    dpi
        Dots in an inch of a PNG.
    colours
        Name of a theme.
    """

    layout: str = fields.choice(OWN, LAYOUT)
    width_px: int = fields.number(1200, WIDTH)
    height_px: int = fields.number(1800, HEIGHT)
    dpi: int = fields.number(PER_INCH, DPI)
    colours: str = fields.choice(LIGHT.name, COLOURS)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def theme(self) -> Theme:
        """The colours."""
        return THEMES[self.colours]

    @property
    def pixels_words(self) -> str:
        """How many pixels it has where it is made of pixels."""
        across, down = (round(one * self.dpi / PER_INCH) for one in (self.width_px, self.height_px))
        return f"In pixels: {across} × {down}"


class PictureDialog(QDialog):
    """Lets the user change `PictureOptions`.

    Parameters
    ----------
    options
        To begin with.
    kinds
        What can be written, in words.
    most_px
        Pixels that the longer side may have: the resolution of a layout is lowered to it.
    remark
        What else is to be known before it is written.

    Attributes
    ----------
    options
        As they are in the fields.
    pixels
        Says how many pixels the file has: width and height are those of an inch of a page.
    """

    def __init__(
        self,
        options: PictureOptions,
        parent: QWidget | None = None,
        *,
        kinds: str = "PNG, SVG or PDF",
        most_px: int | None = None,
        remark: str = "",
    ) -> None:
        super().__init__(parent)
        self.options, self._most_px = options, most_px
        self._usual = options.width_px, options.height_px
        self._cells: dict[str, FieldCell] = {}
        self.setWindowTitle("Picture")
        self._form = form = QFormLayout(self)
        for name, spec in specs_of(options).items():
            cell = FieldCell(name, spec, self)
            cell.set_value(getattr(options, name))
            cell.edited.connect(self._take)
            cell.show_theme(theme_of(self.palette()))
            cell.field.installEventFilter(self)
            form.addRow(cell.label, cell)
            self._cells[name] = cell
        self.pixels = QLabel(options.pixels_words)
        form.addRow(self.pixels)
        if remark:
            said = QLabel(remark)
            said.setWordWrap(True)
            form.addRow(said)
        form.addRow(QLabel(f"The next step asks where to, and whether as {kinds}."))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        save = buttons.addButton("Save as…", QDialogButtonBox.ButtonRole.AcceptRole)
        save.setDefault(True)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form.addRow(buttons)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # In the studio's panels Enter begins to type; a dialog is done with it.
        if (
            isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and event.key() in FINISHERS
            and isinstance(watched, NumberField)
        ):
            if not watched.editing or watched.commit():
                self.accept()
            return True
        return super().eventFilter(watched, event)

    def event(self, event: QEvent) -> bool:
        done = super().event(event)
        if event.type() == QEvent.Type.LayoutRequest:
            # A remark under a field may take several lines.
            needed = self._form.totalHeightForWidth(self.width())
            self.resize(self.width(), max(self.height(), needed))
        return done

    def _take(self, name: str, value: object, _gesture: int | None) -> None:
        whole = int(value) if isinstance(value, float) else value
        changes: dict[str, Any] = {name: whole}
        layout = layout_of(str(value)) if name == "layout" else None
        if layout is not None:
            width, height = layout.size_px(self._usual)
            dpi = layout.dpi
            if self._most_px is not None:
                dpi = min(dpi, self._most_px * PER_INCH // max(width, height))
            changes |= {"width_px": width, "height_px": height, "dpi": dpi}
        elif name in ("width_px", "height_px"):
            changes["layout"] = OWN
        self.options = replace(self.options, **changes)
        for other in changes.keys() - {name}:
            self._cells[other].set_value(getattr(self.options, other))
        self.pixels.setText(self.options.pixels_words)


def ask_picture_options(
    parent: QWidget, options: PictureOptions, **about: Any
) -> PictureOptions | None:
    """Let the user change ``options``; None if there is to be no picture.

    ``about`` is what `PictureDialog` takes besides.
    """
    dialog = PictureDialog(options, parent, **about)
    accepted = dialog.exec() == QDialog.DialogCode.Accepted
    dialog.deleteLater()
    return dialog.options if accepted else None
