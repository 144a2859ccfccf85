"""The page on which a stimulus is examined before it is written.

A worker prepares the stimulus that the form orders; the page shows its channels with their peaks
and the samples that would clip, and what the export loses.
"""

from collections.abc import Mapping
from functools import partial

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QRectF, QSize, Qt, Signal

from skinsource.actuators.rigs import UNCALIBRATED
from skinsource.base.arrays import Floats
from skinsource.base.errors import Stopped
from skinsource.base.quoting import sentence
from skinsource.base.work import counted
from skinsource.design.design import Design
from skinsource.design.motions import ms_text
from skinsource.design.view import View
from skinsource.export.formats.format import ChannelOverview
from skinsource.export.stimulus_export.preparing import PreparedStimulus, prepare_stimulus
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.pages.stimulus.form import Order, StimulusForm, recall, remembered
from skinsource_gui.qt.buttons import scrolled
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.overlays import PALE, Staleness
from skinsource_gui.qt.theme import UNIT_PX, current_theme, set_tone, tabular
from skinsource_gui.state.worker import Worker, fault_text

_ROW_PX, _GAP_PX = 58, 6
_TEXT_PX = 208
_LEAST_PX = 160


class ChannelsView(QtWidgets.QWidget):
    """Paints one row for each channel."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("stimulus_channels")
        self._channels: tuple[ChannelOverview, ...] = ()
        self._colours: Mapping[int, int] = {}
        self._pale = False
        self.setSizePolicy(
            QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed
        )
        self.setAccessibleName("Channels as they will be written")

    @property
    def channels(self) -> tuple[ChannelOverview, ...]:
        """The channels that are painted."""
        return self._channels

    def sizeHint(self) -> QSize:
        return QSize(_TEXT_PX + 2 * _LEAST_PX, len(self._channels) * (_ROW_PX + _GAP_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(_TEXT_PX + _LEAST_PX, self.sizeHint().height())

    def show_channels(
        self, channels: tuple[ChannelOverview, ...], colours: Mapping[int, int]
    ) -> None:
        """Paint ``channels``; ``colours`` has the number of the colour of each input."""
        self._channels, self._colours, self._pale = channels, colours, False
        lines = [line for channel in channels for line in channel_lines(channel)]
        self.setAccessibleDescription("; ".join(lines))
        self.updateGeometry()
        self.update()

    def set_pale(self, pale: bool) -> None:
        """Paint the channels pale where they are out of date."""
        self._pale = pale
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setOpacity(PALE if self._pale else 1.0)
        for row, channel in enumerate(self._channels):
            top = row * (_ROW_PX + _GAP_PX)
            if event.rect().intersects(QRectF(0, top, self.width(), _ROW_PX).toRect()):
                self._paint_text(painter, channel, top)
                area = QRectF(_TEXT_PX, top, self.width() - _TEXT_PX, _ROW_PX)
                self._paint_picture(painter, channel, area)

    def _paint_text(self, painter: QtGui.QPainter, channel: ChannelOverview, top: float) -> None:
        title, peak, clipped = (*channel_lines(channel), "")[:3]
        room = QRectF(0, top, _TEXT_PX - UNIT_PX, _ROW_PX / 3)
        left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        painter.setFont(tabular(self.font()))
        metrics = painter.fontMetrics()
        rows = (
            (title, current_theme().text),
            (peak, current_theme().dim),
            (clipped, current_theme().error),
        )
        for number, (text, colour) in enumerate(rows):
            painter.setPen(QtGui.QColor(colour))
            elided = metrics.elidedText(text, Qt.TextElideMode.ElideRight, int(room.width()))
            painter.drawText(room.translated(0, number * _ROW_PX / 3), left, elided)

    def _paint_picture(
        self, painter: QtGui.QPainter, overview: ChannelOverview, area: QRectF
    ) -> None:
        painter.fillRect(area, QtGui.QColor(current_theme().base))
        middle, reach = area.center().y(), area.height() / 2.0 - 3.0
        painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().grid), 1))
        for level in (-1.0, 0.0, 1.0):
            y = middle - reach * level
            painter.drawLine(QLineF(area.left(), y, area.right(), y))
        inputs = overview.channel.inputs
        colour = QtGui.QColor(current_theme().dim)
        if inputs:
            colour = current_theme().input_colour(self._colours.get(inputs[0], 0))
        low, high = joined(np.clip(overview.extremes, -1.0, 1.0))
        x = area.left() + (np.arange(low.size) + 0.5) * area.width() / low.size
        width = max(area.width() / low.size, 1.0)
        painter.setPen(QtGui.QPen(colour, width, c=Qt.PenCapStyle.FlatCap))
        tops, bottoms = middle - reach * high, middle - reach * low
        painter.drawLines(
            [
                QLineF(at, y - 0.5, at, max(bottom, y) + 0.5)
                for at, y, bottom in zip(x.tolist(), tops.tolist(), bottoms.tolist(), strict=True)
            ]
        )
        beyond = np.flatnonzero((abs(overview.extremes) > 1.0).any(axis=0))
        if overview.clipped and beyond.size:
            painter.setPen(QtGui.QPen(QtGui.QColor(current_theme().error), max(width, 2.0)))
            painter.drawLines(
                [QLineF(at, area.top(), at, area.top() + 5.0) for at in x[beyond].tolist()]
            )


def joined(extremes: Floats) -> Floats:
    """Return least and largest values, (2, n_columns), extended to meet the stretch before.

    Otherwise stretches of few samples would be painted as separate dots.
    """
    low, high = extremes
    extended = extremes.copy()
    extended[0, 1:] = np.minimum(low[1:], high[:-1])
    extended[1, 1:] = np.maximum(high[1:], low[:-1])
    return extended


def channel_lines(overview: ChannelOverview) -> list[str]:
    """Return lines on a channel: its title, its strength, and how many samples would clip."""
    channel = overview.channel
    title = channel.title if channel.place is None else f"Place {channel.place}, {channel.title}"
    peak = "silent" if overview.peak == 0.0 else f"peak {20.0 * np.log10(overview.peak):z.1f} dB"
    rms = "" if overview.rms == 0.0 else f", RMS {20.0 * np.log10(overview.rms):z.1f} dB"
    lines = [f"{channel.number}  {title}", f"{peak}{rms}".replace("-", "\u2212")]
    if overview.clipped:
        lines.append(f"{counted(overview.clipped, 'sample')} would clip")
    return lines


_BAR_PX = 96


class PreparingRow(QtWidgets.QWidget):
    """Shows a label and a bar while a stimulus is computed.

    It appears with a delay, so that it does not flicker during short computations.
    """

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("stimulus_preparing")
        self._label = QtWidgets.QLabel()
        self._label.setObjectName("stimulus_computing")
        self._label.setFont(tabular(self.font()))
        self._bar = QtWidgets.QProgressBar()
        self._bar.setObjectName("stimulus_progress")
        self._bar.setAccessibleName("Progress")
        self._bar.setTextVisible(False)
        self._bar.setFixedSize(_BAR_PX, UNIT_PX)
        in_row(self._label, self._bar, None, of=self, margins=0, gap_px=UNIT_PX)
        policy = self.sizePolicy()
        # The buttons next to it stay where they are.
        policy.setRetainSizeWhenHidden(True)
        self.setSizePolicy(policy)
        self.staleness = Staleness(self)
        self.staleness.changed.connect(self.setVisible)
        self.begin()
        self.hide()

    def begin(self) -> None:
        """Note that a computation begins, whose progress is not known yet."""
        self.show_progress(0, 0)
        self.staleness.set_stale(True)

    def end(self) -> None:
        """Note that the computation has ended."""
        self.staleness.set_stale(False)

    def show_progress(self, done: int, total: int) -> None:
        """Show how much of the total is done; a total of 0: not known."""
        # A bar whose total is not known looks full.
        self._bar.setVisible(bool(total))
        self._bar.setMaximum(max(total, 1))
        self._bar.setValue(done)
        percent = f" {100 * done // total} %" if total else ""
        self._label.setText(f"Computing\u2026{percent}")


_LEFT_PX = 300
#: Of the worker's tasks: only the newest order is prepared.
_ORDER = "order"


class StimulusPage(ToolPage):
    """Shows the channels as they will be written, and asks for format and options.

    Parameters
    ----------
    design, view
        The design that is exported, and what is selected in it.
    last_settings
        Settings of the last export, as ``chosen`` emitted them.
    """

    #: The `PreparedStimulus`; whether clipping was confirmed; settings to remember.
    chosen = Signal(object, bool, str)

    def __init__(
        self,
        design: Design,
        view: View,
        parent: QtWidgets.QWidget | None = None,
        last_settings: str = "",
    ) -> None:
        super().__init__(parent, "stimulus_page", "Export stimulus", (960, 680))
        self._colours = {track.id: track.colour for track in design.inputs}
        self._ordered: Order | None = None
        #: What is shown, and would be written; None while it is prepared.
        self.prepared: PreparedStimulus | None = None
        self.form = StimulusForm(design, view)
        self.channels = ChannelsView()
        self._summary, self._loses, self._problem = (
            QtWidgets.QLabel(),
            QtWidgets.QLabel(),
            QtWidgets.QLabel(),
        )
        self._preparing = PreparingRow()
        self._confirm = QtWidgets.QCheckBox("Write it all the same")
        self._buttons = QtWidgets.QDialogButtonBox(
            QtWidgets.QDialogButtonBox.StandardButton.Ok
            | QtWidgets.QDialogButtonBox.StandardButton.Cancel
        )
        self._name_parts()
        self._lay_out()
        self._design, self._worker = design, Worker("skinsource-stimulus", self)
        self._connect()
        recall(self.form, last_settings)
        self.form.emit_order()

    @property
    def busy(self) -> bool:
        """Whether the order that is prepared is not shown yet."""
        return self._ordered is not None and self.prepared is None

    @property
    def ready(self) -> bool:
        """Whether the stimulus that is shown can be written."""
        return self._export_button.isEnabled()

    def done(self, result: int) -> None:
        """Close the page, with or without an export."""
        prepared, confirmed = self.prepared, self._confirm.isChecked()
        settings = remembered(self.form)
        # The page closes before the worker, which may take time to stop.
        super().done(result)
        self._worker.close()
        if result == QtWidgets.QDialog.DialogCode.Accepted and prepared is not None:
            self.chosen.emit(prepared, confirmed, settings)

    def _name_parts(self) -> None:
        self._export_button = self._buttons.button(QtWidgets.QDialogButtonBox.StandardButton.Ok)
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
        left = scrolled(self.form, "stimulus_fields")
        left.setFixedWidth(_LEFT_PX)
        left.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        pictures = scrolled(self.channels, "stimulus_scroll")
        pictures.setAccessibleName("Channels; arrow keys scroll")
        right = in_column(
            (pictures, 1), self._summary, self._loses, self._problem, self._confirm, gap_px=UNIT_PX
        )
        columns = in_row(left, (right, 1), gap_px=2 * UNIT_PX)
        foot = QtWidgets.QHBoxLayout()
        foot.addSpacing(_LEFT_PX + columns.spacing())
        foot.addWidget(self._preparing, 1)
        foot.addWidget(self._buttons)
        in_column((columns, 1), foot, of=self)

    def _connect(self) -> None:
        self.form.changed.connect(self._order)
        self.form.refused.connect(self._show_refused)
        self._confirm.toggled.connect(self._show_button)
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)

    def _order(self, order: Order) -> None:
        self._ordered, self.prepared = order, None
        # Clipping was confirmed for another order.
        self._confirm.setChecked(False)
        self._set_pale(True)
        self._preparing.begin()
        self._export_button.setEnabled(False)
        self._worker.run_newest(
            _ORDER, partial(self._prepare, order), partial(self._receive, order)
        )

    def _prepare(self, order: Order) -> PreparedStimulus:
        """Prepare the stimulus, in the thread of the worker."""
        return prepare_stimulus(
            self._design,
            order.format,
            order.rate_hz,
            order.options,
            actuation=order.actuation,
            rig=order.rig or "none",
            equaliser=order.equaliser or "none",
            progress=lambda done, total, _: self._worker.tell(
                self._show_progress, order, done, total
            ),
            stop=partial(self._worker.is_outdated, _ORDER),
        )

    def _receive(
        self, order: Order, prepared: PreparedStimulus | None, error: Exception | None
    ) -> None:
        if order is not self._ordered or isinstance(error, Stopped):
            return
        if prepared is None:
            self._show_refused(fault_text(error) if error else "")
        else:
            self._show_prepared(prepared)

    def _show_prepared(self, prepared: PreparedStimulus) -> None:
        self.prepared = prepared
        self._preparing.end()
        self._set_pale(False)
        self.channels.show_channels(prepared.channels, self._colours)
        self._summary.setText(summary_of(prepared))
        notes = prepared.edges, prepared.loses, calibration_of(prepared)
        self._loses.setText(" ".join(filter(None, notes)))
        objections = " ".join(filter(None, (prepared.advice_on_loss, *prepared.objections)))
        self._show_problem(objections, ask=bool(objections))

    def _show_progress(self, order: Order, done: int, total: int) -> None:
        if order is self._ordered:
            self._preparing.show_progress(done, total)

    def _set_pale(self, pale: bool) -> None:
        """Show channels and texts pale where they are out of date."""
        self.channels.set_pale(pale)
        for label in (self._summary, self._loses, self._problem):
            effect = label.graphicsEffect()
            if not isinstance(effect, QtWidgets.QGraphicsOpacityEffect):
                effect = QtWidgets.QGraphicsOpacityEffect(label, opacity=PALE)
                label.setGraphicsEffect(effect)
            effect.setEnabled(pale)

    def _show_refused(self, reason: str) -> None:
        self._ordered = self.prepared = None
        self._preparing.end()
        self._set_pale(False)
        self.channels.show_channels((), {})
        self._summary.setText("")
        self._loses.setText("")
        self._show_problem(sentence(reason), ask=False)

    def _show_problem(self, text: str, *, ask: bool) -> None:
        self._problem.setText(text)
        self._problem.setVisible(bool(text))
        self._confirm.setVisible(ask)
        self._show_button()

    def _show_button(self) -> None:
        may_export = self._confirm.isHidden() or self._confirm.isChecked()
        self._export_button.setEnabled(self.prepared is not None and may_export)
        self._export_button.setDefault(self._export_button.isEnabled())


def summary_of(prepared: PreparedStimulus) -> str:
    """Return how much will be written, what full scale means, and how it is equalised."""
    file, n_files = prepared.files[0], len(prepared.files)
    many = "" if n_files == 1 else f" in {n_files} files"
    rate = f"{file.stimulus.sample_rate_hz:,g}".replace(",", " ")
    unit = "" if file.stimulus.unit == "1" else f" {file.stimulus.unit}"
    # Without a rig, it is not known that the device gives the volts that the actuators need.
    verb = "shall be" if _lacks_rig(prepared) else "is"
    size = sentence(
        f"{counted(len(prepared.channels), 'channel')}{many}, "
        f"{duration_text(file.stimulus.duration_s)} at {rate} Hz, about "
        f"{size_text(prepared.n_bytes)}. Full scale {verb} {file.full_scale:.4g}{unit}"
    )
    return f"{size} {sentence(prepared.equalised)}"


def calibration_of(prepared: PreparedStimulus) -> str:
    """Return a sentence on whether accelerations follow from the samples."""
    if _lacks_rig(prepared):
        return (
            "Uncalibrated: no rig says how many volts output and amplifier give. Choose one, or "
            "set the amplifier so that full scale is as many."
        )
    return sentence(f"{prepared.calibration[:1].upper()}{prepared.calibration[1:]}")


def _lacks_rig(prepared: PreparedStimulus) -> bool:
    """Return whether the actuators need known volts, and no rig states those of the device."""
    return prepared.files[0].stimulus.unit == "V" and prepared.calibration == UNCALIBRATED


def duration_text(time_s: float) -> str:
    """Return a duration as text, in ms below a second."""
    if time_s < 1e-3:
        return f"{1e3 * time_s:.2g} ms"
    return ms_text(time_s) if time_s < 1.0 else f"{time_s:.4g} s"


def size_text(n_bytes: int) -> str:
    """Return a number of bytes as text."""
    for factor, unit in ((1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if n_bytes >= factor:
            return f"{n_bytes / factor:.3g} {unit}"
    return f"{n_bytes} bytes"
