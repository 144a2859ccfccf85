"""The one table of panels: the window makes, places and lists them from it."""

from dataclasses import dataclass

from skinsource.design.panel_settings import TARGET, StageSettings, TargetSettings
from skinsource_gui.panels.analysis.settings import AnalysisSettings
from skinsource_gui.panels.compare.settings import CompareSettings
from skinsource_gui.panels.hand.picture import HandSettings
from skinsource_gui.panels.output.figures import OutputSettings
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.spectra.panel import SpectraSettings
from skinsource_gui.panels.timeline.content import TimelineSettings
from skinsource_gui.panels.traces.panel import TracesSettings
from skinsource_gui.state.panel import LazyPanel, Panel


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelSpec:
    """One panel.

    Attributes
    ----------
    panel
        What makes it: a `LazyPanel`, so that its modules are imported when it is first used, or
        its class.
    settings
        Class of what only it looks at, a frozen dataclass made with `skinsource.specs.fields`; None
        where there is nothing.
    """

    panel: LazyPanel | type[Panel]
    settings: type | None = None


#: In the order in which the keyboard reaches them.
PANELS: tuple[PanelSpec, ...] = (
    PanelSpec(panel=LazyPanel("hand", "Hand"), settings=HandSettings),
    PanelSpec(panel=LazyPanel("timeline", "Timeline"), settings=TimelineSettings),
    PanelSpec(panel=LazyPanel("inspector", "Clip")),
    PanelSpec(
        panel=LazyPanel("stage", "Stage", folder="compare", module="stage"),
        settings=StageSettings,
    ),
    PanelSpec(panel=LazyPanel("skin", "Skin"), settings=SkinSettings),
    PanelSpec(panel=LazyPanel(TARGET, "Target"), settings=TargetSettings),
    PanelSpec(panel=LazyPanel("traces", "Traces"), settings=TracesSettings),
    PanelSpec(panel=LazyPanel("spectra", "Spectra"), settings=SpectraSettings),
    PanelSpec(panel=LazyPanel("clip_editor", "Clip editor")),
    PanelSpec(panel=LazyPanel("compare", "Compare"), settings=CompareSettings),
    PanelSpec(panel=LazyPanel("library", "Library")),
    PanelSpec(panel=LazyPanel("output", "Output"), settings=OutputSettings),
    PanelSpec(panel=LazyPanel("calibration", "Calibration")),
    PanelSpec(panel=LazyPanel("analysis", "Analysis"), settings=AnalysisSettings),
    PanelSpec(
        panel=LazyPanel("analysis_2", "Analysis 2", folder="analysis"), settings=AnalysisSettings
    ),
)
