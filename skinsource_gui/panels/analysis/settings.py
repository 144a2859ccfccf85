"""The views of Analysis, and the settings of the panel and its views, saved with a design.

Titles of views and what they answer stand in ``resources/analysis.toml``.
"""

import tomllib
from dataclasses import dataclass

from skinsource.specs import fields
from skinsource.specs.spec import ChoiceSpec, SwitchSpec
from skinsource_gui.qt.resources import read_text


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewSpec:
    """One view of Analysis.

    Attributes
    ----------
    name
        Name of the view: that of its module, of its settings, and in `AnalysisSettings`.
    title
        Title in the chooser.
    answer
        Sentence on what it answers.
    """

    name: str
    title: str
    answer: str


#: In the order of the chooser.
VIEWS = tuple(
    ViewSpec(name=name, **texts)
    for name, texts in tomllib.loads(read_text("analysis.toml")).items()
)

SHOWN = ChoiceSpec(
    label="View",
    options=tuple((view.name, view.title) for view in VIEWS),
    hint="Analysis to show; only this one is computed",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnalysisSettings(fields.CheckedModel):
    """Which view is ``shown``."""

    shown: str = fields.choice(VIEWS[0].name, SHOWN)


COHERENCE = SwitchSpec(label="Coherence", hint="In place of the magnitude")


@dataclass(frozen=True, slots=True, kw_only=True)
class TransferSettings(fields.CheckedModel):
    """Whether ``coherence`` is drawn in place of the magnitude."""

    coherence: bool = fields.switch(False, COHERENCE)


VELOCITY = SwitchSpec(label="In mm/s", hint="Give strengths as peak probe velocity, not amplitude")
BANDS = SwitchSpec(label="By band", hint="Show bands of 2 Hz at 50, 100, 200 and 400 Hz")
EVERY_OUTPUT = SwitchSpec(
    label="All outputs", hint="Show adjusted R² of the worst output and the median"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class LinearitySettings(fields.CheckedModel):
    """How outputs are compared with the strengths of inputs.

    Attributes
    ----------
    velocity
        Whether strengths are velocities of the probe, where these are known.
    bands
        Whether outputs are those in bands.
    every_output
        Whether adjusted R² is shown for all outputs, not for the selected ones.
    """

    velocity: bool = fields.switch(False, VELOCITY)
    bands: bool = fields.switch(False, BANDS)
    every_output: bool = fields.switch(False, EVERY_OUTPUT)
