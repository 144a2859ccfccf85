"""The skin panel: the map of levels or of motion, its toolbar, its choices and its results."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, QSizeF, Qt

from skinsource.base.arrays import Floats
from skinsource.design import edits
from skinsource.design.comparing import match_text
from skinsource.design.design import Design
from skinsource.design.edits.edit import Refusal
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.engine.time_rules import block_of
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.perception.sensation import LIMITS, LIMITS_IN_SHORT
from skinsource_gui.panels.skin import picture
from skinsource_gui.panels.skin.layout import HAND
from skinsource_gui.panels.skin.map import NoteLine, ReadoutLines, SkinMap, selection_readout
from skinsource_gui.panels.skin.painting import InputMark, MapContent, marks_of
from skinsource_gui.panels.skin.picture import heading_of, paint_picture
from skinsource_gui.panels.skin.scale import ColourBar
from skinsource_gui.panels.skin.settings import (
    LEVELS,
    SENSATION,
    SKIN,
    STILL,
    MapQuantity,
    SkinSettings,
    Z,
)
from skinsource_gui.panels.skin.time import NEEDS, Frames, QuantityRow, ScrubBar, SignedBar
from skinsource_gui.plots.pictures import with_caption
from skinsource_gui.plots.small_map import COLOURS, field_image
from skinsource_gui.qt.buttons import passing_menu, tool_button
from skinsource_gui.qt.keys import key_text
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme, current_theme, drawn_icon
from skinsource_gui.qt.wheel import WHOLE
from skinsource_gui.state.compared import SILENT
from skinsource_gui.state.panel import Panel

#: Refusal where Delete is pressed after outputs were selected.
NO_OUTPUTS = Refusal(
    sentence="Outputs cannot be removed; click an input, a dashed ring on the map, to remove it."
)


def sensors_icon() -> QtGui.QIcon:
    """Return an icon with a few dots."""
    dots = QtGui.QPainterPath()
    for x, y in (
        (3.5, 4),
        (8, 2.8),
        (12.5, 4.5),
        (5, 8.5),
        (10.5, 8.8),
        (4.2, 13),
        (8.2, 12.4),
        (12.4, 13),
    ):
        dots.addEllipse(QPointF(x, y), 1.5, 1.5)
    return drawn_icon(dots, current_theme(), filled=True, greyed=False)


def fit_icon() -> QtGui.QIcon:
    """Return an icon with an arm between the corners of a frame."""
    path = QtGui.QPainterPath()
    for x, y, dx, dy in ((2, 2, 1, 1), (14, 2, -1, 1), (2, 14, 1, -1), (14, 14, -1, -1)):
        path.moveTo(x + 3 * dx, y)
        path.lineTo(x, y)
        path.lineTo(x, y + 3 * dy)
    path.addRoundedRect(QRectF(6, 4.5, 4, 7), 1.8, 1.8)
    return drawn_icon(path, current_theme(), greyed=False)


def hand_icon() -> QtGui.QIcon:
    """Return an icon with an open hand, thumb to the left."""
    path = QtGui.QPainterPath(QPointF(5, 14.5))
    for x, y in ((2.2, 9.4), (3.4, 8.4), (5.3, 9.8)):
        path.lineTo(x, y)
    for left, top in ((5.3, 3.4), (7.4, 2.2), (9.5, 2.8), (11.6, 4.6)):
        path.lineTo(left, top + 0.6)
        path.quadTo(left + 0.9, top - 1.0, left + 1.8, top + 0.6)
        path.lineTo(left + 1.8, 8.2)
        path.lineTo(left + 2.1, 8.2)
    path.lineTo(13.4, 10.5)
    path.quadTo(13.4, 13, 11.6, 14.5)
    path.closeSubpath()
    return drawn_icon(path, current_theme(), greyed=False)


# With this width all buttons fit into the narrowest panel.
_ICON_BUTTON_PX = 33


class MapToolbar(QtWidgets.QWidget):
    """Buttons for the style of the map, its sensors, and its visible part."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.interpolated = self._button(
            "map_interpolated", "Interpolated", "Colours over the skin"
        )
        self.sensors_only = self._button(
            "map_sensors_only", "Sensors only", "Colours at the outputs alone"
        )
        self.sensors = self._button("map_sensors_shown", "", "Mark the outputs on the map")
        whole, hand = (key_text("skin", name) for name in ("whole", "hand"))
        fit = f"Fit hand and arm ({whole}, or double-click)"
        self.all = self._button("map_fit_all", "", fit, False)
        self.hand = self._button("map_fit_hand", "", f"Fit the hand ({hand})", False)
        self.sensors.setAccessibleName("Sensors")
        self.all.setAccessibleName("Fit")
        self.hand.setAccessibleName("Hand")
        for button in (self.sensors, self.all, self.hand):
            button.setFixedWidth(_ICON_BUTTON_PX)
        self._show_icons()
        styles = QtWidgets.QButtonGroup(self)
        styles.addButton(self.interpolated)
        styles.addButton(self.sensors_only)
        self._row = row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(1)
        row.addWidget(self.interpolated)
        row.addWidget(self.sensors_only)
        row.addSpacing(UNIT_PX // 4)
        row.addWidget(self.sensors)
        row.addStretch(1)
        row.addWidget(self.all)
        row.addWidget(self.hand)

    def show_settings(self, settings: SkinSettings) -> None:
        """Show the present choice."""
        interpolated = settings.map_style == "interpolated"
        self.interpolated.setChecked(interpolated)
        self.sensors_only.setChecked(not interpolated)
        self.sensors.setEnabled(interpolated)
        self.sensors.setChecked(settings.sensors_shown or not interpolated)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._show_icons()

    def _show_icons(self) -> None:
        self.sensors.setIcon(sensors_icon())
        self.all.setIcon(fit_icon())
        self.hand.setIcon(hand_icon())

    def minimumSizeHint(self) -> QSize:
        # Without the buttons for fits, which are hidden where there is no room.
        buttons = (self.interpolated, self.sensors_only, self.sensors)
        width = sum(part.minimumSizeHint().width() for part in buttons) + UNIT_PX
        return QSize(width, super().minimumSizeHint().height())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        # Where there is no room for all, the fits remain in the menu and on keys.
        row, buttons = self._row, (self.interpolated, self.sensors_only, self.sensors)
        fits = (self.all, self.hand)
        needed = sum(part.sizeHint().width() for part in buttons) + len(fits) * _ICON_BUTTON_PX
        roomy = self.width() >= needed + row.spacing() * (row.count() + 1)
        for part in fits:
            part.setVisible(roomy)

    def _button(
        self, name: str, text: str, hint: str, checkable: bool = True
    ) -> QtWidgets.QToolButton:
        button = tool_button(self, name, text, hint, checkable=checkable)
        button.setIconSize(QSize(16, 16))
        return button


def marks_of_levels(levels: Floats, outputs: tuple[int, ...]) -> tuple[tuple[float, int], ...]:
    """Return the levels of the selected outputs, each with its rank, for the colour bar."""
    return tuple(
        (float(levels[number - 1]), rank)
        for rank, number in enumerate(outputs)
        if number <= levels.size
    )


#: Usual width and height of a picture, px.
PICTURE_PX = (1200, 1800)
# Height in lines of text below which readout and note have one line each.
_FEW_LINES = 14


class SkinPanel(Panel):
    """A map of the back of hand and arm: RMS levels or motion; outputs are selected on it.

    Attributes
    ----------
    settings
        Those of the panel.
    content
        What is shown, also while it is covered.
    frames
        Makes the content at an instant, where the map moves.
    toolbar, quantity_row, map, colour_bar, signed_bar, scrub, note, readout
        What is seen, from top to bottom.
    """

    title: ClassVar[str] = "Skin"
    name: ClassVar[str] = SKIN

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view, self.settings = View(), SkinSettings()
        # The parts of design and view that were shown last.
        self._visible: tuple[object, ...] = ()
        self._marks: tuple[InputMark, ...] = ()
        self.content, self.frames = MapContent(), Frames()
        # The part of the response for which signals were requested last.
        self._requested_block = -1
        self._covered = False
        self._surface: SurfaceOperator | None = None
        self._matched = ""
        # The Tab key goes through them in this order.
        self.toolbar, self.quantity_row = MapToolbar(self), QuantityRow(self)
        self.scrub, self.signed_bar = ScrubBar(self), SignedBar(self)
        self.map, self.colour_bar = SkinMap(self), ColourBar(self)
        self.note, self.readout = NoteLine(self), ReadoutLines(self)
        self.map.setObjectName("skin_map")
        self.colour_bar.setObjectName("skin_colour_bar")
        self.note.setObjectName("skin_note")
        self.readout.setObjectName("skin_readout")
        self.readout.setAccessibleName("Under the pointer")
        tab_order = (
            self.colour_bar.auto_button,
            self.signed_bar.limit,
            self.signed_bar.auto_button,
            self.scrub.play,
            self.scrub.slider,
        )
        for before, after in pairwise(tab_order):
            self.setTabOrder(before, after)
        self._lay_out()
        self._connect()
        self._show_settings()
        self._show_choice()

    @property
    def needs(self) -> frozenset[str]:
        shown, always = self.settings.quantity, frozenset({"limb_map", "limb_data", "match_gain"})
        needed = always | ({NEEDS[shown]} if self.moves else picture.needs_of(shown))
        if self.settings.map_style == "sensors":
            return needed
        return needed | {"surface"} | (set() if self.moves else {picture.surface_name(shown)})

    @property
    def moves(self) -> bool:
        """Whether the map changes with the playhead."""
        return self.settings.quantity not in STILL

    @property
    def chosen_range(self) -> tuple[float, float] | None:
        """The chosen range of the colours; None: they follow what is shown."""
        if self.moves:
            return self.settings.moving_range_db
        is_sensation = self.settings.quantity == SENSATION
        return self.settings.sensation_range_db if is_sensation else self.settings.map_range_db

    def sizeHint(self) -> QSize:
        return QSize(420, 640)

    def show_state(self, design: Design, view: View) -> None:
        before = self.settings.quantity
        self._design, self._view = design, view
        self.settings = settings_of(view, self.name, SkinSettings)
        marks = marks_of(design, view)
        visible = (view, facts_of(design.limb), marks)
        if visible == self._visible and not self.moves:
            return  # another waveform changes the map only when that is computed
        self._visible, self._marks = visible, marks
        self._show_settings()
        if self.settings.quantity == before:
            self._follow()
        else:
            # The results are those of another quantity.
            self._forget()
        self._show_choice()

    def show_playhead(self, view: View) -> None:
        self._view = view
        if self.moves and self.isVisible():
            self._follow()
            self._show_choice()

    def show_results(self, results: Mapping[str, Any]) -> None:
        surface = results.get("surface") if "surface" in self.needs else None
        self._matched = match_text(results["match_gain"])
        field = self.content.field
        if surface is not None and surface is not self._surface:
            self._surface, field = surface, field_image(surface, results["limb_data"])
        limb = "" if self._design is None else self._design.limb
        self.content = picture.content_of(
            self.content, results, self.settings, limb=limb, surface=surface, field=field
        )
        if self.moves:
            self.frames.update(results, self.settings.quantity, self._view)
            self._requested_block = -1
            self.colour_bar.follow(self.frames.largest_db)
            message = "" if self.frames.largest > 0.0 else SILENT
            self.content = replace(self.content, message=message)
            self._show_time()
        else:
            self.frames.forget()
        self._follow()
        self._show_choice()

    def show_problem(self, reason: str) -> None:
        self._forget(reason)
        self._show_bare()
        self.content = replace(self.content, note="", drawn_note="")
        self._show_choice()

    def show_staleness(self, stale: bool) -> None:
        self.content = replace(self.content, outdated=stale)
        self._show_map()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        # With large letters the map needs the room more than a second line does.
        few = self.height() < _FEW_LINES * self.fontMetrics().lineSpacing()
        for part in (self.readout, self.note):
            part.show_lines(1 if few else 2)

    def show_pointed_input(self, input_id: int | None) -> None:
        self.content = replace(self.content, pointed_at=input_id)
        self._show_map()

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Hatch outputs that are mostly noise."""
        self.content = replace(self.content, noisy=outputs)
        self._show_map()

    def show_covered(self, covered: bool) -> None:
        """Hide what was computed; limb and inputs stay, so that they can be pointed at."""
        self._covered = covered
        self._show()

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw the map for a page or a slide, with all that is needed to read it; size in px."""
        content = replace(self.content, outdated=False)
        heading = heading_of(self._design, self._view, content.quantity)
        heading = replace(heading, note=content.drawn_note)
        family, visible = self.font().family(), self.map.stage.visible
        paint_picture(painter, QSizeF(width, height), content, heading, theme, family, visible)

    def picture(self, width: int, height: int, theme: Theme = LIGHT) -> QtGui.QImage:
        """Return `draw_picture` as pixels, with the caption that the window gives."""
        image = QtGui.QImage(width, height, QtGui.QImage.Format.Format_RGB32)
        with self.as_stored():
            painter = QtGui.QPainter(image)
            draw = with_caption(self.draw_picture, self.caption())
            draw(painter, width, height, theme)
            painter.end()
        return image

    def _show_settings(self) -> None:
        """Show the settings, and of the two colour bars the one that they need."""
        signed = self.settings.quantity == Z
        self.toolbar.show_settings(self.settings)
        self.quantity_row.show_settings(self.settings, self._view.slow_motion)
        self.scrub.setVisible(self.moves)
        self._show_time()
        self.signed_bar.setVisible(signed)
        self.colour_bar.setVisible(not signed)
        self.colour_bar.choose(self.chosen_range)

    def _show_time(self) -> None:
        """Show the playhead, and the limits of what moves."""
        if self.moves:
            settings, limits = self.settings, self.frames.value_range(self.settings)
            automatic = settings.z_limits is None
            self.signed_bar.show_limits(limits, automatic=automatic, matched=self._matched)
            self.scrub.show_time(self._view.playhead_s, self.frames.end_s(self._view))

    def _follow(self) -> None:
        """Show the skin at the playhead, or let the range of colours follow the levels."""
        if self.moves:
            self._show_frame()
        elif self.content.values is not None:
            self.colour_bar.follow(self.content.values)
        if self.settings.map_style == "sensors":
            # When the map is interpolated again, this field would belong to an older design.
            self.content = replace(self.content, field_values=None)

    def _show_frame(self) -> None:
        """Take over the skin at the playhead; where it is not known yet the map is stale."""
        self.scrub.show_time(self._view.playhead_s, self.frames.end_s(self._view))
        block = block_of(self._view.playhead_s)
        if self.frames.runs_out(self._view) and block != self._requested_block:
            self._requested_block = block
            self.visibility_changed.emit()
        if self.frames.has(self._view):
            surface = self._surface if self.settings.map_style == "interpolated" else None
            self.content = self.frames.content(
                self.content, self._view, self.settings, surface, self._matched
            )
        elif self.frames.known:
            self._staleness.set_stale(True)

    def _show_choice(self) -> None:
        """Show what is known as design, view and settings ask for."""
        design, view, settings = self._design, self._view, self.settings
        limbs = (self.content.limb, "" if design is None else design.limb)
        self.content = replace(
            self.content,
            outputs=view.outputs,
            inputs=self._marks,
            sensors_shown=settings.sensors_shown,
            synthetic=any(facts_of(limb).synthetic for limb in limbs),
        )
        if not self.moves:
            self.content = replace(
                self.content,
                quantity=MapQuantity(name=settings.quantity, span=view.span, matched=self._matched),
                value_range=self.colour_bar.range_db,
                fixed=self.chosen_range is not None,
                colours=settings.colours,
            )
        self._show()

    def _forget(self, message: str = "") -> None:
        """Drop all results; ``message`` says why."""
        self.frames.forget()
        self.content = replace(self.content, values=None, field_values=None, message=message)

    def _show_bare(self) -> None:
        """Show the places of an own limb for which nothing is computed.

        A limb that is missing has no places to show.
        """
        limb = "" if self._design is None else self._design.limb
        own, missing = own_map(limb), facts_of(limb).missing
        if not missing and (own is None or limb == self.content.limb):
            return
        self._surface = None
        self.content = replace(
            self.content,
            limb_map=own,
            limb=limb,
            px_per_mm=own.hand_length_px / facts_of(limb).hand_length_mm if own else 0.0,
            field=None,
            noisy=(),
        )

    def _show(self) -> None:
        """Show the content on the map, in colour bar, note and readout."""
        content = self.content
        self.colour_bar.strip.show_quantity(content.quantity, content.colours)
        levels = None if self._covered else content.coloured_values
        marks = () if levels is None else marks_of_levels(levels, content.outputs)
        self.colour_bar.strip.show_marks(marks)
        self._show_map()
        self.note.show_text(content.note, content.note.replace(LIMITS, LIMITS_IN_SHORT))
        self._show_readout(self.map.readout())

    def _show_map(self) -> None:
        self.map.show_content(self.content.covered if self._covered else self.content)

    def _show_readout(self, text: str) -> None:
        self.readout.show_text(text or selection_readout(self.content.outputs))

    def _lay_out(self) -> None:
        grid = QtWidgets.QGridLayout(self)
        grid.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        grid.setSpacing(UNIT_PX // 2)
        grid.addWidget(self.toolbar, 0, 0, 1, 2)
        grid.addWidget(self.quantity_row, 1, 0, 1, 2)
        grid.addWidget(self.map, 2, 0)
        grid.addWidget(self.colour_bar, 2, 1)
        grid.addWidget(self.signed_bar, 2, 1)
        grid.addWidget(self.scrub, 3, 0, 1, 2)
        grid.addWidget(self.note, 4, 0, 1, 2)
        grid.addWidget(self.readout, 5, 0, 1, 2)
        grid.setRowStretch(2, 1)
        grid.setColumnStretch(0, 1)
        self.setFocusProxy(self.map)

    def _connect(self) -> None:
        toolbar, row, pan_zoom = self.toolbar, self.quantity_row, self.map.stage.pan_zoom
        toolbar.interpolated.clicked.connect(lambda: self._change(map_style="interpolated"))
        toolbar.sensors_only.clicked.connect(lambda: self._change(map_style="sensors"))
        toolbar.sensors.clicked.connect(lambda shown: self._change(sensors_shown=shown))
        toolbar.all.clicked.connect(lambda: pan_zoom.show(WHOLE))
        toolbar.hand.clicked.connect(lambda: pan_zoom.show(HAND))
        self.colour_bar.range_chosen.connect(self._choose_range)
        self.colour_bar.strip.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.colour_bar.strip.customContextMenuRequested.connect(self._open_colours)
        self.map.readout_changed.connect(self._show_readout)
        self.map.input_pointed_at.connect(self.input_pointed_at)
        self.map.inputs_chosen.connect(self._choose_inputs)
        self.map.removal_requested.connect(self._remove_inputs)
        self.map.outputs_chosen.connect(self._choose_outputs)
        self.map.menu_requested.connect(self._open_menu)
        self.signed_bar.limits_chosen.connect(lambda limits: self._change(z_limits=limits))
        row.rms_window.edited.connect(lambda window_s, _: self._change(rms_window_s=window_s))
        row.quantity.edited.connect(lambda name, _: self._change(quantity=name))
        row.pace.edited.connect(lambda pace, _: self._choose_pace(float(pace)))
        # Otherwise Space, which plays, would open the list again.
        for choice in (row.quantity, row.pace):
            choice.edited.connect(lambda *_: self.setFocus(Qt.FocusReason.OtherFocusReason))
        self.scrub.time_requested.connect(self.playhead_requested)
        self.scrub.play.clicked.connect(lambda: self.action_requested.emit("play"))

    def _change(self, _checked: bool = False, **changes: Any) -> None:
        settings = replace(self.settings, **changes)
        self.view_changed.emit(with_settings(self._view, self.name, settings))

    def _choose_range(self, range_db: tuple[float, float] | None) -> None:
        """Let colours span these levels, or follow the loudest output."""
        own = {LEVELS: "map_range_db", SENSATION: "sensation_range_db"}
        changes: dict[str, Any] = {own.get(self.settings.quantity, "moving_range_db"): range_db}
        self._change(**changes)

    def _choose_outputs(self, outputs: tuple[int, ...]) -> None:
        if self._design is not None:
            self.edited.emit(edits.select_outputs(self._design, self._view, outputs), None)

    def _choose_inputs(self, ids: tuple[int, ...]) -> None:
        if self._design is not None:
            self.edited.emit(edits.select_inputs(self._design, self._view, ids), None)

    def _remove_inputs(self, outputs_selected: bool) -> None:
        """Remove those that are selected; where none is, or outputs are meant, say so."""
        if self._design is not None:
            removed = edits.remove_inputs(self._design, self._view, self._view.selected_inputs)
            self.edited.emit(NO_OUTPUTS if outputs_selected else removed, None)

    def _choose_pace(self, slow_motion: float) -> None:
        """Play this many times slower than real time."""
        if self._design is not None:
            self.edited.emit(edits.play_slower(self._design, self._view, slow_motion), None)

    def _open_menu(self, at: QPoint) -> None:
        """Open the menu of the map at a point of the screen: fits, colours, picture and data."""
        menu, show = passing_menu(self.map, "skin_menu"), self.map.stage.pan_zoom.show
        for title, fit, key in (("Fit hand", HAND, "hand"), ("Fit hand and arm", WHOLE, "whole")):
            menu.addAction(f"{title}\t{key_text('skin', key)}", partial(show, fit))
        menu.addSeparator()
        self._offer_colours(menu.addMenu("Colours"))
        menu.addSeparator()
        # A file waits for new results; the clipboard gets what is drawn now.
        copy = menu.addAction("Copy picture", self._copy_picture)
        copy.setEnabled(not self.content.outdated)
        menu.addAction("Save picture as…", partial(self.action_requested.emit, "export_picture"))
        menu.addAction("Export data…", partial(self.action_requested.emit, "export_levels"))
        menu.popup(at)

    def _open_colours(self, at: QPoint) -> None:
        strip = self.colour_bar.strip
        menu = passing_menu(strip, "colours_menu")
        self._offer_colours(menu)
        menu.popup(strip.mapToGlobal(at))

    def _offer_colours(self, menu: QtWidgets.QMenu) -> None:
        group = QtGui.QActionGroup(menu)
        for name, title in COLOURS.options:
            action = menu.addAction(title, partial(self._change, colours=name))
            action.setCheckable(True)
            action.setChecked(name == self.settings.colours)
            group.addAction(action)

    def _copy_picture(self) -> None:
        QtGui.QGuiApplication.clipboard().setImage(self.picture(*PICTURE_PX))
