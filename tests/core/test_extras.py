"""The line to type for a package that is not installed."""

import sys

import pytest

from skinsource.base import extras
from skinsource.base.errors import MissingExtraError


@pytest.mark.parametrize("editable", [True, False])
def test_the_line_fits_how_the_studio_is_installed(monkeypatch, tmp_path, editable):
    folder = tmp_path / "my studio" / "core" / "skinsource" / "extras"
    folder.mkdir(parents=True)
    root = folder.parents[2]
    if editable:
        (root / "pyproject.toml").write_text("[project]\n", encoding="utf-8")
    monkeypatch.setattr(extras, "__file__", str(folder / "__init__.py"))
    what = f'-e "{root}[audio]"' if editable else '"skinsource[audio]"'
    assert extras.extra_line("audio") == f"{sys.executable} -m pip install {what}"
    with pytest.raises(MissingExtraError) as error:
        extras.package_of_extra("no_package_of_this_name", "audio")
    assert extras.extra_line("audio") in str(error.value)
