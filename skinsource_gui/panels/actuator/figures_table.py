"""Rows of figures with their limits."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from skinsource_gui.panels.actuator.figures import Figure
from skinsource_gui.theme import UNIT_PX, set_tone, tabular


class FiguresTable(QWidget):
    """Label, value, and the limit where there is one; what passes its limit is red."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("actuator_figures")
        self.setAccessibleName("Predicted figures")
        self._figures: tuple[Figure, ...] = ()
        self._rows: list[tuple[QLabel, QLabel, QLabel]] = []
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(UNIT_PX)
        self._grid.setVerticalSpacing(0)
        self._grid.setColumnStretch(3, 1)

    @property
    def figures(self) -> tuple[Figure, ...]:
        """What it shows."""
        return self._figures

    def show_figures(self, figures: tuple[Figure, ...]) -> None:
        """Show these rows."""
        self._figures = figures
        while len(self._rows) < len(figures):
            self._add_row()
        for row, labels in enumerate(self._rows):
            for label in labels:
                label.setVisible(row < len(figures))
        for labels, figure in zip(self._rows, figures, strict=False):
            name, value, limit = labels
            name.setText(figure.label)
            value.setText(figure.value)
            limit.setText(f"of {figure.limit}" if figure.limit else "")
            set_tone(value, "error" if figure.passed else "")
            set_tone(limit, "error" if figure.passed else "dim")
        self.setAccessibleDescription(
            "; ".join(
                f"{one.label} {one.value}" + (", beyond its limit" if one.passed else "")
                for one in figures
            )
        )

    def _add_row(self) -> None:
        labels = (QLabel(self), QLabel(self), QLabel(self))
        set_tone(labels[0], "dim")
        labels[1].setFont(tabular(labels[1].font()))
        labels[1].setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        for column, label in enumerate(labels):
            self._grid.addWidget(label, len(self._rows), column)
        self._rows.append(labels)
