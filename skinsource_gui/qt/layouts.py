"""Rows and columns of widgets."""

from typing import TypeVar

from PySide6 import QtWidgets

#: A widget or a layout, with its share of the spare room if it gets some; None: empty room.
Part = (
    QtWidgets.QWidget | QtWidgets.QLayout | tuple[QtWidgets.QWidget | QtWidgets.QLayout, int] | None
)
#: Left, top, right and bottom, px, or the same at all sides.
Margins = int | tuple[int, int, int, int]
Box = TypeVar("Box", bound=QtWidgets.QBoxLayout)


def in_column(
    *parts: Part,
    of: QtWidgets.QWidget | None = None,
    margins: Margins | None = None,
    gap_px: int | None = None,
) -> QtWidgets.QVBoxLayout:
    """Lay out parts below each other.

    Parameters
    ----------
    parts
        From the top down.
    of
        The widget that gets them; None: the column is a part of another layout.
    margins, gap_px
        Around the parts and between them; None: those of the style.
    """
    return _filled(
        QtWidgets.QVBoxLayout() if of is None else QtWidgets.QVBoxLayout(of), parts, margins, gap_px
    )


def in_row(
    *parts: Part,
    of: QtWidgets.QWidget | None = None,
    margins: Margins | None = None,
    gap_px: int | None = None,
) -> QtWidgets.QHBoxLayout:
    """Lay out parts from left to right, see `in_column`."""
    return _filled(
        QtWidgets.QHBoxLayout() if of is None else QtWidgets.QHBoxLayout(of), parts, margins, gap_px
    )


def form_of(widget: QtWidgets.QWidget) -> QtWidgets.QFormLayout:
    """Return an empty form that fills a widget: labels, and fields as wide as there is room."""
    form = QtWidgets.QFormLayout(widget)
    form.setContentsMargins(0, 0, 0, 0)
    form.setFieldGrowthPolicy(form.FieldGrowthPolicy.AllNonFixedFieldsGrow)
    return form


def _filled(
    layout: Box, parts: tuple[Part, ...], margins: Margins | None, gap_px: int | None
) -> Box:
    if margins is not None:
        layout.setContentsMargins(*(4 * (margins,) if isinstance(margins, int) else margins))
    if gap_px is not None:
        layout.setSpacing(gap_px)
    for part in parts:
        item, share = part if isinstance(part, tuple) else (part, 0)
        if item is None:
            layout.addStretch(1)
        elif isinstance(item, QtWidgets.QLayout):
            layout.addLayout(item, share)
        else:
            layout.addWidget(item, share)
    return layout
