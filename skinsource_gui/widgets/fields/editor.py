"""What a cell asks of that which edits its value."""

from collections.abc import Callable
from typing import Any, Protocol

from PySide6.QtWidgets import QLabel, QWidget

from skinsource.specs.fields import Spec


class Editor(Protocol):
    """A widget that edits one value, and what a cell has to know of it.

    Attributes
    ----------
    field
        The widget.
    label
        The label, where the widget holds it itself and takes the whole width; else None.
    edited
        Signal: the new value, number of the gesture or None.
    problem_changed
        Signal: why what is entered is not allowed, or "".
    """

    @property
    def field(self) -> QWidget: ...

    @property
    def label(self) -> QLabel | None: ...

    @property
    def edited(self) -> Any: ...

    @property
    def problem_changed(self) -> Any: ...

    def set_value(self, value: Any) -> None:
        """Show a value, and tell nobody."""

    def set_spec(self, spec: Any) -> None:
        """Change what is allowed."""

    def advice(self) -> str:
        """What one should know about the present value, or ""."""

    def refuse(self, reason: str) -> None:
        """Show where in what is entered the reason lies for which it was refused."""

    def cancel(self) -> None:
        """Forget what is being entered."""


#: Makes the editor for a field.
NewEditor = Callable[[Spec, QWidget], Editor]
