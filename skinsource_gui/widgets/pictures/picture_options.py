"""How large a picture is, and in which colours."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QFormLayout, QLabel, QWidget

from skinsource.specs import fields
from skinsource.specs.fields import ChoiceSpec, NumberSpec, Spec, specs_of
from skinsource_gui.theme import LIGHT, THEMES, Theme, set_tone, theme_words
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.number_field import NumberField
from skinsource_gui.widgets.fields.number_typing import FINISHERS
from skinsource_gui.widgets.pictures.layouts import LAYOUTS, OWN, PER_INCH, Below, layout_of

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
    def unused(self) -> frozenset[str]:
        """Names of the fields that say nothing beside the values of the others."""
        return frozenset()

    @property
    def pixels_words(self) -> str:
        """How many pixels it has where it is made of pixels."""
        across, down = (round(one * self.dpi / PER_INCH) for one in (self.width_px, self.height_px))
        return f"In pixels: {across} × {down}"


@dataclass(frozen=True, slots=True)
class Remark:
    """What is to be known of a picture before it is written.

    Attributes
    ----------
    words
        Sentences.
    warns, refuses
        Whether it will not be as it is wanted; whether it cannot be written at all.
    """

    words: str
    warns: bool = False
    refuses: bool = False


#: Asked for what is to be known of a picture with these options.
RemarkOf = Callable[[Any], Remark]


class PictureDialog(QDialog):
    """Lets the user change `PictureOptions`, or what more than these a picture takes.

    Parameters
    ----------
    options
        To begin with.
    title, kinds
        Of the window; what can be written, in words, unless that is among the options.
    most_px
        Pixels that the longer side may have: the resolution of a layout is lowered to it.
    remark
        Says what else is to be known before it is written.
    shape
        Width and height that the picture usually has; those of ``options`` unless given.
    below
        Says how much higher a page is that has words below the picture.

    Attributes
    ----------
    options
        As they are in the fields.
    pixels
        Says how many pixels the file has: width and height are those of an inch of a page.
    said
        What is to be known besides.
    """

    def __init__(
        self,
        options: PictureOptions,
        parent: QWidget | None = None,
        *,
        title: str = "Picture",
        kinds: str = "PNG, SVG or PDF",
        most_px: int | None = None,
        remark: RemarkOf | None = None,
        shape: tuple[int, int] | None = None,
        below: Below | None = None,
    ) -> None:
        super().__init__(parent)
        self.options, self._most_px, self._remark = options, most_px, remark
        self._usual, self._below = shape or (options.width_px, options.height_px), below
        self._cells: dict[str, FieldCell] = {}
        self.setWindowTitle(title)
        self._form = form = QFormLayout(self)
        for name, spec in _specs(options).items():
            self._cells[name] = self._cell(name, spec)
        self.pixels = QLabel()
        form.addRow(self.pixels)
        self.said = QLabel()
        self.said.setObjectName("picture_remark")
        self.said.setWordWrap(True)
        form.addRow(self.said)
        whether = f", and whether as {kinds}" if kinds else ""
        form.addRow(QLabel(f"The next step asks where to{whether}."))
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self._save = buttons.addButton("Save as…", QDialogButtonBox.ButtonRole.AcceptRole)
        self._save.setDefault(True)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form.addRow(buttons)
        self._tell()

    def _cell(self, name: str, spec: Spec) -> FieldCell:
        cell = FieldCell(name, spec, self)
        cell.set_value(getattr(self.options, name))
        cell.edited.connect(self._take)
        cell.field.installEventFilter(self)
        self._form.addRow(cell.label, cell)
        return cell

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        # In the studio's panels Enter begins to type; a dialog is done with it.
        if (
            isinstance(event, QKeyEvent)
            and event.type() == QEvent.Type.KeyPress
            and event.key() in FINISHERS
            and isinstance(watched, NumberField)
        ):
            if (not watched.editing or watched.commit()) and self._save.isEnabled():
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
        spec = specs_of(self.options)[name]
        if isinstance(value, float) and isinstance(spec, NumberSpec) and spec.whole:
            value = int(value)
        changes: dict[str, Any] = {name: value}
        layout = layout_of(str(value)) if name == "layout" else None
        if layout is not None:
            width, height = layout.size_px(self._usual, self._below)
            dpi = layout.dpi
            if self._most_px is not None:
                dpi = min(dpi, self._most_px * PER_INCH // max(width, height))
            changes |= {"width_px": width, "height_px": height, "dpi": dpi}
        elif name in ("width_px", "height_px"):
            changes["layout"] = OWN
        self.options = replace(self.options, **changes)
        for other in changes.keys() - {name}:
            self._cells[other].set_value(getattr(self.options, other))
        self._tell()

    def _tell(self) -> None:
        """Say what follows from the options, and show the fields that say something with them."""
        for name, cell in self._cells.items():
            self._form.setRowVisible(cell, name not in self.options.unused)
        self.pixels.setText(self.options.pixels_words)
        remark = Remark("") if self._remark is None else self._remark(self.options)
        tones = {(True, False): "warning", (False, True): "error"}
        set_tone(self.said, tones.get((remark.warns, remark.refuses), ""))
        self.said.setText(remark.words)
        self._form.setRowVisible(self.said, bool(remark.words))
        self._save.setEnabled(not remark.refuses)


def _specs(options: PictureOptions) -> dict[str, Spec]:
    """Of all fields; what a picture shows stands above how large it is."""
    usual, every = specs_of(PictureOptions), specs_of(options)
    return {name: spec for name, spec in every.items() if name not in usual} | usual


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
