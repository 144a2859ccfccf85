"""The page on which a stimulus is looked at, before it is written."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFrame,
    QGraphicsOpacityEffect,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from skinsource.actuators.rigs import UNCALIBRATED
from skinsource.base.quoting import sentence
from skinsource.design.design import Design
from skinsource.design.motions import in_ms
from skinsource.design.view import View
from skinsource.export.stimulus_export.preparing import Overview
from skinsource_gui.stimulus_page.channels_view import ChannelsView
from skinsource_gui.stimulus_page.order import Order
from skinsource_gui.stimulus_page.preparing_row import PreparingRow
from skinsource_gui.stimulus_page.preparing_worker import PreparingWorker
from skinsource_gui.stimulus_page.remembering import recall, remembered
from skinsource_gui.stimulus_page.stimulus_form import StimulusForm
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.over.veil import PALE

_LEFT_PX = 300


class StimulusPage(QDialog):
    """Shows the channels as they will be, and asks how and as what they are written.

    Parameters
    ----------
    design, view
        What is exported, and what is selected there.
    kept
        How the last one was exported, as ``chosen`` told.
    machine_rig
        Rig file that this machine plays for; empty: none.
    """

    #: The `Order` and its `Overview`; whether what clips was confirmed; what is remembered.
    chosen = Signal(object, object, bool, str)

    def __init__(
        self,
        design: Design,
        view: View,
        parent: QWidget | None = None,
        kept: str = "",
        machine_rig: str = "",
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("stimulus_page")
        self.setWindowTitle("Export stimulus")
        self.resize(960, 680)
        self._colours = {one.id: one.colour for one in design.inputs}
        self._wanted: Order | None = None
        self._shown: tuple[Order, Overview] | None = None
        self.form = StimulusForm(design, view)
        self.channels = ChannelsView()
        self._summary, self._loses, self._problem = QLabel(), QLabel(), QLabel()
        self._preparing = PreparingRow()
        self._confirm = QCheckBox("Write it all the same")
        self._buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        self._name_parts()
        self._lay_out()
        self._worker = PreparingWorker(design, self)
        self._connect()
        recall(self.form, kept, machine_rig)
        self._machine_rig = machine_rig
        self.form.want()

    @property
    def busy(self) -> bool:
        """Whether something is wanted that is not shown yet."""
        return self._wanted is not None and self._shown is None

    @property
    def ready(self) -> bool:
        """Whether what is shown can be written."""
        return self._export_button.isEnabled()

    def done(self, result: int) -> None:
        """Close it, with or without an export."""
        shown, confirmed = self._shown, self._confirm.isChecked()
        kept = remembered(self.form, self._machine_rig)
        # It is gone at once, whatever is still computed.
        super().done(result)
        self._worker.close()
        if result == QDialog.DialogCode.Accepted and shown is not None:
            self.chosen.emit(*shown, confirmed, kept)

    def _name_parts(self) -> None:
        self._export_button = self._buttons.button(QDialogButtonBox.StandardButton.Ok)
        self._export_button.setText("Export…")
        self._export_button.setObjectName("stimulus_export")
        self._export_button.setEnabled(False)
        for label, name, tone in (
            (self._summary, "stimulus_summary", ""),
            (self._loses, "stimulus_loses", "dim"),
            (self._problem, "stimulus_problem", "error"),
        ):
            label.setObjectName(name)
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            set_tone(label, tone)
        self._confirm.setObjectName("stimulus_confirm")
        self._confirm.hide()
        self._problem.hide()

    def _lay_out(self) -> None:
        left = _scrolled(self.form, "stimulus_fields")
        left.setFixedWidth(_LEFT_PX)
        left.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        right = QVBoxLayout()
        right.setSpacing(UNIT_PX)
        pictures = _scrolled(self.channels, "stimulus_scroll")
        pictures.setAccessibleName("Channels; arrow keys scroll")
        right.addWidget(pictures, 1)
        for part in (self._summary, self._loses, self._problem, self._confirm):
            right.addWidget(part)
        columns = QHBoxLayout()
        columns.setSpacing(2 * UNIT_PX)
        columns.addWidget(left)
        columns.addLayout(right, 1)
        rows = QVBoxLayout(self)
        rows.addLayout(columns, 1)
        foot = QHBoxLayout()
        foot.addSpacing(_LEFT_PX + columns.spacing())
        foot.addWidget(self._preparing, 1)
        foot.addWidget(self._buttons)
        rows.addLayout(foot)

    def _connect(self) -> None:
        self.form.changed.connect(self._want)
        self.form.refused.connect(self._show_refused)
        self._worker.ready.connect(self._show_ready)
        self._worker.progressed.connect(self._show_progress)
        self._worker.failed.connect(self._show_failed)
        self._confirm.toggled.connect(self._show_button)
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)

    def _want(self, order: Order) -> None:
        self._wanted, self._shown = order, None
        # What was confirmed was about something else.
        self._confirm.setChecked(False)
        self._set_pale(True)
        self._preparing.begin()
        self._export_button.setEnabled(False)
        self._worker.prepare(order)

    def _show_ready(self, order: Order, overview: Overview) -> None:
        if order is not self._wanted:
            return
        self._shown = order, overview
        self._preparing.end()
        self._set_pale(False)
        self.channels.show_overview(overview, self._colours)
        self._summary.setText(summary_of(overview))
        self._loses.setText(
            " ".join(filter(None, (overview.edges, overview.loses, calibration_of(overview))))
        )
        self._show_problem(" ".join(overview.objections), ask=bool(overview.objections))

    def _show_progress(self, order: Order, done: int, total: int) -> None:
        if order is self._wanted:
            self._preparing.show_progress(done, total)

    def _set_pale(self, pale: bool) -> None:
        """Say whether what is shown and said is about to change."""
        self.channels.set_pale(pale)
        for label in (self._summary, self._loses, self._problem):
            effect = label.graphicsEffect()
            if not isinstance(effect, QGraphicsOpacityEffect):
                effect = QGraphicsOpacityEffect(label, opacity=PALE)
                label.setGraphicsEffect(effect)
            effect.setEnabled(pale)

    def _show_failed(self, order: Order, words: str) -> None:
        if order is self._wanted:
            self._show_refused(words)

    def _show_refused(self, words: str) -> None:
        self._wanted = self._shown = None
        self._preparing.end()
        self._set_pale(False)
        self.channels.show_overview(None, {})
        self._summary.setText("")
        self._loses.setText("")
        self._show_problem(sentence(words), ask=False)

    def _show_problem(self, words: str, *, ask: bool) -> None:
        self._problem.setText(words)
        self._problem.setVisible(bool(words))
        self._confirm.setVisible(ask)
        self._show_button()

    def _show_button(self) -> None:
        agreed = self._confirm.isHidden() or self._confirm.isChecked()
        self._export_button.setEnabled(self._shown is not None and agreed)
        self._export_button.setDefault(self._export_button.isEnabled())


def summary_of(overview: Overview) -> str:
    """How much will be written, what full scale stands for, and what it is equalised for."""
    n = len(overview.channels)
    many = "" if overview.n_files == 1 else f" in {overview.n_files} files"
    rate = f"{overview.rate_hz:,g}".replace(",", " ")
    unit = "" if overview.unit == "1" else f" {overview.unit}"
    # What the design wants is no volts of a device before a rig says so.
    stands = "shall be" if _wants_volts(overview) else "is"
    size = sentence(
        f"{n} channel{'' if n == 1 else 's'}{many}, {duration_words(overview.duration_s)} at "
        f"{rate} Hz, about {bytes_in_words(overview.n_bytes)}. Full scale {stands} "
        f"{overview.full_scale:.4g}{unit}"
    )
    return f"{size} {sentence(overview.equalised)}"


def calibration_of(overview: Overview) -> str:
    """Whether accelerations follow from the samples, as a sentence."""
    if _wants_volts(overview):
        return (
            "Uncalibrated: no rig says how many volts output and amplifier give. Choose one, or "
            "set the amplifier so that full scale is as many."
        )
    return sentence(f"{overview.calibration[:1].upper()}{overview.calibration[1:]}")


def _wants_volts(overview: Overview) -> bool:
    """Whether volts are known that the actuators shall get, and none that they will."""
    return overview.unit == "V" and overview.calibration == UNCALIBRATED


def duration_words(time_s: float) -> str:
    """A length of time as people read it: ms below a second."""
    if time_s < 1e-3:
        return f"{1e3 * time_s:.2g} ms"
    return in_ms(time_s) if time_s < 1.0 else f"{time_s:.4g} s"


def bytes_in_words(n_bytes: int) -> str:
    """A number of bytes as people read it."""
    for factor, unit in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if n_bytes >= factor:
            return f"{n_bytes / factor:.3g} {unit}"
    return f"{n_bytes} bytes"


def _scrolled(inside: QWidget, name: str) -> QScrollArea:
    scroll = QScrollArea()
    scroll.setObjectName(name)
    scroll.setFrameShape(QFrame.Shape.NoFrame)
    scroll.setWidgetResizable(True)
    scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    scroll.setWidget(inside)
    return scroll
