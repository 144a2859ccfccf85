"""Prepares a stimulus for the page."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from skinsource.design.design import Design
from skinsource.export.stimulus_export.preparing import overview_of, prepared
from skinsource_gui.state.latest_wins import LatestWins
from skinsource_gui.stimulus_page.order import Order


class PreparingWorker(LatestWins):
    """Computes how the order that is wanted last would look, for one design.

    Parameters
    ----------
    design
        What is exported.
    """

    #: The `Order` and its `skinsource.export.stimulus_export.preparing.Overview`.
    ready = Signal(object, object)
    #: The `Order`, and how much of its work is done and how much there is.
    progressed = Signal(object, int, int)

    def __init__(self, design: Design, parent: QObject | None = None) -> None:
        super().__init__("skinsource-stimulus", parent)
        self._design = design

    def prepare(self, order: Order) -> None:
        """Look at ``order``, instead of whatever was wanted before."""
        self.want(order, partial(self._prepare, order))

    def _prepare(self, order: Order) -> None:
        def stop() -> bool:
            return self.outdated

        made = prepared(
            self._design,
            Path(f"stimulus{order.format.suffix}"),
            order.format,
            order.rate_hz,
            order.options,
            actuation=order.actuation,
            rig=order.rig,
            equaliser=order.equaliser,
            progress=partial(self._tell_progress, order, 0),
            stop=stop,
        )
        looked_at = overview_of(made, progress=partial(self._tell_progress, order, 1), stop=stop)
        self.tell(self.ready, order, looked_at)

    def _tell_progress(self, order: Order, half: int, done: int, total: int, _text: str) -> None:
        """Tell how far it is: channels are made, and then looked at."""
        self.tell(self.progressed, order, half * total + done, 2 * total)
