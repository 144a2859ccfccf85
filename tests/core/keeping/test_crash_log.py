"""A crash leaves a log; a studio that ends as it should leaves none."""

import logging
import os
import subprocess
import sys
import threading

import pytest

from skinsource.base.crash_log import MOST_LOGS, CrashLog, crashed_logs, note_offered

PROGRAM = """
import faulthandler, logging, os, sys
from pathlib import Path
from skinsource.base.crash_log import CrashLog
log = CrashLog(Path(sys.argv[1]))
log.open()
exec(sys.argv[2])
"""


def run(folder, line):
    command = [sys.executable, "-c", PROGRAM, str(folder), line]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_a_crash_of_the_process_leaves_where_it_was(tmp_path):
    assert run(tmp_path, "faulthandler._sigsegv()").returncode != 0
    (log,) = crashed_logs(tmp_path)
    text = log.read_text()
    assert "SkinSource studio" in text.splitlines()[0]
    assert "Fatal Python error: Segmentation fault" in text
    assert 'File "<string>"' in text
    note_offered(log)
    assert crashed_logs(tmp_path) == ()
    assert log.is_file()


def test_a_mistake_that_nobody_caught_is_written_down_and_shown_as_ever(tmp_path):
    done = run(tmp_path, "1 / 0")
    assert "ZeroDivisionError" in done.stderr
    assert "ZeroDivisionError" in crashed_logs(tmp_path)[0].read_text()


@pytest.mark.parametrize(
    ("line", "noted"),
    [
        ("log.close()", []),
        ("logging.getLogger('a').error('strange'); log.close()", ["ERROR a: strange"]),
        ("logging.getLogger('a').warning('old font'); os.kill(os.getpid(), 9)", ["old font"]),
    ],
)
def test_a_studio_that_ended_as_it_should_or_was_killed_without_a_fault_offers_none(
    tmp_path, line, noted
):
    run(tmp_path, line)
    logs = [path.read_text() for path in (tmp_path / "logs").iterdir()]
    assert len(logs) == len(noted)
    assert all(words in log for words, log in zip(noted, logs, strict=True))
    assert crashed_logs(tmp_path) == ()


@pytest.fixture
def log(tmp_path):
    log = CrashLog(tmp_path)
    log.open()
    yield log
    log.close()


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_log_holds_warnings_and_mistakes_in_threads_and_fills_no_disk(log, tmp_path):
    logging.getLogger("a").warning("careful")
    logging.getLogger("a").info("all is well")
    thread = threading.Thread(target=lambda: 1 / 0)
    thread.start()
    thread.join()
    text = log.path.read_text()
    assert "careful" in text
    assert "all is well" not in text
    assert "ZeroDivisionError" in text
    assert crashed_logs(tmp_path) == ()
    for _ in range(300):
        logging.getLogger("a").error("x" * 10_000)
    assert log.path.stat().st_size < 1.1 * 2**20


def test_hooks_are_put_back(tmp_path):
    hooks = sys.excepthook, threading.excepthook, list(logging.getLogger().handlers)
    log = CrashLog(tmp_path)
    log.open()
    assert sys.excepthook is not hooks[0]
    log.close()
    log.close()
    assert (sys.excepthook, threading.excepthook, logging.getLogger().handlers) == hooks


def test_only_the_newest_logs_are_kept(tmp_path):
    (tmp_path / "logs").mkdir()
    for k in range(9):
        (tmp_path / "logs" / f"studio-2026010{k}-000000-1.log").write_text("a\nb\nc\nd\n")
    log = CrashLog(tmp_path)
    log.open()
    names = sorted(os.listdir(tmp_path / "logs"))
    assert len(names) == MOST_LOGS
    assert log.path.name in names
    log.close()


def test_where_no_log_can_be_written_the_studio_starts_without(tmp_path):
    (tmp_path / "logs").write_text("")
    log = CrashLog(tmp_path)
    log.open()
    logging.getLogger("a").error("lost")
    log.close()
    assert crashed_logs(tmp_path) == ()
