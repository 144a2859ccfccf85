"""The page that shows the scenes: a list, and picture, sentence and source of one."""

from collections.abc import Collection
from html import escape
from itertools import groupby
from operator import attrgetter

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QSize, Qt, Signal

from skinsource.design.labels import limb_label
from skinsource.limbs.own_limbs import facts_of
from skinsource.specs.spec import ChoiceSpec
from skinsource.studies.scenes.scenes import (
    Scene,
    all_scenes,
    missing_panels,
    opened_plainly,
    why_not_on,
)
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.page import PictureView, ToolPage
from skinsource_gui.qt.buttons import Answer, answers, page_label, scrolled
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.resources import resource_folder
from skinsource_gui.qt.theme import UNIT_PX, current_theme
from skinsource_gui.qt.windows import fit_by_guess
from skinsource_gui.state.engine import too_large

_LEAST_PX = (360, 220)

TITLE = "Scenes"
_SIZE_PX = (1120, 650)
_ICON_PX = (72, 44)
_LIST_PX = 360
_OF_THE_PAPER = "The limbs of the paper"
_PLAYED_ON = "Limbs for the scenes: those of the paper, or one of your own"
_PICTURES = "Pictures are computed on synthetic limbs."


class ScenesPage(ToolPage):
    """Shows the scenes, and emits which one is to be opened.

    Parameters
    ----------
    limbs
        Names of the installed limbs.
    selected
        Name of the scene that is selected initially; an unknown name selects the first scene.
    limb
        Own limb that scenes are played on initially; empty: the limbs of the paper.
    """

    #: Names of a scene and of the limb that it is to be played on; empty: the limbs of the paper.
    chosen = Signal(str, str)

    def __init__(
        self,
        limbs: Collection[str],
        selected: str,
        parent: QtWidgets.QWidget,
        *,
        limb: str = "",
    ) -> None:
        super().__init__(parent, "scenes_page", TITLE, _SIZE_PX)
        self._limbs, self._rows = frozenset(limbs), dict[int, Scene]()
        own = [name for name in limbs if facts_of(name).own]
        titles = tuple((name, limb_label(name).title) for name in own)
        self.played_on = ChoiceField(
            ChoiceSpec(label="Played on", options=(("", _OF_THE_PAPER), *titles), hint=_PLAYED_ON)
        )
        self.played_on.setObjectName("scene_limb")
        self.played_on.set_value(limb if limb in own else "")
        self._any_own = bool(own)
        self.list = named(QtWidgets.QListWidget(), "scenes_list", TITLE)
        self.list.setIconSize(QSize(*_ICON_PX))
        self.list.setFixedWidth(_LIST_PX)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setSpacing(1)
        self.picture = PictureView()
        self.picture.setMinimumSize(*_LEAST_PX)
        self.text = page_label("scene_words")
        self.text.setTextFormat(Qt.TextFormat.RichText)
        self.buttons = answers(self, Answer.Open)
        self.open_button = self.buttons.button(Answer.Open)
        self._lay_out()
        self._fill(selected)
        self.list.currentRowChanged.connect(self._show)
        # Not itemActivated: Return would count twice, for the list and for the button.
        self.list.itemDoubleClicked.connect(lambda: self.once_released(self.open_button.click))
        self.played_on.edited.connect(self._show_limb)
        self.accepted.connect(lambda: self.chosen.emit(self.scene.name, self.played_on.value))
        self._show_limb()
        self.list.setFocus()
        fit_by_guess(self)

    @property
    def scene(self) -> Scene:
        """The selected scene."""
        return self._rows[max(self.list.currentRow(), 0)]

    def _lay_out(self) -> None:
        about = QtWidgets.QWidget()
        in_column(self.text, (self.picture, 1), of=about, margins=0, gap_px=UNIT_PX)
        title = QtWidgets.QLabel(self.played_on.accessibleName())
        limb = in_row(title, (self.played_on, 1))
        left = in_column((self.list, 1), limb, gap_px=UNIT_PX)
        for part in (title, self.played_on):
            part.setVisible(self._any_own)
        # What has no room on a small screen scrolls, so that the buttons below stay visible.
        area = scrolled(about, "scene_area")
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        columns = in_row(left, (area, 1), gap_px=2 * UNIT_PX)
        in_column((columns, 1), self.buttons, of=self)
        self.open_button.setDefault(True)
        self.open_button.setToolTip("Open the scene in place of the present design")

    def _fill(self, selected: str) -> None:
        for of_paper, group in groupby(all_scenes(), attrgetter("of_paper")):
            if not of_paper:
                self._note("Inverse design")
            for scene in group:
                self._rows[self.list.count()] = scene
                icon = _icon_of(picture_of(scene))
                self.list.addItem(QtWidgets.QListWidgetItem(icon, scene.heading))
        for name, reason in missing_panels():
            self._note(f"{name} · no scene: {reason}", reason)
        found = (row for row, scene in self._rows.items() if scene.name == selected)
        self.list.setCurrentRow(next(found, 0))

    def _note(self, text: str, tip: str = "") -> None:
        """Add a row that cannot be chosen."""
        item = QtWidgets.QListWidgetItem(text)
        item.setToolTip(tip)
        item.setFlags(Qt.ItemFlag.NoItemFlags)
        self.list.addItem(item)

    def _show_limb(self) -> None:
        """Dim the scenes that do not apply on the chosen limb."""
        limb, theme = self.played_on.value, current_theme()
        self._reasons = {
            scene.name: why_not_on(scene.name, limb) if limb else ""
            for scene in self._rows.values()
        }
        for row, scene in self._rows.items():
            reason = self._reasons[scene.name]
            item = self.list.item(row)
            item.setForeground(QtGui.QColor(theme.dim if reason else theme.text))
            item.setToolTip(f"{scene.sentence}\n{reason}".strip())
        self._show(self.list.currentRow())

    def _show(self, row: int) -> None:
        if row < 0:
            return
        scene, reason = self.scene, self._reasons[self.scene.name]
        self.open_button.setEnabled(not reason)
        self.picture.show_image(picture_of(scene).toImage())
        self.picture.setAccessibleName(scene.title)
        words, *sources = scene.notes.split("\n")
        lines = [f"<b>{escape(scene.heading)}</b>", escape(words), _dim(" ".join(sources))]
        lines.append(self._reason_text(reason) if reason else self._limbs_text(scene))
        self.text.setText("<br>".join(lines))

    def _reason_text(self, reason: str) -> str:
        text = f"Does not apply on {limb_label(self.played_on.value).title}: {reason}"
        return f'<span style="color: {current_theme().error}">{escape(text)}</span>'

    def _limbs_text(self, scene: Scene) -> str:
        """Return on which limbs a scene opens, and notes on them."""
        limb = self.played_on.value
        opened = opened_plainly(scene.name, available=self._limbs, limb=limb)
        limbs = dict.fromkeys(each.design.limb for each in opened.conditions)
        titles = ", ".join(limb_label(limb).title for limb in limbs)
        note = f"Opens on {titles}. {opened.note} {too_large(limb) if limb else ''} {_PICTURES}"
        return _dim(" ".join(note.split()))


def picture_of(scene: Scene) -> QtGui.QPixmap:
    """Return the picture of a scene, in a dark theme on its ground."""
    image = QtGui.QImage(str(resource_folder() / "scenes" / f"{scene.name}.png"))
    theme = current_theme()
    base, text = QtGui.QColor(theme.base), QtGui.QColor(theme.text)
    if base.lightness() < text.lightness() and not image.isNull():
        image = _recoloured(image, base, text)
    return QtGui.QPixmap.fromImage(image)


def _icon_of(picture: QtGui.QPixmap) -> QtGui.QIcon:
    """Return the icon of a picture, as large as that of any other, and the same when selected."""
    icon, ground = QtGui.QIcon(), QtGui.QPixmap(*_ICON_PX)
    ground.fill(Qt.GlobalColor.transparent)
    aspect, smooth = Qt.AspectRatioMode.KeepAspectRatio, Qt.TransformationMode.SmoothTransformation
    small = picture.scaled(ground.size(), aspect, smooth)
    painter = QtGui.QPainter(ground)
    painter.drawPixmap(ground.rect().center() - small.rect().center(), small)
    painter.end()
    for mode in (QtGui.QIcon.Mode.Normal, QtGui.QIcon.Mode.Selected):
        icon.addPixmap(ground, mode)
    return icon


def _recoloured(image: QtGui.QImage, base: QtGui.QColor, text: QtGui.QColor) -> QtGui.QImage:
    """Return a picture with white and black as ``base`` and ``text``; colours stay."""
    image = image.convertToFormat(QtGui.QImage.Format.Format_RGB32)
    pixels = np.frombuffer(image.bits(), np.uint8).reshape(image.height(), image.width(), 4)
    white, black = (
        np.array((colour.blueF(), colour.greenF(), colour.redF())) for colour in (base, text)
    )
    # Some lines at a time: of a whole picture this would take 130 MB.
    for lines in np.array_split(pixels, 32):
        bgr = lines[..., :3] / 255.0
        high = bgr.max(-1, keepdims=True)
        # No colour of a map is less than half saturated: they all stay as they are.
        saturation = 1.0 - bgr.min(-1, keepdims=True) / np.maximum(high, 1e-9)
        coloured = np.minimum(2.0 * saturation, 1.0) * (high > 0)
        greys = black + (white - black) * high
        lines[..., :3] = np.round(255.0 * (coloured * bgr + (1.0 - coloured) * greys))
    return image


def _dim(text: str) -> str:
    return f'<span style="color: {current_theme().dim}">{escape(text)}</span>'
