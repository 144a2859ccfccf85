"""Pictures of panels, and the metadata that exports carry: stimulus, limbs, validity."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from copy import copy
from dataclasses import dataclass
from functools import partial
from math import inf, isinf
from typing import Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEventLoop, QPoint, QRect, QRectF, QSize, Qt

from skinsource.design.comparing import frequency_of, with_edited
from skinsource.design.describing import stimulus_text
from skinsource.design.design import EDITED, Snapshot, shown_snapshot
from skinsource.design.labels import short_limb_title
from skinsource.perception.validity import Judged, in_full, in_short
from skinsource_gui.pages.files.maps_film import MapsFilm
from skinsource_gui.panels.compare.maps import MapsPanel
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.plots.pictures import (
    ALL_VISIBLE,
    MOVING,
    PANEL_IN_USE,
    Picture,
    caption_of,
    with_caption,
)
from skinsource_gui.plots.signal_view import SignalExports
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.qt.theme import LIGHT, Theme, apply_theme, current_theme
from skinsource_gui.qt.windows import application
from skinsource_gui.shell.appearance import Appearance
from skinsource_gui.shell.docks import Dock, PanelInUse
from skinsource_gui.state.comparison import Judging
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine, on_limb, sources_of_levels, sources_shown, too_large
from skinsource_gui.state.panel import Panel, PanelRegistry
from skinsource_gui.state.services import Services

# Maps between outputs are drawn with this quantity: a panel that needs it draws a map.
_MAP = "surface"
_EDITED = "Working design"


@dataclass(frozen=True, slots=True, kw_only=True)
class _ShownDesign:
    """A design that a panel shows: its name there, and the sources of its evaluation."""

    label: str
    given: Mapping[str, Any]
    present: bool = False


class ExportMetadata:
    """Makes the captions and lines that go with exports of a panel, and hands them to its exports.

    Parameters
    ----------
    catch_up
        Waits until the panels in sight show the present design.
    """

    def __init__(
        self,
        document: Document,
        engine: Engine,
        panels: PanelRegistry,
        catch_up: Callable[[], None],
    ) -> None:
        self._document, self._judging, self._catch_up = document, Judging(engine), catch_up
        panels.each(self._connect)

    def caption(self, *panels: Panel) -> str:
        """Return the caption of a picture of these panels."""
        designs = self._shown_designs(panels)
        design, compared = self._document.design, self._compared(panels)
        named = [(_snapshot_label(snapshot), snapshot.design) for snapshot in compared]
        hz = [f"{beside:g}" for beside in _beside(panels) if isinstance(beside, float)]
        # The stimulus is said once, as the design in the window has it.
        note = f"In the maps of {', '.join(hz)} Hz all tones have that frequency."
        text = caption_of(
            design,
            compared=named,
            limbs=tuple(design.given["limb"] for design in designs),
            notes=(*[note][: len(hz)], *in_short(self._judged(designs, panels))),
        )
        here = shown_snapshot(compared, design)
        if not compared or all(panel.needs_of_snapshots for panel in panels):
            return text
        elsewhere = stimulus_text(design) if here is None else _snapshot_label(here)
        return f"{text} Other panels: {elsewhere}."

    def lines(self, *panels: Panel) -> tuple[str, ...]:
        """Return the lines on validity for a table of their numbers."""
        return in_full(self._judged(self._shown_designs(panels), panels))

    @contextmanager
    def as_stored(self) -> Iterator[None]:
        """Have panels show no matched levels while something is exported."""
        with self._document.as_stored():
            self._catch_up()
            yield

    def _connect(self, panel: Panel) -> None:
        caption, lines = partial(self.caption, panel), partial(self.lines, panel)
        panel.caption, panel.as_stored = caption, self.as_stored
        for exports in panel.findChildren(SignalExports):
            exports.caption, exports.lines, exports.as_stored = caption, lines, self.as_stored
        for button in panel.findChildren(CopyButton):
            button.lines, button.as_stored = lines, self.as_stored

    def _judged(self, designs: Sequence[_ShownDesign], panels: Sequence[Panel]) -> list[Judged]:
        judged = [
            Judged(label=entry.label)
            if too_large(entry.given["limb"])
            else self._judging.judge(entry.label, entry.given, present=entry.present)
            for entry in designs
        ]
        maps = any(_MAP in _drawn(panel) for panel in panels)
        return judged if maps else [judgement.without_maps() for judgement in judged]

    def _compared(self, panels: Sequence[Panel]) -> list[Snapshot]:
        """Return the snapshots, with the edited design, that these panels show side by side."""
        snapshots = with_edited(self._document.view.snapshots, self._document.design)
        drawn = {
            snapshot.number: snapshot
            for panel in panels
            if panel.needs_of_snapshots
            for snapshot in panel.snapshots_drawn(snapshots)
        }
        ordered = sorted(drawn.values(), key=lambda snapshot: snapshot.number)
        return ordered if len(ordered) > 1 else []

    def _shown_designs(self, panels: Sequence[Panel]) -> list[_ShownDesign]:
        """Return the design in the window, where it is shown, and the others of the panels."""
        design, view = self._document.design, self._document.shown_view
        compared = self._compared(panels)
        here = shown_snapshot(compared, design)
        label = short_limb_title(design.limb)
        if any(isinstance(beside, float) for beside in _beside(panels)):
            hz = frequency_of(design) or inf
            label = _EDITED if isinf(hz) else f"{hz:g} Hz"
        if compared:
            label = _EDITED if here is None else _snapshot_label(here)
        designs = list[_ShownDesign]()
        if (
            not compared
            or here is not None
            or not all(panel.needs_of_snapshots for panel in panels)
        ):
            designs.append(
                _ShownDesign(label=label, given=sources_shown(design, view), present=True)
            )
        for limb in _beside(panels):
            limb_sources = None if limb == design.limb else on_limb(design, view, limb)
            if limb_sources is not None and not isinstance(limb_sources, str):
                given = sources_of_levels(*limb_sources, match_gain=view.match_gain(design))
                name = f"{limb:g} Hz" if isinstance(limb, float) else short_limb_title(limb)
                designs.append(_ShownDesign(label=name, given=given))
        for snapshot in compared:
            if here is None or snapshot.number != here.number:
                given = sources_of_levels(snapshot.design, view)
                designs.append(_ShownDesign(label=_snapshot_label(snapshot), given=given))
        return designs


def _beside(panels: Sequence[Panel]) -> list[Any]:
    """Return the limbs and frequencies at which panels show the design too."""
    return list(dict.fromkeys(beside for panel in panels for beside in panel.needs_on_limbs))


def _snapshot_label(snapshot: Snapshot) -> str:
    return _EDITED if snapshot.number == EDITED else f"Snapshot {snapshot.number}"


def _drawn(panel: Panel) -> frozenset[str]:
    """Return all quantities that a panel needs."""
    return panel.needs.union(panel.needs_of_snapshots, *panel.needs_on_limbs.values())


_TITLE_PX, _EDGE_PX = 22, 6


class PanelPictures:
    """Draws pictures of one panel, or of all that are in sight.

    Parameters
    ----------
    frame
        The window in which the panels stand.
    catch_up
        Waits until the panels in sight show the present design.
    docks
        By the name of their panel.
    in_use
        Knows the panel in use.
    """

    def __init__(
        self,
        services: Services,
        appearance: Appearance,
        catch_up: Callable[[], None],
        docks: Mapping[str, Dock],
        in_use: PanelInUse,
    ) -> None:
        self._frame, self._panels = services.window, services.panels
        self._metadata = ExportMetadata(
            services.document, services.engine, services.panels, catch_up
        )
        self._appearance, self._catch_up, self._docks = appearance, catch_up, docks
        self._in_use = in_use

    def picture_of(self, name: str) -> Picture:
        """Return the picture of a panel, `PANEL_IN_USE` or `ALL_VISIBLE`, with its caption.

        ``"panel/view"``: that of one of its views.
        """
        if name == MOVING:
            return Picture(draw=self._draw_all, visible=self._moving_maps())
        name, _, view = name.partition("/")
        panel: Panel | None = None
        if name != ALL_VISIBLE:
            panel = self._in_use.panel if name == PANEL_IN_USE else self._panels[name]
        self._catch_up()
        with nullcontext() if panel is None else panel.showing(view):
            caption = self._metadata.caption(*((panel,) if panel else self._docked_panels()))
        size: tuple[int, int] | None = None
        draw: Callable[..., None] = self._draw_all
        if panel is None:
            size = self._frame.width(), self._frame.height()
        else:
            draw = partial(self._draw_one, panel, view)
            likes = panel.size() if panel.isVisible() else _usual_size(panel)
            size = None if name != PANEL_IN_USE else (2 * likes.width(), 2 * likes.height())
        result = panel.map.stage.visible if isinstance(panel, SkinPanel) else None
        draw = with_caption(draw, caption)
        return Picture(
            draw=draw,
            title="" if panel is None else panel.title,
            caption=caption,
            size_px=size,
            visible=result,
        )

    def _moving_maps(self) -> MapsFilm | None:
        """Return the maps that move side by side in sight, with amplitudes as they are stored."""
        for panel in self._panels:
            if isinstance(panel, MapsPanel) and panel.isVisible() and panel.moves:
                with self._metadata.as_stored():
                    moving, content = copy(panel.moving), panel.maps.content
                    caption = self._metadata.caption(panel)
                if len(content.cells) > 1 and moving.longest_s:
                    return MapsFilm(moving=moving, content=content, caption=caption)
        return None

    def _docked_panels(self) -> list[Panel]:
        """Return the panels in sight that do not float."""
        return [
            panel for panel in self._panels if panel.isVisible() and panel.window() is self._frame
        ]

    def _draw_one(
        self,
        panel: Panel,
        view: str,
        painter: QtGui.QPainter,
        width: int,
        height: int,
        theme: Theme = LIGHT,
    ) -> None:
        """Draw a panel or one of its views, which need not be in sight."""
        if panel.isVisible():
            with panel.showing(view), self._metadata.as_stored(), self._in_colours(theme):
                panel.draw_picture(painter, width, height, theme)
            return
        stage = _shown_off_screen(self._docks[panel.name], width, height)
        with panel.showing(view), self._metadata.as_stored(), stage as make_room:
            self._catch_up()
            # Parts that depend on results take their room now.
            no_input = QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents
            QtWidgets.QApplication.processEvents(no_input)
            make_room()
            QtWidgets.QApplication.processEvents(no_input)
            with self._in_colours(theme):
                panel.draw_picture(painter, width, height, theme)

    def _draw_all(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw all panels in sight, each where it is, with its title."""
        places, bounds = self._places()
        painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(theme.base))
        if bounds.isEmpty():
            return
        scale = min(width / bounds.width(), height / bounds.height())
        with self._metadata.as_stored(), self._in_colours(theme):
            painter.save()
            painter.scale(scale, scale)
            painter.translate(-bounds.topLeft())
            for panel, area in places.items():
                _draw_titled(painter, panel, area, theme)
            painter.restore()

    def _places(self) -> tuple[dict[Panel, QRect], QRect]:
        """Return the area of each panel in sight, and a box around them and their titles."""
        places = {
            panel: QRect(panel.mapTo(self._frame, QPoint()), panel.size())
            for panel in self._docked_panels()
        }
        bounds = QRect()
        for area in places.values():
            bounds = bounds.united(area.adjusted(0, -_TITLE_PX, 0, 0))
        return places, bounds

    @contextmanager
    def _in_colours(self, theme: Theme) -> Iterator[None]:
        """Put the studio in other colours for a while; nothing of that is painted on the screen."""
        before, text_scale = current_theme(), self._appearance.text_scale
        apply_theme(application(), theme, text_scale)
        try:
            yield
        finally:
            apply_theme(application(), before, text_scale)


def _draw_titled(painter: QtGui.QPainter, panel: Panel, area: QRect, theme: Theme) -> None:
    font = QtGui.QFont(QtWidgets.QApplication.font())
    font.setBold(True)
    painter.setFont(font)
    painter.setPen(QtGui.QColor(theme.text))
    head = QRectF(area.left() + _EDGE_PX, area.top() - _TITLE_PX, area.width(), _TITLE_PX)
    painter.drawText(head, Qt.AlignmentFlag.AlignVCenter, panel.title)
    painter.save()
    painter.translate(area.topLeft())
    painter.setClipRect(QRectF(0, 0, area.width(), area.height()))
    painter.setFont(QtWidgets.QApplication.font())
    panel.draw_picture(painter, area.width(), area.height(), theme)
    painter.restore()


def _usual_size(panel: Panel) -> QSize:
    """Return the preferred size of a panel, px."""
    return panel.sizeHint().expandedTo(panel.minimumSizeHint()).expandedTo(panel.minimumSize())


@contextmanager
def _shown_off_screen(dock: Dock, width: int, height: int) -> Iterator[Callable[[], None]]:
    """Show the panel of a dock off the screen, for as long as it is drawn.

    A panel that was never shown has no layout and no results.  Yields a function that makes room
    for what has to be scrolled; call it once the results are there.

    Parameters
    ----------
    dock
        The dock, in which the panel is hidden.
    width, height
        Of the picture: the panel is of this shape, and as large as it likes to be at least.
    """
    size = _usual_size(dock.panel)
    wide = max(size.width(), round(size.height() * width / max(height, 1)))
    high = max(size.height(), round(wide * height / max(width, 1)))
    stage = QtWidgets.QWidget()
    stage.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
    stage.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
    column = in_column(of=stage, margins=0)
    with dock.lent() as panel:
        column.addWidget(panel)
        panel.show()
        stage.resize(wide, high)
        stage.show()
        try:
            yield partial(_make_room, stage)
        finally:
            column.removeWidget(panel)
            panel.setParent(None)
            stage.deleteLater()


def _make_room(stage: QtWidgets.QWidget) -> None:
    hidden = max(
        (area.verticalScrollBar().maximum() for area in stage.findChildren(QtWidgets.QScrollArea)),
        default=0,
    )
    high = stage.height() + hidden
    # The shape stays the same.
    stage.resize(round(stage.width() * high / max(stage.height(), 1)), high)
