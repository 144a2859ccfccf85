"""The list of presets: model, delegate, view, and the preview of one preset."""

from functools import lru_cache, partial
from html import escape
from typing import Any

import numpy as np
from pyqtgraph.functions import arrayToQPath
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import (
    QEvent,
    QMimeData,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QRect,
    QSize,
    Qt,
    QUrl,
    Signal,
)

from skinsource.base.conventions import Floats
from skinsource.base.errors import SkinSourceError, sentence
from skinsource.design.presets.presets import Entry, Preset, mixed
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.kinds import SHARPEST, drawn_path
from skinsource_gui.plots.preview import ClipStrip, SpectrumPreview, strip_lanes
from skinsource_gui.qt.buttons import scrolled
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import in_column, named
from skinsource_gui.qt.theme import UNIT_PX, current_theme

_Role = Qt.ItemDataRole
#: `Entry`; whether it is the user's own; tags in a line.
ENTRY, OWN, TAGS = (_Role.UserRole + k for k in range(1, 4))

_Index = QModelIndex | QPersistentModelIndex


class PresetsModel(QtGui.QStandardItemModel):
    """A model with a row for each preset; the user's own presets can be renamed."""

    #: An `Entry`, and its new name.
    rename_requested = Signal(object, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._entries: tuple[tuple[Entry, bool], ...] = ()

    def show_entries(self, entries: tuple[tuple[Entry, bool], ...]) -> None:
        """List other entries."""
        if entries == self._entries:
            return
        self._entries = entries
        self.clear()
        for entry, own in entries:
            preset, tags = entry.preset, ", ".join(entry.preset.tags)
            item = QtGui.QStandardItem(preset.name)
            item.setEditable(own)
            item.setData(entry, ENTRY)
            item.setData(own, OWN)
            item.setData(tags, TAGS)
            item.setAccessibleText(f"{preset.name}{', your own' if own else ''}, {tags}")
            self.appendRow(item)

    def setData(self, index: _Index, value: Any, role: int = _Role.EditRole) -> bool:
        entry = index.data(ENTRY)
        if role != _Role.EditRole or entry is None or value == entry.preset.name:
            return False
        # The list follows from the files, so that nothing is changed here.
        self.rename_requested.emit(entry, str(value))
        return False

    def supportedDragActions(self) -> Qt.DropAction:
        return Qt.DropAction.CopyAction

    def mimeData(self, indexes: Any) -> QMimeData:
        """Return the files: the window accepts them, and so do other programs."""
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(str(index.data(ENTRY).path)) for index in indexes])
        return data


SIZE_PX = QSize(44, 26)
_LINE_PX = 1.0
# So small a picture looks the same at the sample rate of any limb.
_RATE_HZ = 2000.0


@lru_cache(maxsize=256)
def thumbnail(preset: Preset, colour: str, ratio: float) -> QtGui.QPixmap:
    """Return a picture of what a preset plays, at full height; empty where it cannot be played."""
    try:
        samples = mixed(preset.fragment, _RATE_HZ)
    except SkinSourceError:
        samples = np.zeros(0)
    per_px, path = min(max(round(ratio), 1), SHARPEST), QtGui.QPainterPath()
    if samples.size:
        samples = samples / max(float(np.abs(samples).max()), np.finfo(np.float64).tiny)
        path = _curve(samples, SIZE_PX.width() * per_px)
    return drawn_path(path, SIZE_PX, colour, _LINE_PX, per_px)


def _curve(samples: Floats, columns: int) -> QtGui.QPainterPath:
    """Return every sample, or the highest and the lowest of each column, as a path."""
    if samples.size > 2 * columns:
        starts = np.arange(columns) * samples.size // columns
        high, low = np.maximum.reduceat(samples, starts), np.minimum.reduceat(samples, starts)
        samples = np.stack((high, low), axis=1).reshape(-1)
    middle, reach = SIZE_PX.height() / 2, SIZE_PX.height() / 2 - 1
    x = np.linspace(1, SIZE_PX.width() - 1, max(samples.size, 2))
    y = np.resize(middle - reach * samples, x.size)
    return arrayToQPath(x, y, finiteCheck=False)


_OWN_PX = 3


class PresetDelegate(QtWidgets.QStyledItemDelegate):
    """Paints a row: a picture, the name, and tags below it; a bar marks the user's own presets."""

    def sizeHint(self, option: QtWidgets.QStyleOptionViewItem, index: _Index) -> QSize:
        text_px = 2 * option.fontMetrics.height() + UNIT_PX
        return QSize(10 * UNIT_PX, max(text_px, SIZE_PX.height() + UNIT_PX))

    def updateEditorGeometry(
        self, editor: QtWidgets.QWidget, option: QtWidgets.QStyleOptionViewItem, index: _Index
    ) -> None:
        editor.setGeometry(self._text_area(option.rect))

    def paint(
        self, painter: QtGui.QPainter, option: QtWidgets.QStyleOptionViewItem, index: _Index
    ) -> None:
        theme, rect = current_theme(), option.rect
        chosen = bool(option.state & QtWidgets.QStyle.StateFlag.State_Selected)
        focused = chosen and bool(option.state & QtWidgets.QStyle.StateFlag.State_HasFocus)
        under = bool(option.state & QtWidgets.QStyle.StateFlag.State_MouseOver)
        painter.save()
        if chosen or under:
            painter.fillRect(
                rect, QtGui.QColor(theme.raised if theme.name == "dark" else theme.window)
            )
        if index.data(OWN):
            bar = QRect(rect.left(), rect.top(), _OWN_PX, rect.height())
            painter.fillRect(bar, QtGui.QColor(theme.accent))
        ratio = painter.device().devicePixelRatioF()
        picture = thumbnail(index.data(ENTRY).preset, theme.text, ratio)
        top = rect.center().y() - SIZE_PX.height() // 2
        painter.drawPixmap(rect.left() + UNIT_PX, top, picture)
        text_area = self._text_area(rect)
        metrics, middle = option.fontMetrics, text_area.center().y()
        for text, colour, area in (
            (index.data(), theme.text, text_area.adjusted(0, 0, 0, middle - text_area.bottom())),
            (index.data(TAGS), theme.dim, text_area.adjusted(0, middle - text_area.top(), 0, 0)),
        ):
            painter.setPen(QtGui.QColor(colour))
            shown = metrics.elidedText(text, Qt.TextElideMode.ElideRight, area.width())
            painter.drawText(area, Qt.AlignmentFlag.AlignVCenter, shown)
        if focused:
            painter.setPen(QtGui.QColor(theme.accent))
            painter.drawRect(rect.adjusted(0, 0, -1, -1))
        painter.restore()

    def _text_area(self, rect: QRect) -> QRect:
        return rect.adjusted(SIZE_PX.width() + 2 * UNIT_PX, 2, -UNIT_PX // 2, -2)


_PLACE = "library"


class PresetList(QtWidgets.QListView):
    """A list of presets that can be previewed, dragged and placed."""

    #: An `Entry`.
    place_requested = Signal(object)
    delete_requested = Signal(object)
    search_requested = Signal()
    #: The `Entry` under the pointer, else the one at the keyboard's cursor, or None.
    preview_changed = Signal(object)

    def __init__(self, model: PresetsModel) -> None:
        super().__init__()
        self._message = ""
        self._under: Entry | None = None
        self._delegate = PresetDelegate(self)
        named(self, "preset_rows", "Presets")
        self.setModel(model)
        self.setItemDelegate(self._delegate)
        self.setUniformItemSizes(True)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QtWidgets.QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setDragEnabled(True)
        self.setDragDropMode(QtWidgets.QAbstractItemView.DragDropMode.DragOnly)
        self.doubleClicked.connect(lambda index: self.place_requested.emit(index.data(ENTRY)))

    @property
    def current(self) -> Entry | None:
        """The entry at the keyboard's cursor."""
        return self.currentIndex().data(ENTRY)

    @property
    def current_is_own(self) -> bool:
        """Whether it is the user's own."""
        return bool(self.currentIndex().data(OWN))

    def show_message(self, text: str) -> None:
        """Show why there are no rows."""
        self._message = text
        self.viewport().update()

    def go_to(self, row: int) -> None:
        """Move the keyboard's cursor to this row."""
        self.setCurrentIndex(self.model().index(row, 0))

    def rename(self) -> None:
        """Let the user type another name, where the preset is the user's own."""
        if self.current_is_own:
            self.edit(self.currentIndex())

    def currentChanged(self, current: _Index, previous: _Index) -> None:
        super().currentChanged(current, previous)
        self._under = None
        self.preview_changed.emit(self.current)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        super().mouseMoveEvent(event)
        # What is dragged is the current one, whichever it passes over.
        if not event.buttons():
            self._point_at(self.indexAt(event.position().toPoint()).data(ENTRY))

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._point_at(None)

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, partial(meaning_of, _PLACE)) or super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        name, entry = meaning_of(_PLACE, event), self.current
        if name == "search":
            self.search_requested.emit()
        elif name == "rename":
            self.rename()
        elif name in ("place", "remove"):
            signal = self.place_requested if name == "place" else self.delete_requested
            if entry is not None and (name == "place" or self.current_is_own):
                signal.emit(entry)
        elif event.text().isprintable() and event.text():
            event.ignore()  # there is a search, so letters choose no row
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        if self.model().rowCount() == 0 and self._message:
            painter = QtGui.QPainter(self.viewport())
            painter.setPen(QtGui.QColor(current_theme().dim))
            room = self.viewport().rect().adjusted(UNIT_PX, UNIT_PX, -UNIT_PX, -UNIT_PX)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(room, flags, self._message)

    def _point_at(self, under: Entry | None) -> None:
        if under != self._under:
            self._under = under
            self.preview_changed.emit(under or self.current)


_LEAST_WIDTH_PX = 160
_LEAST_STRIP_PX, _LEAST_SPECTRUM_PX, _LEAST_TEXT_PX = 58, 64, 40
_MOST_STRIP_PX, _MOST_SPECTRUM_PX, _MOST_TEXT_PX = 84, 96, 92


class PresetPreview(QtWidgets.QWidget):
    """Clips of a preset on their tracks, the spectrum of their sum, and a description.

    Attributes
    ----------
    preset
        The preset that is shown.
    """

    def __init__(self) -> None:
        super().__init__()
        self.preset: Preset | None = None
        self._limb = ""
        self.strip, self.spectrum, self.text = ClipStrip(), SpectrumPreview(), QtWidgets.QLabel()
        self.strip.setAccessibleName("Clips of the preset")
        scroll = scrolled(self.text, "preset_about")
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        scroll.viewport().setAutoFillBackground(False)
        for part, least, most in (
            (self.strip, _LEAST_STRIP_PX, _MOST_STRIP_PX),
            (self.spectrum, _LEAST_SPECTRUM_PX, _MOST_SPECTRUM_PX),
            (scroll, _LEAST_TEXT_PX, _MOST_TEXT_PX),
        ):
            part.setMinimumHeight(least)
            part.setMaximumHeight(most)
        self.setMinimumWidth(_LEAST_WIDTH_PX)
        self.text.setObjectName("preset_words")
        self.text.setWordWrap(True)
        self.text.setTextFormat(Qt.TextFormat.RichText)
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        in_column((self.strip, 3), (self.spectrum, 4), (scroll, 3), of=self, margins=0, gap_px=2)

    def show_limb(self, limb: str) -> None:
        """Take over the limb on which the preset would be placed."""
        if limb != self._limb:
            self._limb, preset = limb, self.preset
            self.preset = None
            self.show_preset(preset)

    def show_preset(self, preset: Preset | None) -> None:
        """Show another preset, or nothing."""
        if preset == self.preset:
            return
        self.preset = preset
        self.setVisible(preset is not None)
        if preset is None:
            return
        try:
            limb = facts_of(self._limb)
            rate_hz = limb.sample_rate_hz
            samples = mixed(preset.fragment, rate_hz)
            self.strip.show_lanes(strip_lanes(preset.fragment, rate_hz))
            self.spectrum.show_samples(samples, rate_hz, limb.band_hz)
        except SkinSourceError as error:
            self.strip.show_message(sentence(str(error)))
            self.spectrum.show_samples(None)
        self._show_text(preset)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.preset is not None:
            self._show_text(self.preset)

    def _show_text(self, preset: Preset) -> None:
        parts = [f"<b>{escape(preset.name)}</b> · {escape(_facts(preset, self._limb))}"]
        if preset.description:
            parts.append(escape(preset.description))
        if preset.source:
            dim = current_theme().dim
            parts.append(f"<span style='color:{dim}'>Source: {escape(preset.source)}</span>")
        self.text.setText("<br>".join(parts))


def _facts(preset: Preset, limb: str) -> str:
    """Return duration, number of clips and places of a preset."""
    lanes = preset.fragment.lanes
    length_s = preset.fragment.duration_s
    length = f"{length_s:.3g} s" if length_s >= 1.0 else f"{1e3 * length_s:.3g} ms"
    if len(lanes) == 1:
        n = len(lanes[0].clips)
        return length if n == 1 else f"{length}, {n} clips"
    places = (lane.location for lane in lanes)
    known = facts_of(limb).n_inputs
    names = (input_name(k, limb).short_name if k <= known else str(k) for k in places)
    return f"{length}, {len(lanes)} tracks: {', '.join(names)}"
