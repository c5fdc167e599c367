"""Least weights for a scheme, and proofs that there are none, checked by a program that has no code of temper."""

import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import temper

pytestmark = pytest.mark.usefixtures("in_scratch")

CHECK = pathlib.Path(__file__).resolve().parents[2] / "bench" / "check_none.py"
SETS = ("coefficients", "distances")
THIRD = 2 * np.pi / 3


def pinwheel(turn=0.1):
    """Two nested triangles, the ring between them divided like a pinwheel: no weights make all of its edges regular."""
    angles = THIRD * np.arange(3)
    points = np.vstack([r * np.column_stack([np.cos(a), np.sin(a)]) for r, a in ((4, angles), (1, angles + turn))])
    return temper.Mesh(points, [(3, 4, 5), (0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4), (2, 0, 3), (2, 3, 5)])


def cone():
    """Tetrahedra between a pinwheel and an apex."""
    base = pinwheel()
    points = np.vstack([np.column_stack([base.points, np.zeros(6)]), [(0.5, 0.25, 3)]])
    return temper.TetMesh(points, [(*t, 6) for t in base.triangles])


def check(mesh, certificate):
    temper.write("in.vtu", mesh, encoding="ascii")
    pathlib.Path("why.json").write_text(json.dumps(certificate), encoding="utf-8")
    return subprocess.run([sys.executable, CHECK, "in.vtu", "why.json"], capture_output=True, text=True)


@pytest.mark.parametrize("make", [pinwheel, cone])
@pytest.mark.parametrize("constraints", [*SETS, "regular"])
def test_another_program_proves_in_fractions_that_there_are_no_weights(make, constraints):
    mesh = make()
    report = temper.find_weights(mesh, constraints=constraints, goal="margin" if constraints == "regular" else "least")
    assert report.verdict == "infeasible"
    certificate = json.loads(report.certificate.to_json())
    result = check(mesh, certificate)
    assert result.returncode == 0, result.stdout + result.stderr
    assert "proved" in result.stdout
    for i in range(len(certificate["terms"])):
        changed = json.loads(json.dumps(certificate))
        changed["terms"][i]["multiplier"] *= 3
        assert check(mesh, changed).returncode == 1
    changed = json.loads(json.dumps(certificate))
    changed["terms"][0]["kind"] = "crossing"
    changed["terms"][0]["edge"] = [0, 1]
    assert check(mesh, changed).returncode == 1


@pytest.mark.parametrize("constraints", SETS)
def test_least_weights_are_smaller_than_those_of_other_goals(constraints):
    ring = temper.generate.annulus(jitter=0.3)
    mesh = temper.Mesh(ring.points * [1, 1.5], ring.triangles)
    assert temper.quality(mesh).non_regular_edges > 0
    edges, points = mesh.edges, mesh.points

    def size(goal):
        report = temper.find_weights(mesh, constraints=constraints, goal=goal)
        assert report.verdict == "feasible" and report.solved
        w, l2 = report.weights, ((points[edges[:, 0]] - points[edges[:, 1]]) ** 2).sum(1)
        return (((w[edges[:, 0]] - w[edges[:, 1]]) / (2 * l2)) ** 2).sum()

    assert 0 < size("least") <= 1.0001 * size("change")


def test_goals_without_a_proof_are_refused():
    with pytest.raises(temper.TemperError, match="goal: center and accuracy are not for constraints distances"):
        temper.find_weights(temper.generate.annulus(), constraints="distances", goal="accuracy")
