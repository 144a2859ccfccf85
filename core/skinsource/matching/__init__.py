"""Equal strength is measured, not predicted: one vibration is made as strong as another one.

A person feels a reference and a test in turn, makes the test stronger or weaker until both are as
strong, and stores that.  What many such matches say goes into sweeps, see `Strengths`.
"""

from skinsource.matching.match import Match
from skinsource.matching.match_file import add_match, read_matches
from skinsource.matching.presenter import Presenter
from skinsource.matching.procedure import Procedure, Trial
from skinsource.matching.run import MatchingRun
from skinsource.matching.strengths import Strengths

__all__ = [
    "Match",
    "MatchingRun",
    "Presenter",
    "Procedure",
    "Strengths",
    "Trial",
    "add_match",
    "read_matches",
]
