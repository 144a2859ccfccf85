"""What the pages on experiments say is true."""

import re
import runpy
import shlex
import sys
from pathlib import Path

import numpy as np

from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use
from tests.core.rig_measuring.bench_top import Duplex

PAGE = Path(__file__).resolve().parents[3] / "docs" / "playing.md"


class Card(SyntheticSoundLibrary):
    """Output 1 of it is wired to input 1."""

    paths, output, noise, offset = (np.eye(1, 8192)[0],), 1, 0.0, 0.0
    pulled_after, loses_at = 100_000, -1

    @property
    def rows(self):
        return tuple((name, 0, n, 2, 48_000.0) for name, n in self.outputs.items())

    def Stream(self, **asked):  # as sounddevice calls it
        return self.open(Duplex(self, asked))


def test_its_scripts_run(monkeypatch, capsys):
    modules = "playing.devices", "playing.stream", "rig_measuring.duplex"
    use(monkeypatch, Card(Two=2), modules)
    scope: dict = {}
    for script in re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL):
        exec(compile(script, PAGE.name, "exec"), scope)  # noqa: S102  our own page
    scope["player"].close()
    assert "estimated" in capsys.readouterr().out
    assert scope["player"].loopback_s == scope["found"].behind_s


def test_the_lines_that_play_its_folder_run(monkeypatch, tmp_path, capsys):
    page = PAGE.with_name("psychopy.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    card = Card(UMC404=4)
    use(monkeypatch, card, ("playing.devices", "playing.stream", "rig_measuring.duplex"))
    monkeypatch.setitem(sys.modules, "sounddevice", card)
    scope: dict = {}
    for script in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        exec(compile(script, "psychopy.md", "exec"), scope)  # noqa: S102  our own page
    player = runpy.run_path("experiment/play.py")
    for line in re.findall(r"^python play\.py (.*)$", page, re.MULTILINE):
        player["main"](shlex.split(line, comments=True))
    assert "UMC404" in capsys.readouterr().out
    assert len(Path("experiment/log.csv").read_text("utf-8").splitlines()) == 4
