"""Rows of figures with their limits."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from skinsource_gui.panels.actuator.figures import Figure
from skinsource_gui.theme import LIGHT, UNIT_PX, Theme, tabular


class FiguresTable(QWidget):
    """Label, value, and the limit where there is one; what passes its limit is red."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("actuator_figures")
        self.setAccessibleName("Predicted figures")
        self._theme = LIGHT
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
        self.setAccessibleDescription(
            "; ".join(
                f"{one.label} {one.value}" + (", beyond its limit" if one.passed else "")
                for one in figures
            )
        )
        self._colour()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self._colour()

    def _add_row(self) -> None:
        labels = (QLabel(self), QLabel(self), QLabel(self))
        labels[1].setFont(tabular(labels[1].font()))
        labels[1].setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        for column, label in enumerate(labels):
            self._grid.addWidget(label, len(self._rows), column)
        self._rows.append(labels)

    def _colour(self) -> None:
        for labels, figure in zip(self._rows, self._figures, strict=False):
            name, value, limit = labels
            words = self._theme.error if figure.passed else self._theme.text
            name.setStyleSheet(f"color: {self._theme.dim};")
            value.setStyleSheet(f"color: {words};")
            limit.setStyleSheet(f"color: {words if figure.passed else self._theme.dim};")
