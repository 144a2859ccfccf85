"""What the tests of design files share: a file of a design, saved."""

from pathlib import Path

import pytest

from skinsource.design.design_file import save_design
from tests.core.design_files.bench import DESIGN, LAYOUT, VIEW


@pytest.fixture
def saved(tmp_path) -> Path:
    path = tmp_path / "design.skinsource"
    save_design(path, DESIGN, VIEW, layout=LAYOUT)
    return path
