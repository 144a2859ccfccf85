"""The self-contained folder has no Python: a program of its own answers in its place."""

import ctypes.util
import os
import runpy
import sys
from pathlib import Path

import numpy as np
import pytest
from loky import ProcessPoolExecutor

from skinsource.base import extras
from skinsource.base.errors import MissingExtraError
from skinsource.readers.reading_process import ReadingProcess

PROGRAM = Path("packaging/frozen_program.py").absolute()


@pytest.fixture
def frozen(tmp_path, monkeypatch):
    """Return functions of the program, for which a script stands in as ``skinsource-process``."""
    functions = runpy.run_path(str(PROGRAM))
    process = tmp_path / "skinsource-process"
    process.write_text(
        f"#!{sys.executable}\nimport runpy, sys\n"
        f"print(sys.argv, file=open({str(tmp_path / 'asked')!r}, 'a'))\n"
        f"runpy.run_path({str(PROGRAM)!r})['answer_for_python'](sys.argv[1:])\n"
    )
    process.chmod(0o755)
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    monkeypatch.setattr(sys, "executable", sys.executable)
    monkeypatch.setattr("multiprocessing.spawn._python_exe", os.fsencode(sys.executable))
    functions["be_without_python"](process)
    return functions


@pytest.mark.skipif(sys.platform == "win32", reason="a script with a first line is no program")
def test_files_are_read_and_sweeps_have_their_processes_without_python(frozen, tmp_path):
    np.save(tmp_path / "x.npy", np.arange(9.0))
    with ReadingProcess() as process:
        assert process.look(tmp_path / "x.npy").format == "NPY"
    # As sweeps do.
    with ProcessPoolExecutor(1) as pool:
        assert pool.submit(os.getpid).result() != os.getpid()
    asked = (tmp_path / "asked").read_text()
    assert "skinsource.base.run_limited" in asked
    assert "loky.backend.popen_loky" in asked


def test_code_and_modules_get_their_arguments_behind_flags_of_python(frozen, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", sys.argv)
    frozen["answer_for_python"](["-I", "-X", "utf8", "-c", "import sys; print(sys.argv)", "-m"])
    assert capsys.readouterr().out == "['-c', '-m']\n"


def test_other_programs_find_the_systems_libraries(frozen, monkeypatch):
    monkeypatch.setenv("LD_LIBRARY_PATH", "of this folder")
    monkeypatch.setenv("LD_LIBRARY_PATH_ORIG", "of the user")
    frozen["be_without_python"](Path(sys.executable))
    assert os.environ["LD_LIBRARY_PATH"] == "of the user"


def test_libraries_that_the_system_lacks_are_those_of_the_folder(frozen, tmp_path, monkeypatch):
    monkeypatch.setattr("ctypes.util.find_library", {"both": "of the system"}.get)
    for name in ("both", "ours"):
        (tmp_path / f"lib{name}.so.2").touch()
    frozen["find_libraries_in"](tmp_path)
    found = [ctypes.util.find_library(name) for name in ("both", "ours", "none")]
    assert found == ["of the system", str(tmp_path / "libours.so.2"), None]


def test_where_no_package_can_be_added_the_page_on_installing_is_named(frozen):
    with pytest.raises(MissingExtraError) as error:
        extras.package_of_extra("no_package_of_this_name", "cluster")
    assert "takes no further packages; docs/installing.html says" in str(error.value)
    assert "pip" not in str(error.value)
