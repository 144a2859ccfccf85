"""The rows of a benchmark, as a table that can be sorted."""

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
)
from PySide6.QtGui import QColor, QFont

from skinsource.method_comparison.compared_limb import MADE_UP
from skinsource.method_comparison.every_scene import any_scene
from skinsource.method_comparison.pareto import pareto_front
from skinsource.method_comparison.table import Row
from skinsource.own_limbs import facts_of
from skinsource_gui.theme import current_theme

#: Name of the engine whose promises are this program's own.
OURS = "this program"
_COLUMNS = (
    ("Scene", "What is computed"),
    ("Engine", "Who computes it; bold where nothing is both faster and better"),
    ("Precision", "Of the numbers"),
    ("Setting", "How; cut and rank trade error for time"),
    ("Fastest, ms", "The least disturbed run"),
    ("Median, ms", "Half of the runs took at most this; with the median absolute deviation"),
    ("Worst window", "Largest error in 100 ms, over the peak of that window"),
    ("Of the peak", "Largest error over the peak of the channel"),
    ("Memory, MB", "Held above idle"),
    ("Promise", "Whether the promised errors, times and memory hold"),
)
_FIRST_NUMBER, _LAST_NUMBER = 4, 8
_PROMISE = 9
_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


class BenchTable(QAbstractTableModel):
    """What the benchmark has measured; failed methods are rows too."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._rows: list[Row] = []
        self._front: set[int] = set()

    def show_rows(self, rows: Sequence[Row]) -> None:
        """Take over ``rows``."""
        self.beginResetModel()
        self._rows = list(rows)
        scenes = {row.scene for row in rows}
        self._front = {
            id(row)
            for scene in scenes
            for row in pareto_front([one for one in self._rows if one.scene == scene])
        }
        self.endResetModel()

    def rowCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(self._rows)

    def columnCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(_COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> Any:
        if orientation == Qt.Orientation.Horizontal:
            title, hint = _COLUMNS[section]
            return {_Role.DisplayRole: title, _Role.ToolTipRole: hint}.get(_Role(role))
        return None

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> Any:
        row, column = self._rows[index.row()], index.column()
        if role == _Role.DisplayRole:
            return _cells(row)[column]
        if role == _Role.ToolTipRole:
            return row.failure or row.promise.removeprefix("broken: ")
        if role == _Role.TextAlignmentRole and _FIRST_NUMBER <= column <= _LAST_NUMBER:
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        if role == _Role.FontRole and column == 1 and id(row) in self._front:
            font = QFont()
            font.setBold(True)
            return font
        if role == _Role.ForegroundRole:
            return self._colour(row, column)
        return None

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        self.layoutAboutToBeChanged.emit()
        self._rows.sort(
            key=lambda row: _sort_key(row, column), reverse=order == Qt.SortOrder.DescendingOrder
        )
        self.layoutChanged.emit()

    def _colour(self, row: Row, column: int) -> QColor | None:
        if row.failure:
            return QColor(current_theme().dim)
        if column == _PROMISE and row.promise.startswith("broken"):
            return QColor(current_theme().error)
        return None


def verdict(rows: Sequence[Row]) -> str:
    """One sentence: whether this program keeps its promises."""
    held = [row for row in rows if row.engine == OURS and row.promise != "none" and not row.failure]
    broken = [row for row in held if row.promise != "kept"]
    failed = sum(bool(row.failure) for row in rows)
    last = f" {failed} of {len(rows)} rows could not be measured." if failed else ""
    on = on_limb(rows)
    if broken:
        what = broken[0].promise.removeprefix("broken: ")
        return (
            f"This program breaks its promises in {len(broken)} of {len(held)} rows{on}; the "
            f"first: {broken[0].scene}, {broken[0].setting}: {what}.{last}"
        )
    return f"This program keeps its promises in {len(held)} of {len(held)} rows{on}.{last}"


def on_limb(rows: Sequence[Row]) -> str:
    """Words for the limb that was measured on; none for made-up responses."""
    limb = rows[0].limb if rows else MADE_UP
    return "" if limb == MADE_UP else f" on {facts_of(limb.name).title}"


def _cells(row: Row) -> tuple[str, ...]:
    deviation = "" if row.t_mad_ms is None else f" ± {row.t_mad_ms:.2g}"
    promise = "failed" if row.failure else row.promise.partition(":")[0]
    return (
        f"{row.scene}: {any_scene(row.scene, row.limb).title}",
        row.engine,
        row.precision,
        row.setting,
        _number(row.t_min_ms, ".3g"),
        _number(row.t_median_ms, ".3g") + deviation,
        _number(row.err_window, ".1e"),
        _number(row.err_max, ".1e"),
        _number(row.peak_mb, ".0f"),
        "none made" if promise == "none" else promise,
    )


def _sort_key(row: Row, column: int) -> tuple[bool, Any]:
    numbers = (row.t_min_ms, row.t_median_ms, row.err_window, row.err_max, row.peak_mb)
    if _FIRST_NUMBER <= column <= _LAST_NUMBER:
        value = numbers[column - _FIRST_NUMBER]
        return value is None, 0.0 if value is None else value
    return False, _cells(row)[column]


def _number(value: float | None, form: str) -> str:
    return "" if value is None else format(value, form)
