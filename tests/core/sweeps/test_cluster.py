"""A sweep on a local cluster of two workers, one of which is killed on the way."""

import logging
import os
import signal

import pytest

import skinsource as ss
from skinsource.base.errors import SkinSourceError
from skinsource.studies.sweeps.plan import Plan
from skinsource.studies.sweeps.running import Sweep, run

distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
cluster = pytest.importorskip("skinsource.studies.sweeps.workers")

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture
def two_workers():
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True
    ) as cluster:
        yield cluster


def test_no_row_is_lost_or_doubled_where_a_worker_is_killed(two_workers):
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, tone), ss.track(3, tone)))
    plan = Plan(designs=(("one", design),), variables=(("2.frequency_hz", tuple(range(50, 210))),))
    victim = next(iter(two_workers.workers.values())).pid
    reports = []

    def progress(done, total, text):
        reports.append(done)
        if done == 20:
            os.kill(victim, signal.SIGKILL)

    table = run(
        Sweep(plan=plan),
        None,
        measuring=cluster.Cluster(two_workers.scheduler_address),
        progress=progress,
    )
    assert reports == list(range(161))
    here = run(Sweep(plan=plan), None, processes=1)
    assert [repr(row) for row in table.rows] == [repr(row) for row in here.rows]
    assert not table.failed


def test_a_scheduler_that_does_not_answer_is_one_sentence(monkeypatch):
    monkeypatch.setattr(cluster, "_CONNECT_S", 1)
    plan = Plan(designs=(("one", ss.Design(limb="synthetic-1", inputs=(ss.track(7),))),))
    with pytest.raises(SkinSourceError, match="does not respond"):
        run(Sweep(plan=plan), None, measuring=cluster.Cluster("tcp://127.0.0.1:9"))
