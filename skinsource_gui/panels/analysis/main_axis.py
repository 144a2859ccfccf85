"""The direction along which each selected output moves most."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any, ClassVar

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt

from skinsource.limbs.locations import output_name
from skinsource.signals.projection import MainAxes, ellipse
from skinsource_gui.panels.analysis.view import FigureView
from skinsource_gui.plots.figure import Figure
from skinsource_gui.qt.questions import tab_separated
from skinsource_gui.qt.theme import UNIT_PX, current_theme, translucent
from skinsource_gui.state.compared import SILENT

_LEAST_ROW_PX = 66.0
_LEAST_SIDE_PX = 40.0
_GAP_PX = 3.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MainAxisContent:
    """Main axes of outputs of a limb, along ``axes``, as in ``"xyz"``."""

    main_axes: MainAxes
    outputs: tuple[int, ...]
    axes: str
    limb: str = ""

    def text_of(self, rank: int) -> str:
        """Return the text on the main axis of one output."""
        main_axes, name = self.main_axes, output_name(self.outputs[rank], self.limb).short_name
        start = f"{self.outputs[rank]} {name}"
        if np.isnan(main_axes.share[rank]):
            return f"{start}: silent"
        if main_axes.none[rank]:
            return f"{start}: no principal axis"
        direction = ", ".join(
            f"{axis} {part:+.2f}"
            for axis, part in zip(self.axes, main_axes.direction[rank], strict=True)
        )
        return f"{start}: {direction} · {main_axes.share[rank]:.0%} of the variance".replace(
            "-", "−"
        )


class MainAxisPicture(Figure):
    """For each output its ellipse in each plane of two axes, and the main axis through it."""

    def __init__(self) -> None:
        super().__init__("main_axis_picture", "Principal axes")
        self.content: MainAxisContent | None = None
        self._cells: list[tuple[QRectF, int]] = []

    def show_axes(self, content: MainAxisContent) -> None:
        """Take over what to show."""
        self.content = content
        self.say("")

    def draw(self, painter: QtGui.QPainter, room: QRectF) -> None:
        content = self.content
        if content is None:
            return
        metrics = QtGui.QFontMetricsF(painter.font())
        line = metrics.height()
        count = len(content.outputs)
        planes = tuple(combinations(range(len(content.axes)), 2))
        cell = _cell_size(room, count, len(planes), line)
        # A cell that fills the room may be larger than it by rounding.
        across = max(int(room.width() / cell[0] + 1e-6), 1)
        fitting = max(int(room.height() / cell[1] + 1e-6), 1) * across
        n_drawn = count if count <= fitting else max(fitting - 1, 0)
        self._cells = []
        for rank in range(n_drawn):
            row, column = divmod(rank, across)
            place = QRectF(column * cell[0], row * cell[1], *cell)
            self._cells.append((place, rank))
            inner = place.adjusted(UNIT_PX / 2, 2, -UNIT_PX / 2, -2)
            self._draw_output(painter, content, inner, rank)
        if n_drawn < count:
            row, column = divmod(n_drawn, across)
            place = QRectF(column * cell[0], row * cell[1], *cell)
            painter.setPen(QtGui.QColor(current_theme().dim))
            text = f"and {count - n_drawn} more"
            painter.drawText(place, Qt.AlignmentFlag.AlignCenter, text)

    def read(self, at: QPointF) -> str:
        for place, rank in self._cells:
            if self.content is not None and place.contains(at):
                return self.content.text_of(rank)
        return ""

    def keys_area(self) -> QRectF:
        return QRectF() if self.message or not self._cells else QRectF(self.rect())

    def _draw_output(
        self, painter: QtGui.QPainter, content: MainAxisContent, place: QRectF, rank: int
    ) -> None:
        line = QtGui.QFontMetricsF(painter.font()).height()
        main_axes, theme = content.main_axes, current_theme()
        head = QRectF(place.left(), place.top(), place.width(), line)
        number = content.outputs[rank]
        if np.isnan(main_axes.share[rank]):
            text = "silent"
        elif main_axes.none[rank]:
            text = "no principal axis"
        else:
            text = f"{main_axes.share[rank]:.0%}"
        painter.setPen(theme.output_colour(rank))
        painter.drawText(head, Qt.AlignmentFlag.AlignLeft, f"{number}")
        painter.setPen(QtGui.QColor(theme.warning if text == "no principal axis" else theme.dim))
        painter.drawText(head, Qt.AlignmentFlag.AlignRight, text)
        planes = tuple(combinations(range(len(content.axes)), 2))
        each = place.width() / len(planes)
        for k, plane in enumerate(planes):
            area = QRectF(place.left() + k * each, place.top() + line, each, place.height() - line)
            self._draw_plane(painter, content, area.adjusted(2, 1, -2, -1), rank, plane)

    def _draw_plane(
        self,
        painter: QtGui.QPainter,
        content: MainAxisContent,
        area: QRectF,
        rank: int,
        plane: tuple[int, int],
    ) -> None:
        theme, largest = current_theme(), float(content.main_axes.deviation[rank, 0])
        metrics = QtGui.QFontMetricsF(painter.font())
        # Beside and above the ellipse there is room for the names of the axes.
        label_px = max(map(metrics.horizontalAdvance, content.axes)) + _GAP_PX
        room = area.adjusted(_GAP_PX, metrics.height(), -label_px, -_GAP_PX)
        centre, radius = room.center(), 0.5 * max(min(room.width(), room.height()), 0.0)
        painter.setPen(QtGui.QPen(QtGui.QColor(theme.grid), 1))
        painter.drawLine(QLineF(centre.x() - radius, centre.y(), centre.x() + radius, centre.y()))
        painter.drawLine(QLineF(centre.x(), centre.y() - radius, centre.x(), centre.y() + radius))
        painter.setPen(QtGui.QColor(theme.dim))
        height = metrics.height()
        right = QRectF(centre.x() + radius, centre.y() - height / 2.0, label_px, height)
        painter.drawText(right, Qt.AlignmentFlag.AlignCenter, content.axes[plane[0]])
        above = QRectF(centre.x() - label_px, centre.y() - radius - height, 2.0 * label_px, height)
        painter.drawText(above, Qt.AlignmentFlag.AlignCenter, content.axes[plane[1]])
        if largest <= 0.0:
            return
        scale = radius / largest
        points = ellipse(content.main_axes.covariance[rank], plane) * scale
        line = QtGui.QPolygonF([centre + QPointF(x, -y) for x, y in points])
        colour = theme.output_colour(rank)
        fill = translucent(colour, 50)
        painter.setPen(QtGui.QPen(colour, 1.2))
        painter.setBrush(fill)
        painter.drawPolygon(line)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if not content.main_axes.none[rank]:
            x, y = content.main_axes.direction[rank][list(plane)] * radius
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.text), 1.4))
            painter.drawLine(QLineF(centre + QPointF(-x, y), centre + QPointF(x, -y)))


def _cell_size(room: QRectF, count: int, n_planes: int, line: float) -> tuple[float, float]:
    """Return width and height of the cell of an output: as large as all fit, but not too small."""
    best = (_LEAST_SIDE_PX * n_planes, _LEAST_ROW_PX)
    for across in range(1, count + 1):
        down = -(-count // across)
        width, height = room.width() / across, room.height() / down
        side = min(width / n_planes, height - line)
        if side > min(best[0] / n_planes, best[1] - line):
            best = (width, height)
    return best


_SINGLE = "A single axis has no principal axis: choose two or three axes above"
_ALONG_ONE = "A single axis has no principal axis, and this limb was measured along one only"
_ABOUT = "Ellipses of one standard deviation; the line is the principal axis"
_OWN_AXES = "x and y are local to each sensor"


class MainAxisView(FigureView):
    """The ellipse of motion of each selected output, and its main axis where it has one."""

    name: ClassVar[str] = "main_axis"
    needs = frozenset({"output_main_axes", "shown_outputs", "axis_numbers", "limb_data"})

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        self.picture = MainAxisPicture()
        super().__init__(self.picture, parent)
        self.about = self.add_above("main_axis_about")
        self.about.say(_ABOUT)
        self.about.setToolTip(f"{_ABOUT}. {_OWN_AXES}.")
        self.choices.addWidget(self.about, 1)
        self.say_instead(self.no_outputs)

    def show_results(self, results: Mapping[str, Any]) -> None:
        if not results["shown_outputs"]:
            self.say_instead(self.no_outputs)
        elif results["output_main_axes"] is None:
            self.say_instead(_SINGLE if results["limb_data"].n_axes > 1 else _ALONG_ONE)
        elif np.isnan(results["output_main_axes"].share).all():
            self.say_instead(SILENT)
        else:
            limb = results["limb_data"]
            self.offer_copy(True)
            self.picture.show_axes(
                MainAxisContent(
                    main_axes=results["output_main_axes"],
                    outputs=results["shown_outputs"],
                    axes="".join(limb.axes[k] for k in results["axis_numbers"]),
                    limb=limb.name,
                )
            )
            # How the sensors of an own limb lie is not known.
            notes = [_OWN_AXES] if limb.map.axes_shown else []
            notes += ["synthetic limb"] if limb.synthetic else []
            self.show_result(" · ".join(notes))

    def table_text(self) -> str:
        content = self.picture.content
        if content is None or self.picture.message:
            return ""
        n_axes = len(content.axes)
        header = ["output", *(f"direction_{axis}" for axis in content.axes)]
        header += [f"deviation_{k}_m_per_s2" for k in range(1, n_axes + 1)]
        header += ["share_of_variance", "main_axis"]
        main = content.main_axes
        columns = zip(
            content.outputs, main.direction, main.deviation, main.share, main.none, strict=True
        )
        lines = (
            (str(output), *direction, *deviation, share, "no" if none else "yes")
            for output, direction, deviation, share, none in columns
        )
        return tab_separated((header, *lines))
