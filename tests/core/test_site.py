"""Each block of code on a page runs and prints what stands below it; each example draws."""

import contextlib
import io
import re
import runpy
import shlex
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import skinsource as ss
from skinsource.cli.command_line import main

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
#: Also within lists.
FENCED = re.compile(r"^ *```(\S*)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
#: Code that Markdown knows by its blanks.
INDENTED = re.compile(r"\n\n {4}\S.*")
MENU = re.compile(r"\b(File|Edit|Clip|View|Play|Help) > (.{,60})")
#: Its own test gives it a sound card: tests/core/playing/test_playing_page.py.
NEEDS_A_CARD = "playing"
CODE = re.compile(r"^ *```(?:python|sh|toml)\n", re.MULTILINE)
WITH_CODE = [
    page for page in PAGES if page.stem != NEEDS_A_CARD and CODE.search(page.read_text("utf-8"))
]
EXAMPLES = sorted((ROOT / "examples" / "gallery").glob("plot_*.py"))
#: Parts of the site.
NOT_CODE = "{toctree}", "{include}"
#: What begins a command that changes the machine, or needs a card: other tests try them.
INSTALLING = (
    "make ",
    "cp ",
    "update-",
    "py ",
    ".venv",
    "pip ",
    "pipx ",
    "uv ",
    "sudo ",
    "dask ",
    "python play.py ",
    "skinsource-gui",
)


@contextlib.contextmanager
def cluster_for(arguments: list[str]) -> Iterator[list[str]]:
    """Give the arguments, and where they name a scheduler, one on this computer in its place."""
    if "--scheduler" not in arguments:
        yield arguments
        return
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as own:
        yield [*arguments[: arguments.index("--scheduler") + 1], own.scheduler_address]


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
            lines = map(str.strip, code.replace("\\\n", " ").splitlines())
            for line in (each for each in lines if not each.startswith(INSTALLING)):
                program, *arguments = shlex.split(line, comments=True)
                assert program == "skinsource"
                with cluster_for(arguments) as of_this_computer:
                    assert main(of_this_computer) == 0
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


def test_code_stands_between_fences_so_that_it_is_tried():
    for page in PAGES:
        assert not INDENTED.findall(FENCED.sub("", page.read_text("utf-8"))), page


def test_a_menu_that_a_page_names_is_in_the_window():
    menus = tomllib.loads((ROOT / "resources" / "actions.toml").read_text("utf-8"))
    entries = {
        menu: ("Panels", *(each["text"].partition("{")[0].rstrip("…") for each in actions.values()))
        for menu, actions in menus.items()
    }
    for page in PAGES:
        text = " ".join(page.read_text("utf-8").replace("*", "").split())
        for menu, entry in MENU.findall(text):
            assert entry.startswith(entries[menu]), f"{page.stem}: {menu} > {entry}"


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
