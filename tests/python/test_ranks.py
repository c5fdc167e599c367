"""optimize(communicator=…): processes of mpi4py make one run together, with the bits of one alone."""

import os
import shutil
import subprocess
import sys

import numpy as np
import pytest

import temper

SCRIPT = """
import sys
import numpy as np
import temper
from mpi4py import MPI

world, kind = MPI.COMM_WORLD, sys.argv[1]
if kind == "differ":
    mesh = temper.generate.random_mesh(200, seed=1 + world.rank // 2)  # rank 2 has another
    try:
        temper.optimize(mesh, hooks=temper.Hooks(communicator=world))
    except temper.TemperError as error:
        print(f" {world.rank} {error.code} ")
else:
    mesh = temper.generate.random_mesh(20_000, seed=4)  # of two parts
    seen = []
    report = temper.optimize(mesh, threads=1, progress=seen.append, hooks=temper.Hooks(communicator=world), options={"max_sweeps": 6})
    np.savez(f"rank{world.rank}.npz", points=mesh.points, weights=mesh.weights, triangles=mesh.triangles,
             sweeps=report.sweeps, seen=len(seen))
"""


@pytest.fixture
def together(tmp_path):
    """Runs the script on so many ranks; gives what they print."""
    pytest.importorskip("mpi4py")
    mpirun = shutil.which("mpirun")
    if mpirun is None:
        pytest.skip("there is no mpirun")
    (tmp_path / "script.py").write_text(SCRIPT)
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl_base_warn_component_unused="0")

    def run(ranks, kind):
        done = subprocess.run([mpirun, "-n", str(ranks), sys.executable, "script.py", kind], cwd=tmp_path, env=environment,
                              capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return run


def test_ranks_get_the_bits_of_one_process(together, tmp_path):
    alone = temper.generate.random_mesh(20_000, seed=4)
    report = temper.optimize(alone, threads=1, options={"max_sweeps": 6})
    together(3, "run")
    for rank in range(3):
        with np.load(tmp_path / f"rank{rank}.npz") as found:
            for name in ("points", "weights", "triangles"):
                assert found[name].tobytes() == getattr(alone, name).tobytes()
            assert found["sweeps"] == report.sweeps
            assert (found["seen"] > 0) == (rank == 0), "the observer is that of rank 0"


def test_all_ranks_hear_that_one_has_another_mesh(together):
    assert sorted(together(3, "differ").split()) == sorted(["0", "1", "2", *3 * ["rank_mismatch"]])


def test_what_is_no_communicator_is_refused():
    with pytest.raises(TypeError, match="communicator: expected a communicator of mpi4py or None, found 3"):
        temper.optimize(temper.generate.annulus(), hooks=temper.Hooks(communicator=3))
