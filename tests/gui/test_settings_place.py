"""Settings lie in the folder for settings."""

from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray

from skinsource.base.assets import config_folder
from skinsource_gui.state.preferences import Preferences, settings_path


@pytest.fixture
def config(tmp_path, monkeypatch) -> Path:
    folder = tmp_path / "config"
    monkeypatch.setenv("SKINSOURCE_CONFIG", str(folder))
    return folder


def test_a_folder_for_settings_of_its_own_isolates_them(config):
    assert settings_path() == config / "studio.ini"
    assert not config.exists()


def test_whoever_sets_the_data_folder_has_everything_in_it(user_data, monkeypatch):
    monkeypatch.delenv("SKINSOURCE_CONFIG", raising=False)
    assert user_data in config_folder().parents
    monkeypatch.delenv("SKINSOURCE_DATA")
    assert config_folder().name == "skinsource"


@pytest.mark.parametrize("stored", [QByteArray(b"abc"), 5, {"a": 1}, None])
def test_recent_files_that_are_no_list_of_names_are_none(tmp_path, stored):
    preferences = Preferences(tmp_path / "studio.ini")
    preferences.settings.setValue("recent", stored)
    assert all(isinstance(name, str) for name in preferences.recent_names)
    assert len(preferences.recent_names) <= 1
