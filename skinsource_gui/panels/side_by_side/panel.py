"""Maps of limbs, of snapshots or of axes side by side: one scale, one pointer, one selection."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, ClassVar

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource_gui.compared import Compared
from skinsource_gui.panel import Panel
from skinsource_gui.panels.side_by_side.cells import Cells
from skinsource_gui.panels.side_by_side.choices_bar import ChoicesBar
from skinsource_gui.panels.side_by_side.content import Cell, Content
from skinsource_gui.panels.side_by_side.kinds import KINDS
from skinsource_gui.panels.side_by_side.painter import paint_page
from skinsource_gui.panels.side_by_side.table import tab_separated
from skinsource_gui.panels.side_by_side.view import MapsView
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, tabular
from skinsource_gui.widgets.copy_button import CopyButton
from skinsource_gui.widgets.figure.words_label import WordsLabel
from skinsource_gui.widgets.paper import on_paper

# In letters of any size, px.
_LEAST = QSize(240, 230)


class SideBySidePanel(Panel):
    """Levels, differences, or mean and spread, of two to four limbs, of snapshots or of axes.

    Attributes
    ----------
    kind
        Which of them.
    """

    title: ClassVar[str] = "Side by side"
    name: ClassVar[str] = "side_by_side"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self._compared: Sequence[Compared] = ()
        # Of the design in the window: results, whether they are older than it, why there are none.
        self._results: Mapping[str, Any] = {}
        self._stale, self._problem = False, ""
        self._cells = Cells()
        self.bar = ChoicesBar(self.name, self)
        self.kind = KINDS[self.bar.settings.of]
        self.bar.view_changed.connect(self.view_changed)
        self.bar.file_wanted.connect(partial(self.action_wanted.emit, "take_snapshot"))
        self.maps = MapsView(self)
        self.maps.outputs_chosen.connect(self._choose_outputs)
        self.maps.pointed_at.connect(self._read)
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
        self.guessed = self.maps, self.words

    @property
    def needs(self) -> frozenset[str]:
        return self.kind.needs

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        return self.kind.needs_of_snapshots

    @property
    def needs_on_limbs(self) -> Mapping[str, frozenset[str]]:
        if self._design is None:
            return {}
        return self.kind.needs_on_limbs(self.bar.settings, self._design.limb)

    def sizeHint(self) -> QSize:
        return QSize(560, 520)

    def minimumSizeHint(self) -> QSize:
        return super().minimumSizeHint().expandedTo(_LEAST)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self.bar.show_state(design, view)
        before, self.kind = self.kind, KINDS[self.bar.settings.of]
        if self.kind is not before:
            # Whoever is asked now tells what is known.
            self._compared = ()
        if self.kind.own:
            self._show_own()

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._results, self._problem = results, ""
        if self.kind.own:
            self._compared = ()
            self._show_own()

    def show_stale(self, stale: bool) -> None:
        self._stale = stale
        if self.kind.own:
            super().show_stale(stale)

    def show_problem(self, reason: str) -> None:
        self._problem = reason
        if self.kind.own:
            self._show_own()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        self._compared = compared
        self._show()

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        self._compared = compared
        self._show()

    def draw_picture(
        self, painter: QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the maps and their scale for a page or a slide; size in px."""
        painter.fillRect(QRectF(0, 0, width, height), QColor(theme.base))
        # Words grow with the picture, and are no smaller than on the screen.
        scale = min(width / max(self.width(), 1), height / max(self.height(), 1))
        scale = max(scale, 1.0)
        painter.save()
        painter.scale(scale, scale)
        with on_paper():
            painter.setFont(tabular(self.font()))
            room = QRectF(0, 0, width / scale, height / scale)
            paint_page(painter, self.maps.content, room, theme)
        painter.restore()

    def _show_own(self) -> None:
        """Draw what is known of the design in the window."""
        if self._design is not None and not self._compared and self.needs <= self._results.keys():
            self._compared = self.kind.sides(self._design, self._results)
        self._show()

    def _show(self) -> None:
        """Draw what is known of the designs."""
        kind, compared, design, view = self.kind, self._compared, self._design, self._view
        problem = self._problem if kind.own else ""
        message = problem or kind.hindrance(compared, view)
        cells: tuple[Cell, ...] = ()
        if compared and design is not None and not message:
            cells = kind.drawn(self._cells, compared, design, view, self.bar.settings)
        content = Content(
            cells=cells,
            outputs=view.outputs,
            message=message,
            about=kind.about(compared, design, view),
        )
        super().show_stale(self._stale if kind.own else content.late)
        self.copy.offer(any(cell.small is not None for cell in content.cells))
        self.maps.show_content(content)

    def _read(self, output: int | None) -> None:
        # Maps that move under the pointer cannot be pointed at.
        self.words.say(self.maps.content.readout(output), holding=True)

    def _choose_outputs(self, outputs: tuple[int, ...]) -> None:
        if self._design is not None:
            self.edited.emit(edits.select_outputs(self._design, self._view, outputs), None)
