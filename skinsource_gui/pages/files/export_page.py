"""The dialog File > Export…: what is exported at the left, its choices and a preview beside it."""

from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import Qt, Signal

from skinsource.design.design import Design, View
from skinsource_gui.pages.files import exports
from skinsource_gui.pages.files.export_parts import ExportPart, FilePart
from skinsource_gui.pages.files.exports import FILM, STIMULUS, STIMULUS_SET, DrawerOf
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.pages.stimulus.page import SetPart, StimulusPart
from skinsource_gui.plots.pictures import MOVING
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.theme import UNIT_PX


class ExportPage(ToolPage):
    """Shows one part at a time; each is made when it is first chosen.

    Parameters
    ----------
    design, view
        What is exported, and what is selected in it.
    drawer_of
        Returns the picture of a panel.
    picture_options
        Options of the last pictures and fields of the last set, by the name of their export.
    last_stimulus
        Settings of the last stimulus, as ``settings`` had them.
    stem
        Begin of the suggested name of a stimulus.
    """

    #: The user wants what is shown to be written.
    chosen = Signal()
    #: An `Edit` of what the design is made for, or after which it can be exported, and number of
    #: the gesture or None.
    edited = Signal(object, object)

    def __init__(
        self,
        design: Design,
        view: View,
        parent: QtWidgets.QWidget | None = None,
        *,
        drawer_of: DrawerOf,
        picture_options: dict[str, Any],
        last_stimulus: str = "",
        stem: str = "stimulus",
    ) -> None:
        super().__init__(parent, "export_page", "Export", (1080, 680))
        self._design, self._view, self._drawer_of = design, view, drawer_of
        self._picture_options, self._stem = picture_options, stem
        self._last_stimulus = last_stimulus
        self._parts: dict[str, ExportPart] = {}
        # What was shown of the parts that are made anew.
        self._shown: dict[str, str] = {}
        self._list = named(QtWidgets.QListWidget(), "export_groups", "What to export")
        self._list.setSpacing(UNIT_PX // 4)
        self._list.addItems(list(dict.fromkeys(spec.group for spec in exports.EXPORTS)))
        # Letters may be larger.
        self._list.setFixedWidth(self._list.sizeHintForColumn(0) + 4 * UNIT_PX)
        self._stack = QtWidgets.QStackedWidget()
        buttons = QtWidgets.QDialogButtonBox(QtWidgets.QDialogButtonBox.StandardButton.Close)
        self._button = buttons.addButton(
            "Export…", QtWidgets.QDialogButtonBox.ButtonRole.AcceptRole
        )
        self._button.setObjectName("export_button")
        #: Cancels the running job, which it names.
        self.cancel = buttons.addButton("", QtWidgets.QDialogButtonBox.ButtonRole.ResetRole)
        named(self.cancel, "cancel_export", hint="Stop this task, and clean up")
        self.cancel.setAutoDefault(False)
        columns = in_row(self._list, (self._stack, 1), gap_px=2 * UNIT_PX)
        in_column((columns, 1), self.message, buttons, of=self)
        self._list.currentTextChanged.connect(self._show_group)
        buttons.accepted.connect(self.chosen)
        buttons.rejected.connect(self.reject)

    @property
    def part(self) -> ExportPart:
        """The part that is shown, until the one that was chosen is made."""
        part: Any = self._stack.currentWidget()
        return part

    @property
    def settings(self) -> str:
        """Settings of the stimulus, to remember."""
        part = self._parts.get("Stimulus")
        return part.settings if isinstance(part, StimulusPart) else self._last_stimulus

    def show_design(self, design: Design) -> None:
        """Export another design; other parts than the present one are made anew."""
        self._design, self._last_stimulus = design, self.settings
        for group, part in list(self._parts.items()):
            if part is not self.part:
                part.close_worker()
                self._shown[group] = part.name
                self._parts.pop(group).deleteLater()
            elif isinstance(part, StimulusPart):
                part.show_design(design)

    def show_export(self, name: str) -> None:
        """Show an entry of the table of exports."""
        spec = next(spec for spec in exports.EXPORTS if spec.name == name)
        (item,) = self._list.findItems(spec.group, Qt.MatchFlag.MatchExactly)
        self._list.setCurrentItem(item)
        part = self.part
        if isinstance(part, FilePart) and part.name != name:
            part.show_export(name)
        part.setFocus()

    def done(self, result: int) -> None:
        """Close the dialog; what it computes is given up."""
        # The page closes before the workers, which may take time to stop.
        super().done(result)
        for part in self._parts.values():
            part.close_worker()

    def _made(self, group: str) -> ExportPart:
        if group not in self._parts:
            self._parts[group] = part = self._new_part(group)
            part.changed.connect(self._show_button)
            self._stack.addWidget(part)
        return self._parts[group]

    def _show_group(self, group: str) -> None:
        self._stack.setCurrentWidget(self._made(group))
        self.say("")
        self.setWindowTitle(f"Export {group.lower()}")
        self._show_button()

    def _new_part(self, group: str) -> ExportPart:
        specs = [spec for spec in exports.EXPORTS if spec.group == group]
        kind = {STIMULUS: StimulusPart, STIMULUS_SET: SetPart}.get(specs[0].name)
        if kind is not None:
            stimulus = kind(self._design, self._view, self.settings, self._stem)
            stimulus.edited.connect(self.edited)
            if isinstance(stimulus, SetPart):
                stimulus.recall(self._picture_options)
            return stimulus
        pictures = self._drawer_of, self._picture_options
        part = FilePart(specs, self._design, self._view, *pictures, self._wired)
        moves = specs[0].name == FILM and self._drawer_of(MOVING).visible is not None
        part.show_export(self._shown.get(group) or specs[moves].name)
        return part

    def _wired(self) -> dict[str, Any]:
        """Return the channels of the stimulus, as its part has them."""
        part = self._made("Stimulus")
        return part.wired if isinstance(part, StimulusPart) else {}

    def _show_button(self) -> None:
        ready = self.part.ready
        self._button.setEnabled(ready)
        self._button.setDefault(ready)
