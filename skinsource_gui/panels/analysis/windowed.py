"""Maps of consecutive windows."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QRectF

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.comparing import match_text
from skinsource.design.design import Design
from skinsource.design.labels import limb_label, signal_label
from skinsource.design.view import WINDOW_COUNT, WINDOW_LENGTH, WINDOWS_CUT, View
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.panels.analysis.view import AnalysisView
from skinsource_gui.panels.analysis.window_strip import (
    StripView,
    WindowedContent,
    paint_strip,
    strip_layout,
    windows_heading,
)
from skinsource_gui.plots.small_map import level_style, small_map_of
from skinsource_gui.qt.fitting import FoldingRow, grouped
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme, on_paper
from skinsource_gui.state.compared import SILENT

# Height of a picture in lines of text, so that maps and plot have room in a flat picture.
_LINES_OF_PICTURE = 26
_TOO_SHORT = "No whole window fits into the response. Choose shorter ones."


class WindowedView(AnalysisView):
    """A map of the RMS for each of consecutive windows, and how far each of them reaches."""

    title: ClassVar[str] = "Time windows"
    name: ClassVar[str] = "windowed"
    copies: ClassVar[bool] = False

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self.strip = StripView(self)
        self.cells = {
            "windows_cut": FieldCell("windows_cut", WINDOWS_CUT, self, edited=self._change),
            "window_count": FieldCell("window_count", WINDOW_COUNT, self, edited=self._change),
            "window_s": FieldCell("window_s", WINDOW_LENGTH, self, edited=self._change),
        }
        cut, *others = self.cells.values()
        fields = [part for cell in others for part in (cell.label, cell)]
        gap_px = UNIT_PX // 2
        groups = grouped(cut.label, cut, gap_px=gap_px), grouped(*fields, None, gap_px=gap_px)
        in_column(
            FoldingRow(groups, gap_px),
            (self.strip, 1),
            of=self,
            margins=UNIT_PX // 2,
            gap_px=UNIT_PX // 2,
        )
        self.setFocusProxy(self.strip)
        self.guessed = self.computed = (self.strip,)
        self.strip.time_chosen.connect(self.playhead_requested)
        self._show_view()

    @property
    def needs(self) -> frozenset[str]:
        return frozenset(
            {
                "limb_map",
                "limb_data",
                "surface",
                "sample_rate_hz",
                "windows",
                "levels_of_windows_db",
                "surface_of_windows_db",
                "extents_of_windows",
                "noisy_outputs_of_windows",
                "windows_in_noise",
                "match_gain",
            }
        )

    @property
    def message(self) -> str:
        return self.strip.message

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._show_view()
        content = self.strip.content
        if content is None:
            return
        looks = self._looks
        if any(getattr(content, name) != value for name, value in looks.items()):
            # Only texts and colours change, which needs no new results.
            self.strip.show_content(replace(content, **looks), self.strip.message)

    def show_playhead(self, view: View) -> None:
        self._view = view
        self.strip.show_time(view.playhead_s)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if self._design is None:
            return
        levels = results["levels_of_windows_db"]
        maps = {"surface_levels_db": results["surface_of_windows_db"], **results}
        content = WindowedContent(
            design=self._design,
            small=small_map_of(maps),
            windows=results["windows"],
            sample_rate_hz=results["sample_rate_hz"],
            levels_db=levels,
            field_levels_db=results["surface_of_windows_db"],
            extents=results["extents_of_windows"],
            noisy=results["noisy_outputs_of_windows"],
            in_noise=results["windows_in_noise"],
            synthetic=results["limb_data"].synthetic,
            matched=match_text(results["match_gain"]),
            **self._looks,
        )
        message = ""
        if content.windows.count == 0:
            message = _TOO_SHORT
        elif float(np.max(levels)) <= FLOOR_DB:
            message = SILENT
        self.strip.show_content(content, message)
        self.strip.show_time(self._view.playhead_s)

    def say_instead(self, message: str) -> None:
        self.strip.show_content(None, message)

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the strip for a page or a slide, with all that is needed to read it; size in px."""
        font = painter.font()
        font.setFamily(self.font().family())
        font.setPixelSize(max(round(min(width / 62, height / _LINES_OF_PICTURE)), 8))
        painter.setFont(font)
        painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(theme.base))
        content, line = self.strip.content, float(painter.fontMetrics().height())
        painter.setPen(QtGui.QColor(theme.text))
        heading = QRectF(line, 0.5 * line, width - 2 * line, 3.4 * line)
        if content is None or self.strip.message:
            painter.drawText(heading, 0, self._heading())
            painter.drawText(QRectF(line, 5 * line, width, line), 0, self.strip.message)
            return
        room = QRectF(0.0, 4.0 * line, width, height - 4.5 * line)
        layout = strip_layout(room, content.windows.count, line)
        width_of = painter.fontMetrics().horizontalAdvance
        times = windows_heading(content, width_of, heading.width())
        painter.drawText(heading, 0, self._heading(times))
        with on_paper():
            paint_strip(painter, content, layout, theme)

    @property
    def _looks(self) -> dict[str, Any]:
        """Fields of the content that follow from the view alone."""
        delay_s = 0.0
        if self._design is not None and not self._view.delay_removed:
            delay_s = facts_of(self._design.limb).pre_trigger_delay_s
        return {"traces_delay_s": delay_s, "look": level_style(self._view)}

    def _heading(self, times: str = "") -> str:
        if self._design is None:
            return ""
        content, view = self.strip.content, self._view
        limb = limb_label(self._design.limb).title
        lines = [f"{limb}: RMS of {signal_label(view.axes, view.method)} in windows"]
        if times:
            lines.append(times)
        if content is not None and content.synthetic:
            lines.append("SYNTHETIC LIMB")
        return "\n".join(lines)

    def _show_view(self) -> None:
        for name, cell in self.cells.items():
            cell.set_value(getattr(self._view, name))
        by_count = self._view.windows_cut == "count"
        for name, shown in (("window_count", by_count), ("window_s", not by_count)):
            self.cells[name].setVisible(shown)
            self.cells[name].label.setVisible(shown)
        self.strip.show_time(self._view.playhead_s)

    def _change(self, name: str, value: object, gesture: int | None) -> None:
        changed: dict[str, Any] = {name: value}
        self.view_changed.emit(replace(self._view, **changed))
