"""What the page on experiments says is true."""

import re
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
