"""Maps of several limbs, or of snapshots, side by side: one scale, one pointer, one selection."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import ClassVar

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from skinsource import edits
from skinsource.design import Design
from skinsource.view import View
from skinsource_gui.compared import Compared
from skinsource_gui.panel import Panel
from skinsource_gui.panels.side_by_side.cells import Cells, limb_names, snapshot_names
from skinsource_gui.panels.side_by_side.choices_bar import ChoicesBar
from skinsource_gui.panels.side_by_side.content import Cell, Content
from skinsource_gui.panels.side_by_side.headings import places_for
from skinsource_gui.panels.side_by_side.painter import paint_content
from skinsource_gui.panels.side_by_side.table import tab_separated
from skinsource_gui.panels.side_by_side.view import MapsView
from skinsource_gui.panels.side_by_side.words import about, hindrance, reference_of
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, tabular
from skinsource_gui.widgets.copy_button import CopyButton
from skinsource_gui.widgets.figure.words_label import WordsLabel
from skinsource_gui.widgets.lateness import Lateness

_NEEDS = frozenset(
    {
        "limb_map",
        "limb_data",
        "output_levels_db",
        "above_noise_db",
        "surface",
        "surface_levels_db",
    }
)


class SideBySidePanel(Panel):
    """Levels, differences, or mean and spread, of two to four limbs or of snapshots."""

    title: ClassVar[str] = "Side by side"
    name: ClassVar[str] = "side_by_side"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(240, 230)
        self._design: Design | None = None
        self._view = View()
        self._compared: Sequence[Compared] = ()
        self._cells = Cells()
        self.bar = ChoicesBar(self.name, self)
        self.bar.view_changed.connect(self.view_changed)
        self.bar.file_wanted.connect(partial(self.action_wanted.emit, "take_snapshot"))
        self.maps = MapsView(self)
        self.maps.outputs_chosen.connect(self._choose_outputs)
        self.maps.pointed_at.connect(self._read)
        self._lateness = Lateness(self)
        self._lateness.changed.connect(self.maps.show_outdated)
        self.words = WordsLabel("side_by_side_words", self)
        self.copy = CopyButton(self.name, lambda: tab_separated(self.maps.content), self)
        foot = QHBoxLayout()
        foot.setContentsMargins(UNIT_PX, 1, UNIT_PX // 2, 1)
        foot.addWidget(self.words)
        foot.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.bar)
        column.addWidget(self.maps, 1)
        column.addLayout(foot)
        self.setFocusProxy(self.maps)

    @property
    def needs(self) -> frozenset[str]:
        """The design in the window is one of the sides: it is predicted once, for all panels."""
        return _NEEDS

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return _NEEDS if self.bar.settings.of == "snapshots" else frozenset()

    @property
    def needs_on_limbs(self) -> Mapping[str, frozenset[str]]:
        if self.bar.settings.of != "limbs" or self._design is None:
            return {}
        return dict.fromkeys(self.bar.settings.chosen(self._design.limb), _NEEDS)

    def sizeHint(self) -> QSize:
        return QSize(560, 520)

    def show_state(self, design: Design, view: View) -> None:
        before = self.bar.settings.of
        self._design, self._view = design, view
        self.bar.show_state(design, view)
        if self.bar.settings.of != before:
            # Whoever is asked now tells what is known.
            self._compared = ()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        self._compared = compared
        self._show()

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        self._compared = compared
        self._show()

    def show_theme(self, theme: Theme) -> None:
        self.maps.show_theme(theme)
        self.words.show_theme(theme)

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the maps and their scale for a page or a slide; size in px."""
        content, room = self.maps.content, QRectF(0, 0, width, height)
        painter.fillRect(room, QColor(theme.base))
        painter.setFont(tabular(self.font()))
        painter.setPen(QColor(theme.text))
        line = painter.fontMetrics().height()
        if content.message or not content.cells:
            painter.drawText(room, Qt.AlignmentFlag.AlignCenter, content.message)
            return
        synthetic = any(cell.synthetic for cell in content.cells)
        words = f"{content.about} · SYNTHETIC" if synthetic else content.about
        painter.drawText(QRectF(0, 0, width, 1.5 * line), Qt.AlignmentFlag.AlignCenter, words)
        room.setTop(1.5 * line)
        places = places_for(room, content, painter.font())
        paint_content(painter, content, places, theme)

    def _show(self) -> None:
        """Draw what is known of the designs."""
        message = hindrance(self._compared, self._view, self.bar.settings)
        content = Content(
            cells=() if message else self._made(),
            outputs=self._view.outputs,
            message=message,
            about=about(self._view, self.bar.settings),
        )
        self._lateness.set_stale(content.late)
        self.copy.setEnabled(any(cell.small is not None for cell in content.cells))
        self.maps.show_content(content)

    def _made(self) -> tuple[Cell, ...]:
        compared, settings = self._compared, self.bar.settings
        if not compared or self._design is None:
            return ()
        reference = reference_of(compared, self._design, self._view, settings)
        difference = settings.shown == "difference"
        if settings.of == "limbs":
            names = limb_names(compared, self._view.axes)
        else:
            names = snapshot_names(compared, self._view.axes, with_limbs=difference)
        if difference:
            return self._cells.of_differences(compared, names, reference)
        if settings.shown == "mean":
            return self._cells.of_spread(compared, names, reference)
        return self._cells.of_levels(compared, names)

    def _read(self, output: int | None) -> None:
        # Maps that move under the pointer cannot be pointed at.
        self.words.say(self.maps.content.readout(output), holding=True)

    def _choose_outputs(self, outputs: tuple[int, ...]) -> None:
        if self._design is not None:
            self.edited.emit(edits.select_outputs(self._design, self._view, outputs), None)
