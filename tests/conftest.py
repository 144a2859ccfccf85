"""What all tests share: no window on the screen, no data of the user, the measured dataset."""

import atexit
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import hypothesis
import numpy as np
import pytest
import scipy

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ["PYQTGRAPH_QT_LIB"] = "PySide6"

if os.environ.pop("PYTHONDONTWRITEBYTECODE", ""):
    # Nothing is written into the tree; but each process that a test starts would compile the
    # library anew.  Workers find the folder named already.
    os.environ["PYTHONPYCACHEPREFIX"] = tempfile.mkdtemp(prefix="skinsource-bytecode-")
    atexit.register(shutil.rmtree, os.environ["PYTHONPYCACHEPREFIX"], ignore_errors=True)

# The same examples each time, on machines of any speed; what fails is printed so that it can be
# repeated. `--hypothesis-profile=search` looks for new ones and prints its seed.
hypothesis.settings.register_profile(
    "same", deadline=None, derandomize=True, print_blob=True, database=None
)
hypothesis.settings.register_profile(
    "search", deadline=None, print_blob=True, database=None, max_examples=1000
)
hypothesis.settings.load_profile("same")


#: What takes longest, longest first: a worker that began with one of them last would end alone.
LONGEST_FIRST = (
    "tests/gui/monkey/",
    "tests/gui/test_scripts.py",
    "tests/gui/test_ending.py",
    "tests/core/frozen/",
    "tests/core/sweeps/test_running.py",
    "tests/core/test_notebooks.py",
)
BESIDE_THE_PROJECT = Path(__file__).resolve().parents[2] / "shared"


def pytest_configure(config: pytest.Config) -> None:
    """Where workers share the cores, have each multiply matrices on one of them.

    Threads of all of them on all cores wait for each other: that takes half as long again.
    """
    if getattr(config.option, "numprocesses", None):  # it is this one that starts the workers
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


@pytest.fixture(autouse=True, scope="session")
def _random_numbers_of_examples_are_registered() -> None:
    """At first: later, when modules are left out of searches, it cannot be seen who holds them."""

    @hypothesis.given(hypothesis.strategies.none())
    def one_example(_: None) -> None:
        """Nothing else."""

    one_example()


def pytest_report_header() -> str:
    """Say what the tests run with."""
    return f"numpy {np.__version__}, scipy {scipy.__version__}"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest; the rest stays in its order."""

    def place(item: pytest.Item) -> int:
        begins = (k for k, name in enumerate(LONGEST_FIRST) if item.nodeid.startswith(name))
        return next(begins, len(LONGEST_FIRST))

    items.sort(key=place)


@pytest.fixture(autouse=True)
def user_data(tmp_path_factory, monkeypatch) -> Iterator[Path]:
    """Give each test an empty user-data folder, so that nothing the user has is touched."""
    folder = tmp_path_factory.mktemp("user-data")
    monkeypatch.setenv("SKINSOURCE_DATA", str(folder))
    monkeypatch.delenv("SKINSOURCE_CONFIG", raising=False)
    yield folder
    # pytest keeps the folders of the last three runs, and a store is large
    shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture(scope="session")
def dataset_folder() -> Path:
    """Find the measured dataset as downloaded; skip where it is absent."""
    named = os.environ.get("SKINSOURCE_TEST_DATASET")
    folder = Path(named) if named else BESIDE_THE_PROJECT / "dataset"
    if not (folder / "impulseResponses.mat").is_file():
        pytest.skip(f"the measured dataset is not in {folder}; set SKINSOURCE_TEST_DATASET")
    return folder


@pytest.fixture(scope="session")
def installed_dataset(dataset_folder, tmp_path_factory) -> Iterator[Path]:
    """Install the measured dataset once; give the user-data folder it is in.  Read only."""
    pytest.importorskip("matio", reason="mat-io is not installed")
    from skinsource.limbs.dataset.install import install

    folder = tmp_path_factory.mktemp("installed")
    install(dataset_folder, folder=folder)
    yield folder
    shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture
def measured(installed_dataset, user_data, monkeypatch) -> Path:
    """Run the test with the measured dataset installed; give the user-data folder."""
    monkeypatch.setenv("SKINSOURCE_DATA", str(installed_dataset))
    return installed_dataset


@pytest.fixture(scope="session")
def matlab_reference() -> Path:
    """Find the references made by MATLAB; skip where they are absent."""
    folder = BESIDE_THE_PROJECT / "matlab-reference"
    if not folder.is_dir():
        pytest.skip(f"the references made by MATLAB are not in {folder}")
    return folder


def synthetic_response(limb: int, place: int) -> np.ndarray:
    """Response (522 taps, 72 outputs, 3 axes) that differs between limbs, places and axes."""
    response = np.full((522, 72, 3), limb + place / 100)
    response[3, 5, 1] += 0.25
    return response


@pytest.fixture(scope="session")
def write_table() -> Callable[..., None]:
    """Write ``impulseResponses.mat`` from rows of (data, model, location)."""
    matio = pytest.importorskip("matio", reason="mat-io is not installed")
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")

    def write(path: Path, rows: list[tuple[Any, Any, Any]], version: str = "v7.3") -> None:
        data, models, locations = zip(*rows, strict=True)
        table = pandas.DataFrame(
            {"Data": list(data), "Model": list(models), "Location": list(locations)}
        )
        matio.save_to_mat(str(path), {"dataTable": table}, version=version)

    return write


@pytest.fixture(scope="session")
def complete_rows() -> list[tuple[np.ndarray, float, float]]:
    """All 80 rows of a made-up dataset.  Copy the list before changing it."""
    return [
        (synthetic_response(limb, place), float(limb), float(place))
        for limb in range(1, 5)
        for place in range(1, 21)
    ]


@pytest.fixture(scope="session")
def synthetic_download(tmp_path_factory, write_table, complete_rows) -> Path:
    """Folder like the download, with made-up content.  Read only."""
    matio = pytest.importorskip("matio", reason="mat-io is not installed")
    from matio.utils.matclass import MatlabOpaque

    folder = tmp_path_factory.mktemp("made-up")
    write_table(folder / "impulseResponses.mat", complete_rows)
    maps = folder / "visualization"
    maps.mkdir()
    random = np.random.default_rng(1)
    polyshape = np.empty((1, 1), dtype=[("Vertices", "O")])
    polyshape["Vertices"][0, 0] = random.uniform(-600, -40, (1505, 2))
    outputs = random.uniform(-600, -40, (72, 2))
    outputs[60:66] = np.nan
    magnitudes = random.uniform(0, 400, (1505, 72))
    magnitudes[:, 60:66] = np.nan
    content = {
        "surface": ("surface", MatlabOpaque({"any": polyshape}, "polyshape")),
        "outputLocations": ("outputLocations", outputs),
        "inputLocations": ("inputLocations", random.uniform(-600, -40, (20, 2))),
        "adjacencyMatrix": ("adjacencyMatrix", magnitudes),
    }
    shapes = ((464, 174), (437, 164), (490, 184), (437, 164))
    for k, shape in enumerate(shapes, start=1):
        content[f"mask{k}"] = ("mask", (np.indices(shape).sum(axis=0) % 2).astype(float))
    for name, (variable, value) in content.items():
        matio.save_to_mat(str(maps / f"{name}.mat"), {variable: value}, version="v7")
    return folder


@pytest.fixture(scope="session")
def synthetic_store(synthetic_download, tmp_path_factory) -> Iterator[Path]:
    """Store made from the made-up download.  Read only."""
    from skinsource.limbs.dataset.install import install

    folder = tmp_path_factory.mktemp("made-up-store")
    yield install(synthetic_download, unpublished=True, folder=folder).path
    shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture
def synthetic_installed(synthetic_store, user_data) -> Path:
    """Install a synthetic dataset for a single test; give the store."""
    path = user_data / synthetic_store.name
    shutil.copyfile(synthetic_store, path)
    return path
