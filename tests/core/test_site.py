"""Each block of code on a page runs and prints what stands below it; each example draws."""

import contextlib
import io
import re
import runpy
import shlex
from pathlib import Path

import pytest

import skinsource as ss
from skinsource.cli.command_line import main

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
FENCED = re.compile(r"^```(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
WITH_CODE = [
    page for page in PAGES if re.search("^```(python|sh|toml)", page.read_text("utf-8"), re.M)
]
EXAMPLES = sorted((ROOT / "examples" / "gallery").glob("plot_*.py"))
#: Drawings of the graph, and parts of the site.
NOT_CODE = "mermaid", "{toctree}", "{include}"
#: What begins a command that changes the machine: packages/CI try them.
INSTALLING = "make ", "py ", ".venv", "pip ", "pipx ", "uv ", "sudo ", "skinsource-gui"


def run(language: str, code: str, values: dict) -> str:
    """Run a block as a reader would, in the folder where they are, and return what it prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        if language == "python":
            exec(compile(code, "page", "exec"), values)  # noqa: S102  our own page
        elif language == "toml":
            name = code.splitlines()[0].removeprefix("# ")
            Path(name).write_text(code, "utf-8")
        else:
            for line in code.replace("\\\n", " ").splitlines():
                if not line.startswith(INSTALLING):
                    program, *arguments = shlex.split(line, comments=True)
                    assert program == "skinsource"
                    assert main(arguments) == 0
    return printed.getvalue()


@pytest.mark.usefixtures("user_data")
@pytest.mark.parametrize("page", WITH_CODE, ids=lambda page: page.stem)
def test_the_code_of_a_page_runs_and_prints_what_the_page_says(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    values, printed = {}, ""
    for language, code in FENCED.findall(page.read_text(encoding="utf-8")):
        if language == "text":
            assert code == printed
        elif language not in NOT_CODE:
            assert language in ("python", "toml", "sh", "bat"), f"of no language: {code}"
            printed = run(language, code, values)


def test_each_public_name_stands_on_a_page_of_the_library():
    text = "".join(page.read_text("utf-8") for page in (ROOT / "docs" / "api").glob("*.rst"))
    named = re.findall(r"^\.\. auto\w+:: (?:skinsource\.)?(\S+)", text, re.M)
    assert sorted(named) == sorted(set(ss.__all__) - {"__version__"})


def test_there_are_sixteen_examples():
    assert len(EXAMPLES) >= 16


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_draws_and_is_short(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    values = runpy.run_path(str(path))
    figures = [value for value in values.values() if hasattr(value, "savefig")]
    assert figures
    code = path.read_text(encoding="utf-8").split('"""')[2]
    assert len(code.strip().splitlines()) <= 30
