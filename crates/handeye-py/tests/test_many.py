"""The example for many cells: the same rows as one after the other, with a worker killed and a second run."""

import csv
import importlib.util
import os
import pathlib
import signal

import pytest

import handeye

distributed = pytest.importorskip("dask.distributed")
EXAMPLE = pathlib.Path(__file__).parent.parent / "examples" / "many_cells.py"
COUNT = 12


def load():
    """The example as a module that workers load as well."""
    spec = importlib.util.spec_from_file_location("many_cells", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def rows(table):
    with table.open(newline="") as file:
        return {row["folder"]: row for row in csv.DictReader(file)}


def test_nothing_is_lost_where_a_worker_dies_and_a_run_is_repeated(tmp_path):
    folders = []
    for k in range(COUNT):
        folders.append(str(tmp_path / f"cell-{k}"))
        handeye.simulate(folders[-1], captures=10, images=False, seed=k + 1)
    broken = pathlib.Path(folders[3]) / "handeye.toml"
    broken.write_text("setup = 'on the moon'\n")
    many, table = load(), tmp_path / "table.csv"
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            client.upload_file(str(EXAMPLE))
            many.row_of.__module__ = "many_cells"
            victim = next(iter(client.run(os.getpid).values()))
            half = folders[: COUNT // 2]
            futures = client.map(many.row_of, half, pure=True)
            os.kill(victim, signal.SIGKILL)
            assert many.run(table, half, client) == len(half)
            del futures
            # as if it had been stopped in the middle of a line
            table.write_text(table.read_text() + "cell-9,acc")
            assert many.run(table, folders, client) == COUNT - len(half)
            assert many.run(table, folders, client) == 0
    found = rows(table)
    assert sorted(found) == sorted(folders)
    assert found[folders[3]]["verdict"] == "error" and "on the moon" in found[folders[3]]["reason"]
    for folder in folders:
        expected = {key: str(value) for key, value in many.row_of(folder).items()}
        assert {key: found[folder][key] for key in expected} == expected
