import threading

import pytest

from skinsource.lab.playing.session import Session
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use


@pytest.fixture
def sound(monkeypatch):
    return use(monkeypatch, SyntheticSoundLibrary(Two=2, Eight=8))


@pytest.fixture
def session():
    over = threading.Event()
    new = Session(lambda stream: over.set())
    new.over = over
    yield new
    new.close()
