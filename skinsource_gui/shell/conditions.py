"""The conditions of the measurement: a chip in the status bar says whether the design keeps them.

It is written when edits pause. A card explains each condition, with a button that repairs it.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, QPoint, Qt, QTimer, Signal

from skinsource.base.errors import counted
from skinsource.design import edits
from skinsource.design.edits.edit import Edit
from skinsource.perception.validity import Finding, Findings, noisy_outputs
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.layouts import show_tooltip
from skinsource_gui.qt.overlays import Staleness
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import (
    FIRST_SLOT,
    Engine,
    Outcome,
    Purpose,
    Request,
    sources_shown,
    too_large,
)
from skinsource_gui.state.panel import Panel, PanelRegistry

#: What conditions are called; the chip leaves out that of the limb, which stands on the map.
NAMES = {
    "inputs": "inputs",
    "band": "frequency range",
    "drive": "probe velocity",
    "spacing": "sensor spacing",
    "noise": "noise",
    "scaling": "scaling",
}
STATES = {"kept": "OK", "left": "caution", "unknown": "unknown"}
#: What it says of one that the design leaves.
_CAUTIONS = {
    "inputs": "inputs that cannot be played",
    "band": "outside the measured band",
    "drive": "probe too fast",
    "spacing": "waves shorter than the sensor spacing",
    "noise": "near the noise",
    "scaling": "differences between places hidden",
}
_CAUTION = "⚠"
_OLDER = "updating: results of an older design"


def chip_text(findings: Findings) -> str:
    """Return in a few words what leaves the conditions of the measurement, or that nothing does."""
    named = [finding for finding in findings if finding.name in NAMES]
    left = [finding for finding in named if finding.state == "left"]
    if not named:
        return "Limits not checked"
    if left:
        count = f"{counted(len(left[0].outputs), 'output')} " if left[0].outputs else ""
        more = f", {len(left) - 1} more" if left[1:] else ""
        caution = f"{count}{_CAUTIONS[left[0].name]}"
        return f"{_CAUTION} {caution[0].upper()}{caution[1:]}{more}"
    if any(finding.state == "unknown" for finding in named):
        return "✓ Within known limits"
    return "✓ Within measured limits"


def _states_text(findings: Findings) -> str:
    named = [finding for finding in findings if finding.name in NAMES]
    return "\n".join(f"{NAMES[finding.name]}: {STATES[finding.state]}" for finding in named)


class ConditionsChip(QtWidgets.QToolButton):
    """Says which conditions the design leaves; pale while that is of an older design."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("conditions")
        self.setAutoRaise(True)
        self.findings: Findings = ()
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._describe)
        self._describe()

    @property
    def worst(self) -> str:
        """Name of the first condition that the design leaves; else of the first one."""
        order = sorted(self.findings, key=lambda finding: finding.state != "left")
        return next((finding.name for finding in order if finding.name in NAMES), "")

    def show_findings(self, findings: Findings) -> None:
        """Take over new findings."""
        self.findings = findings
        self._staleness.set_stale(False)
        self._describe()

    def set_stale(self, stale: bool) -> None:
        """Take over whether the findings belong to an older design; shown after a while."""
        self._staleness.set_stale(stale)

    def _describe(self) -> None:
        stale, text = self._staleness.is_stale, chip_text(self.findings)
        about = f"{_OLDER}\n" * stale + _states_text(self.findings)
        caution = text.startswith(_CAUTION)
        set_tone(self, "warning" if caution and not stale else "dim")
        self.setText(text)
        self.setAccessibleName(f"Conditions of the measurement: {text}")
        self.setAccessibleDescription(about)
        show_tooltip(self, f"{about}\nClick to see what can be done.".lstrip())


_REPAIRS = {
    "band_limit": "Limit to the band",
    "quieter": "Lower amplitudes",
    "probe_scaling": "Use probe scaling",
    "deselect": "Deselect them",
}
_TEXT_EM = 28


class ConditionsCard(QtWidgets.QFrame):
    """A card over the status bar; it closes at the next click elsewhere, or with Esc."""

    #: The `Finding` whose cause is to be repaired.
    repair_requested = Signal(object)

    def __init__(self, findings: Findings, first: str, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("conditions_card")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setFrameShape(QtWidgets.QFrame.Shape.StyledPanel)
        grid = QtWidgets.QGridLayout(self)
        grid.setContentsMargins(UNIT_PX, UNIT_PX, UNIT_PX, UNIT_PX)
        grid.setHorizontalSpacing(2 * UNIT_PX)
        grid.setVerticalSpacing(UNIT_PX)
        grid.setColumnStretch(1, 1)
        for row, finding in enumerate(findings):
            self._add(grid, row, finding, chosen=finding.name == first)

    def open_above(self, position: QPoint) -> None:
        """Show it with its lower edge at a position of the screen."""
        self.adjustSize()
        screen = self.screen().availableGeometry()
        left = min(max(position.x(), screen.left()), screen.right() - self.width())
        self.move(left, max(position.y() - self.height() - 2, screen.top()))
        self.show()

    def _add(
        self, grid: QtWidgets.QGridLayout, row: int, finding: Finding, *, chosen: bool
    ) -> None:
        name = NAMES.get(finding.name, finding.name).capitalize()
        title = QtWidgets.QLabel(f"{name}\n{STATES[finding.state]}")
        set_tone(title, "warning" if finding.state == "left" else "dim")
        font = title.font()
        font.setBold(chosen)
        title.setFont(font)
        label = page_label(f"validity_{finding.name}", finding.sentence)
        # Grids do not take the height of wrapped text into account.
        width = _TEXT_EM * self.fontMetrics().horizontalAdvance("m")
        label.setFixedWidth(width)
        label.setFixedHeight(label.heightForWidth(width))
        top = Qt.AlignmentFlag.AlignTop
        grid.addWidget(title, row, 0, top)
        grid.addWidget(label, row, 1, top)
        if finding.repair:
            button = QtWidgets.QPushButton(_REPAIRS[finding.repair])
            button.setObjectName(f"mend_{finding.name}")
            button.clicked.connect(partial(self._repair, finding))
            grid.addWidget(button, row, 2, top)
            if chosen:
                button.setFocus()

    def _repair(self, finding: Finding) -> None:
        self.close()
        self.repair_requested.emit(finding)


_IDLE_MS = 400
_WANTED = frozenset({"validity"})


class Conditions(QObject):
    """Judges the conditions once edits pause; while the window is hidden nothing is computed.

    Parameters
    ----------
    panels
        The skin map among them hatches outputs that are mostly noise.
    status_bar
        Shows the chip.
    """

    def __init__(
        self,
        document: Document,
        engine: Engine,
        panels: PanelRegistry,
        status_bar: QtWidgets.QStatusBar,
    ) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        self._noisy: tuple[int, ...] = ()
        self.chip = ConditionsChip()
        panels.each(self._tell)
        self._shown: Request | None = None
        # The sources of the present findings; None without findings.
        self._judged: Mapping[str, Any] | None = None
        status_bar.insertPermanentWidget(0, self.chip)
        self._idle = QTimer(self, singleShot=True, interval=_IDLE_MS)
        self._idle.timeout.connect(self._judge)
        engine.finished.connect(self._note)
        document.changed.connect(self._follow)
        self.chip.clicked.connect(self._explain)

    def _follow(self) -> None:
        """Show whether the findings would have other sources now."""
        if self._judged is None:
            return
        now = sources_shown(self._document.design, self._document.view)
        names = self._engine.upstream_of(_WANTED) & now.keys()
        self.chip.set_stale(any(self._judged[name] != now[name] for name in names))

    def _note(self, outcome: Outcome) -> None:
        request, shown = outcome.request, self._shown and self._shown.given
        if request.place == (FIRST_SLOT, Purpose.SHOW):
            judged = outcome.values is not None and not too_large(request.given["limb"])
            self._shown = request if judged else None
            if self._shown is None:
                self._show_outcome(None)
            else:
                self._idle.start()
        elif request.place == (FIRST_SLOT, Purpose.JUDGE) and request.given == shown:
            self._show_outcome(outcome)

    def _judge(self) -> None:
        if self._shown is not None and self.chip.window().isVisible():
            self._engine.request(replace(self._shown, wanted=_WANTED, purpose=Purpose.JUDGE))

    def _show_outcome(self, outcome: Outcome | None) -> None:
        findings = () if outcome is None or outcome.values is None else outcome.values["validity"]
        self.chip.show_findings(findings)
        self._judged = None if outcome is None else outcome.request.given
        # The design may have been edited since.
        self._follow()
        self._noisy = noisy_outputs(findings)
        for panel in self._panels:
            self._tell(panel)

    def _tell(self, panel: Panel) -> None:
        panel.show_noisy(self._noisy)
        # The noise of other designs beside this one is known where they are shown.
        told = _CAUTIONS.keys() - {"noise"}
        left = (each for each in self.chip.findings if each.state == "left" and each.name in told)
        text = "; ".join(_CAUTIONS[each.name] for each in left)
        text = f"{_CAUTION} {text[0].upper()}{text[1:]}" if text else ""
        panel.show_caution(text, _states_text(self.chip.findings))

    def _explain(self) -> None:
        mend = partial(edits.mend, self._document.design, self._document.view)
        # What would do nothing is not offered, as where no selected output is noisy.
        offered = tuple(
            each if isinstance(mend(each), Edit) else replace(each, repair="")
            for each in self.chip.findings
        )
        card = ConditionsCard(offered, self.chip.worst, self.chip)
        card.repair_requested.connect(self._repair)
        card.open_above(self.chip.mapToGlobal(QPoint()))

    def _repair(self, finding: Finding) -> None:
        self._document.apply(edits.mend(self._document.design, self._document.view, finding))
