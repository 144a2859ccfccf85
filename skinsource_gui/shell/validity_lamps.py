"""Lamps in the status bar: the conditions of the measurement, and whether the design keeps them.

The lamps are lit when edits pause. A card explains each condition, with a button that repairs it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from typing import Any

from PySide6.QtCore import QEvent, QObject, QPoint, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QStatusBar,
    QToolTip,
    QWidget,
)

from skinsource.design import edits
from skinsource.perception.validity import Finding, Findings
from skinsource_gui.qt.frames import paint_focus_frame
from skinsource_gui.qt.overlays import Staleness
from skinsource_gui.qt.theme import UNIT_PX, Theme, current_theme, scaled, set_tone
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
from skinsource_gui.state.panel import PanelRegistry

#: What lamps are called; the limb has words of its own beside them.
NAMES = {
    "inputs": "inputs",
    "band": "band",
    "drive": "drive",
    "spacing": "spacing",
    "noise": "SNR",
    "scaling": "scaling",
}
# States whose lamps have names, with less and less room; in the last row only the worst lamp.
_NAMED_STATES = (("left", "unknown", "kept"), ("left", "unknown"), ("left",), ())
_WORST = ("left", "unknown")
_DOT_PX, _MARGIN_PX = 8.0, UNIT_PX // 2


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LampRow:
    """A dot for each condition, and its name where there is room; that of the worst one always.

    Attributes
    ----------
    findings
        What was found; those that have a name here have a lamp.
    metrics
        Of the names.
    """

    findings: Findings
    metrics: QFontMetrics

    @property
    def lamps(self) -> tuple[Finding, ...]:
        """The findings that have a lamp, in order."""
        return tuple(finding for finding in self.findings if finding.name in NAMES)

    @property
    def whole_px(self) -> int:
        """Width in which all lamps have names."""
        return self._width(self._names_shown(0))

    @property
    def least_px(self) -> int:
        """Width in which only the worst lamp has its name."""
        return self._width(self._names_shown(-1))

    def places(self, room: QRectF) -> list[tuple[Finding, QRectF]]:
        """Return the area of each lamp, with its name if there is room for it."""
        rows = [self._names_shown(k) for k in range(len(_NAMED_STATES))]
        named = next((names for names in rows if self._width(names) <= room.width()), rows[-1])
        places, x = [], room.left() + _MARGIN_PX
        for lamp in self.lamps:
            width = self._lamp_width(lamp, named)
            places.append((lamp, QRectF(x, room.top(), width, room.height())))
            x += width + UNIT_PX
        return places

    def at(self, x_px: float, room: QRectF) -> Finding | None:
        """Return the lamp at this position, or the nearest within a few pixels."""
        near = (
            (abs(area.center().x() - x_px) - area.width() / 2, lamp.name, lamp)
            for lamp, area in self.places(room)
        )
        best = min(near, default=None)
        return None if best is None or best[0] > UNIT_PX else best[2]

    def _names_shown(self, row: int) -> frozenset[str]:
        """Return the lamps that have names in a row of the table, the worst one among them."""
        lamps = self.lamps
        names = {lamp.name for lamp in lamps if lamp.state in _NAMED_STATES[row]}
        worst = (lamp.name for state in _WORST for lamp in lamps if lamp.state == state)
        return frozenset(names | set(islice(worst, 1)))

    def _lamp_width(self, lamp: Finding, named: frozenset[str]) -> float:
        if lamp.name not in named:
            return _DOT_PX
        return _DOT_PX + 4 + self.metrics.horizontalAdvance(NAMES[lamp.name])

    def _width(self, named: frozenset[str]) -> int:
        lamps = self.lamps
        if not lamps:
            return 0
        width = sum(self._lamp_width(lamp, named) for lamp in lamps)
        return round(width + UNIT_PX * (len(lamps) - 1) + 2 * _MARGIN_PX)


def paint_lamp(painter: QPainter, finding: Finding, area: QRectF, theme: Theme) -> None:
    """Draw a lamp, and its name where its place is width enough.

    Amber: a caution; a ring: unknown; a dim dot: the condition is kept.
    """
    dot = QRectF(area.left(), area.center().y() - _DOT_PX / 2, _DOT_PX, _DOT_PX)
    if finding.state == "left":
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.warning))
    elif finding.state == "unknown":
        painter.setPen(QPen(QColor(theme.dim), 1.2))
        painter.setBrush(Qt.BrushStyle.NoBrush)
    else:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.border))
    painter.drawEllipse(dot.adjusted(0.5, 0.5, -0.5, -0.5))
    if area.width() > _DOT_PX + 1:
        painter.setPen(QColor(theme.warning if finding.state == "left" else theme.dim))
        text_area = area.adjusted(_DOT_PX + 3, 0, 0, 0)
        painter.drawText(text_area, Qt.AlignmentFlag.AlignVCenter, NAMES[finding.name])


STATES = {"kept": "kept", "left": "caution", "unknown": "unknown"}
_OLDER = "updating: of an older design"
_NAME = "Validity of the prediction"
_TEXT, _PALE = 0.92, 0.45


class ValidityLamps(QWidget):
    """Shows a `LampRow`, emits which lamp was chosen, and shows stale findings pale."""

    #: The name of the chosen lamp, and the position of its explanation on the screen.
    chosen = Signal(str, QPoint)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("validity_lamps")
        self.setAccessibleName(_NAME)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.findings: Findings = ()
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._follow_staleness)

    @property
    def text_font(self) -> QFont:
        """The font of the names, of the present size."""
        return scaled(self.font(), _TEXT)

    @property
    def row(self) -> LampRow:
        """The lamps of the present findings."""
        return LampRow(findings=self.findings, metrics=QFontMetrics(self.text_font))

    @property
    def places(self) -> list[tuple[Finding, QRectF]]:
        """The area of each lamp."""
        return self.row.places(QRectF(self.rect()))

    def show_findings(self, findings: Findings) -> None:
        """Take over new findings."""
        self._staleness.set_stale(False)
        if findings != self.findings:
            self.findings = findings
            self._describe()
            lit = sum(lamp.state == "left" for lamp in self.row.lamps)
            self.setAccessibleName(f"{_NAME}: {lit or 'no'} caution{'' if lit == 1 else 's'}")
            self.updateGeometry()
        self.update()

    def set_stale(self, stale: bool) -> None:
        """Take over whether the findings belong to an older design; shown after a while."""
        self._staleness.set_stale(stale)

    def _follow_staleness(self) -> None:
        self._describe()
        self.update()

    def _describe(self) -> None:
        states = [f"{NAMES[lamp.name]}: {STATES[lamp.state]}" for lamp in self.row.lamps]
        self.setAccessibleDescription("; ".join([_OLDER] * self._staleness.is_stale + states))

    def sizeHint(self) -> QSize:
        return self._size(self.row.whole_px)

    def minimumSizeHint(self) -> QSize:
        return self._size(self.row.least_px)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            finding = self.row.at(event.pos().x(), QRectF(self.rect()))
            text = "" if finding is None else _lamp_text(finding, stale=self._staleness.is_stale)
            QToolTip.showText(event.globalPos(), text, self)
            return True
        return super().event(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        finding = self.row.at(event.position().x(), QRectF(self.rect()))
        if event.button() == Qt.MouseButton.LeftButton and finding is not None:
            self._choose(finding)
        else:
            super().mousePressEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        keys = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space)
        if event.key() in keys and (lamps := self.row.lamps):
            lit = (lamp for lamp in lamps if lamp.state == "left")
            self._choose(next(lit, lamps[0]))
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(self.text_font)
        painter.setOpacity(_PALE if self._staleness.is_stale else 1.0)
        for finding, area in self.places:
            paint_lamp(painter, finding, area, current_theme())
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())
        painter.end()

    def _size(self, width_px: int) -> QSize:
        return QSize(width_px, QFontMetrics(self.text_font).height() + 2)

    def _choose(self, finding: Finding) -> None:
        self.chosen.emit(finding.name, self.mapToGlobal(QPoint(0, 0)))


def _lamp_text(finding: Finding, *, stale: bool = False) -> str:
    name = NAMES[finding.name]
    head = f"{name[:1].upper()}{name[1:]}: {STATES[finding.state]}"
    head = f"{head} · {_OLDER}" if stale else head
    return f"{head}\n{finding.sentence}\nClick to see what can be done."


_TITLES = {
    "inputs": "Inputs",
    "band": "Measured band",
    "drive": "Velocity of the probe",
    "spacing": "Spacing of the outputs",
    "noise": "Signal to noise",
    "limb": "Limb",
    "scaling": "Scaling",
}
_REPAIRS = {
    "band_limit": "Limit to the band",
    "quieter": "Play within it",
    "probe_scaling": "Use probe scaling",
    "deselect": "Deselect them",
}
_TEXT_EM = 28


class ValidityCard(QFrame):
    """A card over the status bar; it closes at the next click elsewhere, or with Esc."""

    #: The `Finding` whose cause is to be repaired.
    repair_requested = Signal(object)

    def __init__(self, findings: Findings, first: str, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("validity_card")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        grid = QGridLayout(self)
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

    def _add(self, grid: QGridLayout, row: int, finding: Finding, *, chosen: bool) -> None:
        title = QLabel(f"{_TITLES[finding.name]}\n{STATES[finding.state]}")
        set_tone(title, "warning" if finding.state == "left" else "dim")
        font = title.font()
        font.setBold(chosen)
        title.setFont(font)
        label = QLabel(finding.sentence)
        label.setObjectName(f"validity_{finding.name}")
        label.setWordWrap(True)
        # Grids do not take the height of wrapped text into account.
        width = _TEXT_EM * self.fontMetrics().horizontalAdvance("m")
        label.setFixedWidth(width)
        label.setFixedHeight(label.heightForWidth(width))
        top = Qt.AlignmentFlag.AlignTop
        grid.addWidget(title, row, 0, top)
        grid.addWidget(label, row, 1, top)
        if finding.repair:
            button = QPushButton(_REPAIRS[finding.repair])
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


class Validity(QObject):
    """Lights the lamps once edits pause; while they are hidden nothing is computed for them.

    Parameters
    ----------
    panels
        The skin map among them hatches outputs that are mostly noise.
    status_bar
        Shows the lamps.
    """

    def __init__(
        self,
        document: Document,
        engine: Engine,
        panels: PanelRegistry,
        status_bar: QStatusBar,
    ) -> None:
        super().__init__(document)
        self._document, self._engine = document, engine
        self._panels = panels
        self._noisy: tuple[int, ...] = ()
        panels.each(lambda panel: panel.show_noisy(self._noisy))
        self._shown: Request | None = None
        # The sources of the present findings; None without findings.
        self._judged: Mapping[str, Any] | None = None
        self.lamps = ValidityLamps()
        status_bar.addPermanentWidget(self.lamps)
        self._idle = QTimer(self, singleShot=True, interval=_IDLE_MS)
        self._idle.timeout.connect(self._judge)
        engine.finished.connect(self._note)
        document.changed.connect(self._follow)
        self.lamps.chosen.connect(self._explain)

    def _follow(self) -> None:
        """Show whether the findings would have other sources now."""
        if self._judged is None:
            return
        now = sources_shown(self._document.design, self._document.view)
        names = self._engine.upstream_of(_WANTED) & now.keys()
        self.lamps.set_stale(any(self._judged[name] != now[name] for name in names))

    def _note(self, outcome: Outcome) -> None:
        request = outcome.request
        if request.place == (FIRST_SLOT, Purpose.SHOW):
            judged = outcome.values is not None and not too_large(request.given["limb"])
            self._shown = request if judged else None
            if self._shown is None:
                self._show_outcome(None)
            else:
                self._idle.start()
        elif request.place == (FIRST_SLOT, Purpose.JUDGE) and self._is_shown(request):
            self._show_outcome(outcome)

    def _is_shown(self, request: Request) -> bool:
        return self._shown is not None and request.given == self._shown.given

    def _judge(self) -> None:
        if self._shown is not None and self.lamps.isVisible():
            self._engine.request(replace(self._shown, wanted=_WANTED, purpose=Purpose.JUDGE))

    def _show_outcome(self, outcome: Outcome | None) -> None:
        findings = () if outcome is None or outcome.values is None else outcome.values["validity"]
        self.lamps.show_findings(findings)
        self._judged = None if outcome is None else outcome.request.given
        # The design may have been edited since.
        self._follow()
        self._noisy = next((finding.outputs for finding in findings if finding.name == "noise"), ())
        for panel in self._panels:
            panel.show_noisy(self._noisy)

    def _explain(self, name: str, position: QPoint) -> None:
        card = ValidityCard(self.lamps.findings, name, self.lamps)
        card.repair_requested.connect(self._repair)
        card.open_above(position)

    def _repair(self, finding: Finding) -> None:
        self._document.apply(edits.mend(self._document.design, self._document.view, finding))
