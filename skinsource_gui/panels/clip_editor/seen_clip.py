"""Which part of a clip the editor shows."""

from collections.abc import Callable

from PySide6.QtCore import QObject, QRectF, Signal
from PySide6.QtGui import QWheelEvent

from skinsource.base.arrays import Floats
from skinsource.design.clips import Clip
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.panels.clip_editor.content import EditorContent, reach_of
from skinsource_gui.widgets.time.time_scale import Range, TimeScale, panned, within, zoomed
from skinsource_gui.widgets.time.time_wheel import range_by_wheel

# Behind the end there is room to draw on.
_BEHIND = 0.06
_LEAST_S = 0.01


class SeenClip(QObject):
    """A clip, and how much of its time and of its values is seen.

    Parameters
    ----------
    content
        Gives what the editor shows at present.
    """

    #: Another part is to be seen.
    changed = Signal()

    def __init__(self, content: Callable[[], EditorContent | None], parent: QObject) -> None:
        super().__init__(parent)
        self._content = content
        self._clip: Clip | None = None
        self._drawn: Floats | None = None
        self._played: Floats | None = None
        self._rate_hz = facts_of("").sample_rate_hz
        self._shown_s: Range | None = None
        self._held: tuple[Range, float] | None = None

    def show(
        self, clip: Clip | None, drawn: Floats | None, played: Floats | None, rate_hz: float
    ) -> None:
        """Take over a clip, all of which is seen if it is another one."""
        if clip is None or self._clip is None or clip.id != self._clip.id:
            self._shown_s = None
        self._clip, self._drawn, self._played, self._rate_hz = clip, drawn, played, rate_hz

    @property
    def held(self) -> bool:
        """Whether it stays."""
        return self._held is not None

    def hold(self, content: EditorContent) -> None:
        """Something is drawn: what is seen stays, however long or loud the clip becomes."""
        self._held = (content.scale.shown_s, content.reach)

    def let_go(self) -> None:
        """What was drawn is done."""
        self._held = None

    def pan(self, by_s: float) -> None:
        """See what lies so much later; what is held, too, goes along with what drags it."""
        content = self._content()
        if content is None:
            return
        shown_s = panned(content.scale.shown_s, by_s, self._whole_s)
        if self._held is not None:
            self._held = (shown_s or self._whole_s, content.reach)
        self._see(shown_s)

    def zoom(self, factor: float) -> None:
        """See so many times less, around the middle."""
        content = self._content()
        if content is not None:
            shown = content.scale.shown_s
            self._see(zoomed(shown, sum(shown) / 2, factor, self._whole_s))

    def turn(self, event: QWheelEvent) -> None:
        """Follow the wheel."""
        content = self._content()
        if content is not None:
            self._see(range_by_wheel(event, content.scale, self._whole_s))

    def show_everything(self) -> None:
        """See all of the clip."""
        self._see(None)

    def content_in(self, area: QRectF) -> EditorContent | None:
        """What the editor shows, with the curve in that area; None: there is no clip."""
        if self._clip is None:
            return None
        shown_s = self._whole_s
        if self._shown_s is not None:
            shown_s = within(self._shown_s, shown_s) or shown_s
        if self._held is not None:
            shown_s, reach = self._held
        else:
            reach = reach_of(self._drawn, self._played)
        width = max(area.width(), 1.0)
        return EditorContent(
            clip=self._clip,
            drawn=self._drawn,
            played=self._played,
            sample_rate_hz=self._rate_hz,
            scale=TimeScale(shown_s=shown_s, left_px=area.left(), width_px=width),
            area=area,
            reach=reach,
        )

    @property
    def _whole_s(self) -> Range:
        counts = [one.size for one in (self._drawn, self._played) if one is not None]
        length = max(max(counts, default=0) / self._rate_hz, _LEAST_S)
        return (0.0, length * (1 + _BEHIND))

    def _see(self, shown_s: Range | None) -> None:
        self._shown_s = shown_s
        self.changed.emit()
