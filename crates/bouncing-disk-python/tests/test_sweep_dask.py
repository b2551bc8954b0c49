"""Sweeps on clusters of local processes: the same bits, whoever computes and whoever dies."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sweep_functions as functions

import bouncing_disk as bd

distributed = pytest.importorskip("distributed")

GRID = {"axial_forcing": np.linspace(0.45, 2.5, 12), "restitution": np.linspace(0.3, 0.7, 4)}
CHUNKS = 48


def cluster(workers: int) -> Any:
    return distributed.LocalCluster(
        n_workers=workers, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
    )


@pytest.fixture(scope="module")
def two() -> Iterator[Any]:
    with cluster(2) as processes, distributed.Client(processes) as client:
        yield client


def swept(client: Any, log: Path, seconds: float = 0.0, **options: Any) -> bd.SweepResult:
    arguments = {"seconds": seconds, "log": str(log)}
    return bd.sweep(functions.slow_speeds, GRID, client, arguments=arguments, **{"chunk_size": 1, **options})


def pids(log: Path) -> list[int]:
    return [int(line) for line in log.read_text().split()]


def test_one_worker_is_killed_and_the_sweep_is_resumed_with_three(tmp_path: Path) -> None:
    log, folder = tmp_path / "log", tmp_path / "sweep"
    serial = swept("serial", tmp_path / "alone", chunk_size=48)
    killed: list[int] = []

    class Ended(Exception):
        """The caller ends the sweep in mid run."""

    with cluster(2) as processes, distributed.Client(processes) as client:

        def kill_and_end(done: int, total: int) -> None:
            if done == 10:
                killed.append(next(iter(processes.workers.values())).pid)
                os.kill(killed[0], signal.SIGKILL if sys.platform != "win32" else signal.SIGTERM)
            if done == 30:
                raise Ended

        with pytest.raises(Ended):
            swept(client, log, 0.05, folder=folder, progress=kill_and_end)
    assert killed and killed[0] in pids(log)
    # The other one went on alone, and a new one beside it.
    assert len(set(pids(log))) >= 2
    kept = len(list(folder.glob("chunk-*.npz")))
    assert 30 <= kept < CHUNKS
    first = len(pids(log))
    with cluster(3) as processes, distributed.Client(processes) as client:
        resumed = swept(client, log, 0.05, folder=folder)
    assert len(pids(log)) - first == CHUNKS - kept
    assert resumed.values.tobytes() == serial.values.tobytes()
    assert bd.read_sweep(folder).values.tobytes() == serial.values.tobytes()


def test_a_sweep_outlives_the_death_of_all_workers(tmp_path: Path) -> None:
    with cluster(2) as processes, distributed.Client(processes) as client:

        def kill_all(done: int, total: int) -> None:
            if done == 10:
                for worker in list(processes.workers.values()):
                    os.kill(worker.pid, signal.SIGTERM if sys.platform == "win32" else signal.SIGKILL)

        result = swept(client, tmp_path / "log", 0.02, progress=kill_all)
    assert result.values.tobytes() == swept("serial", tmp_path / "alone").values.tobytes()


@pytest.mark.parametrize("chunk_size", [5, 48])
def test_processes_give_the_same_bits(two: Any, tmp_path: Path, chunk_size: int) -> None:
    result = swept(two, tmp_path / "log", chunk_size=chunk_size)
    assert result.values.tobytes() == swept("serial", tmp_path / "alone").values.tobytes()
    assert os.getpid() not in pids(tmp_path / "log")
    assert len(np.unique(result.values)) > 20


def test_local_processes_are_the_default(tmp_path: Path) -> None:
    log = tmp_path / "log"
    told: list[int] = []
    result = swept(None, log, folder=tmp_path / "sweep", progress=lambda done, total: told.append(done))
    assert result.values.tobytes() == swept("serial", tmp_path / "alone").values.tobytes()
    assert os.getpid() not in pids(log)
    assert told == list(range(CHUNKS + 1))
    # A finished one starts no processes.
    started = time.monotonic()
    swept(None, log, folder=tmp_path / "sweep")
    assert time.monotonic() - started < 0.5


def test_failed_points_are_named_on_a_cluster(two: Any) -> None:
    grid = {"a": [1.0, 2.0, 3.0, 4.0], "b": [10.0, 20.0, 30.0]}
    with pytest.raises(bd.SweepFailedError, match=r"at 1 point: a = 3\.0, b = 20\.0: ValueError") as failure:
        bd.sweep(functions.refuses_three, grid, two, chunk_size=4)
    result = failure.value.result
    assert result is not None and result.failed.sum() == 1
    with pytest.raises(bd.SweepFunctionError, match=r"shape \(5,\) for 4 points"):
        bd.sweep(functions.wrong_length, grid, two, chunk_size=4)
    with pytest.raises(bd.SweepFailedError, match="SystemExit"):
        bd.sweep(functions.leaves, grid, two, chunk_size=4)
    # The cluster serves on.
    assert bd.sweep(functions.product, grid, two).values[0, 0] == 10.0


def test_lambdas_are_sent_and_what_cannot_be_is_refused(two: Any) -> None:
    grid = {"a": [1.0, 2.0]}
    factor = 3.0
    assert bd.sweep(lambda a: factor * a, grid, two).values.tolist() == [3.0, 6.0]
    lock = threading.Lock()
    with pytest.raises(bd.SweepFunctionError, match='cannot be sent to workers.*client="serial"'):
        bd.sweep(lambda a: (lock, a)[1], grid, two)


def other_versions() -> None:
    """Has a worker report another NumPy than it has, as a badly installed node would."""
    from importlib import metadata

    from bouncing_disk._sweep.folder import VERSIONS

    own = metadata.version
    setattr(metadata, "version", lambda package: "1.0.0" if package == "numpy" else own(package))
    VERSIONS["numpy"] = "1.0.0"


def test_workers_with_other_versions_are_refused_before_the_work(tmp_path: Path) -> None:
    log, folder = tmp_path / "log", tmp_path / "sweep"
    with cluster(2) as processes, distributed.Client(processes) as client:
        first, second = client.scheduler_info()["workers"]
        client.run(other_versions, workers=[second])
        with pytest.raises(bd.SweepClusterError, match="numpy 1.0.0 instead of") as refused:
            swept(client, log, folder=folder)
        assert refused.value.kind == "versions" and list(refused.value.workers) == [second]
        assert refused.value.workers[second]["numpy"] == "1.0.0"
        assert not log.exists() and not list(folder.glob("chunk-*"))
    # The folder serves on.
    assert swept("serial", log, folder=folder).values.shape == (12, 4)


def test_a_worker_with_other_versions_that_joins_later_is_noticed(tmp_path: Path) -> None:
    with cluster(1) as processes, distributed.Client(processes) as client:

        def spoil(done: int, total: int) -> None:
            if done == 5:
                client.run(other_versions)

        with pytest.raises(bd.SweepClusterError, match="joined later.*numpy 1.0.0"):
            swept(client, tmp_path / "log", 0.02, folder=tmp_path / "sweep", progress=spoil)
    assert len(list((tmp_path / "sweep").glob("chunk-*.npz"))) >= 5


def test_clients_that_cannot_be_used_are_refused_at_once(tmp_path: Path) -> None:
    with cluster(1) as processes:
        client = distributed.Client(processes)
        with pytest.raises(TypeError, match=r"give Client\(cluster\)"):
            swept(processes, tmp_path / "log")
        client.close()
        with pytest.raises(bd.SweepClusterError, match="closed") as refused:
            swept(client, tmp_path / "log", folder=tmp_path / "x")
        assert refused.value.kind == "closed"
    assert not list(tmp_path.iterdir())


def test_an_interrupt_leaves_the_cluster_and_the_chunks(two: Any, tmp_path: Path) -> None:
    def interrupt(done: int, total: int) -> None:
        if done == 5:
            raise KeyboardInterrupt

    folder = tmp_path / "sweep"
    with pytest.raises(KeyboardInterrupt):
        swept(two, tmp_path / "log", 0.02, folder=folder, progress=interrupt)
    assert len(list(folder.glob("chunk-*.npz"))) == 5
    result = swept(two, tmp_path / "log", folder=None)
    assert result.values.shape == (12, 4)
    # What was cancelled is not computed behind the caller's back.
    time.sleep(0.3)
    assert not two.processing() or not any(two.processing().values())


@pytest.mark.parametrize("guard", ['if __name__ == "__main__":', "if True:"])
def test_a_function_of_a_script_is_swept_behind_its_guard(tmp_path: Path, guard: str) -> None:
    script = tmp_path / "script.py"
    script.write_text(f"""
import bouncing_disk as bd

def double(x):
    return 2 * x

{guard}
    print(bd.sweep(double, {{"x": [1.0, 2.0, 3.0]}}).values.tolist())
""")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=120)
    if guard == "if True:":
        assert done.returncode != 0
        assert 'put the call behind `if __name__ == "__main__":`' in done.stderr
    else:
        assert done.returncode == 0 and done.stdout.strip() == "[2.0, 4.0, 6.0]", done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_an_interrupt_from_the_terminal_reaches_all_processes(tmp_path: Path) -> None:
    """As Ctrl-C does: the caller, the workers and those that watch them get the signal together."""
    folder, log = tmp_path / "sweep", tmp_path / "log"
    text = textwrap.dedent(
        f"""
        import sys
        sys.path.insert(0, {str(Path(__file__).parent)!r})
        import numpy as np
        import bouncing_disk as bd
        import sweep_functions as functions

        if __name__ == "__main__":
            grid = {{"axial_forcing": np.linspace(0.45, 2.5, 12), "restitution": np.linspace(0.3, 0.7, 4)}}
            bd.sweep(functions.slow_speeds, grid, folder={str(folder)!r}, chunk_size=1,
                     arguments={{"seconds": 0.1, "log": {str(log)!r}}})
        """
    )
    script = tmp_path / "script.py"
    script.write_text(text)
    process = subprocess.Popen([sys.executable, str(script)], start_new_session=True, stderr=subprocess.PIPE)
    deadline = time.monotonic() + 60
    while len(list(folder.glob("chunk-*.npz"))) < 5:
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    started = time.monotonic()
    _, errors = process.communicate(timeout=60)
    assert time.monotonic() - started < 30
    assert process.returncode != 0 and b"KeyboardInterrupt" in errors
    kept = len(list(folder.glob("chunk-*.npz")))
    assert 5 <= kept < CHUNKS
    resumed = swept("serial", log, 0.1, folder=folder)
    assert resumed.values.tobytes() == swept("serial", tmp_path / "alone").values.tobytes()
