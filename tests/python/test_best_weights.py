"""The proofs of temper weights --mode center and accuracy, checked by a program that has no code of temper."""

import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import temper

pytestmark = pytest.mark.usefixtures("in_scratch")

CHECK = pathlib.Path(__file__).resolve().parents[2] / "bench" / "check_best.py"
MESHES = {
    "plane": ("annulus", []),
    "sphere": ("icosahedral", ["--level", "2"]),
    "periodic": ("random-periodic", ["--vertices", "100"]),
}


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True)


def proof(mesh, *options):
    """The mesh with best weights and the certificate, after temper."""
    result = run("temper", "weights", mesh, "-o", "out.vtu", "--encoding", "ascii", "--certificate", "best.json", *options)
    assert result.returncode == 0, result.stderr
    return json.loads(pathlib.Path("best.json").read_text(encoding="utf-8"))


def check(certificate, *options):
    pathlib.Path("best.json").write_text(json.dumps(certificate), encoding="utf-8")
    return run(sys.executable, CHECK, "out.vtu", "best.json", *options)


@pytest.mark.parametrize("mode", ["center", "accuracy"])
@pytest.mark.parametrize("constraints", ["well-centered", "heights-only", "regular"])
@pytest.mark.parametrize("space", MESHES)
def test_another_program_proves_that_weights_are_best(mode, constraints, space):
    name, options = MESHES[space]
    assert run("temper", "example", name, "-o", "in.vtu", *options).returncode == 0
    if space == "periodic":
        assert run("temper", "optimize", "in.vtu", "-o", "in.vtu", "--keep", "weights").returncode == 0
    certificate = proof("in.vtu", "--mode", mode, "--constraints", constraints)
    result = check(certificate)
    assert result.returncode == 0, result.stdout + result.stderr
    assert "proved" in result.stdout


def test_tetrahedra_have_proofs():
    points = np.array([(x, y, z) for z in range(3) for y in range(3) for x in range(3)], float)
    points[13] += (0.1, -0.05, 0.07)
    cells = []
    for x, y, z in np.ndindex(2, 2, 2):
        at = lambda i, j, k: (x + i) + 3 * (y + j) + 9 * (z + k)
        for a, b in [((1, 0, 0), (1, 1, 0)), ((1, 1, 0), (0, 1, 0)), ((0, 1, 0), (0, 1, 1)), ((0, 1, 1), (0, 0, 1)),
                     ((0, 0, 1), (1, 0, 1)), ((1, 0, 1), (1, 0, 0))]:  # fmt: skip
            cells.append((at(0, 0, 0), at(*a), at(*b), at(1, 1, 1)))
    mesh = temper.TetMesh(points, np.array(cells))
    temper.write("box.vtu", mesh)
    for mode in ("center", "accuracy"):
        result = check(proof("box.vtu", "--mode", mode, "--constraints", "regular"))
        assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.parametrize("mode", ["center", "accuracy"])
def test_a_changed_proof_is_found_out(mode):
    assert run("temper", "example", "annulus", "-o", "in.vtu").returncode == 0
    certificate = proof("in.vtu", "--mode", mode)
    assert check(certificate, "--tolerance", "1e-8").returncode == 0

    def changed(change):
        copy = json.loads(json.dumps(certificate))
        change(copy)
        return check(copy)

    heaviest = max(range(len(certificate["terms"])), key=lambda i: certificate["terms"][i]["multiplier"])
    assert changed(lambda c: c["terms"][heaviest].update(multiplier=1.01 * c["terms"][heaviest]["multiplier"])).returncode == 1
    assert changed(lambda c: c["terms"].pop(0)).returncode == 1
    assert changed(lambda c: c["terms"].append(c["terms"][0])).returncode == 1
    assert changed(lambda c: c["terms"][0].update(multiplier=-1.0)).returncode == 1
    assert changed(lambda c: c.update(margin=0.02)).returncode == 1
    if mode == "accuracy":
        assert changed(lambda c: c["offsets"][5].update(factor=1.01 * c["offsets"][5]["factor"])).returncode == 1


def test_temper_says_who_checks_such_a_proof():
    assert run("temper", "example", "annulus", "-o", "in.vtu").returncode == 0
    proof("in.vtu", "--mode", "center")
    result = run("temper", "weights", "in.vtu", "--check-certificate", "best.json")
    assert result.returncode == 1 and "bench/check_best.py" in result.stderr


def test_python_has_the_proof():
    mesh = temper.generate.annulus()
    for goal in ("center", "accuracy"):
        report = temper.find_weights(mesh, goal=goal)
        assert report.solved and report.optimality.goal == goal
        assert report.optimality.relative_gap <= 1e-8
        assert len(report.optimality.terms) == 3 * len(mesh.triangles) + 2 * len(mesh.edges)
    assert temper.find_weights(mesh).optimality is None


@pytest.mark.parametrize("goal", ["center", "accuracy"])
def test_clarabel_finds_no_better_weights(goal):
    clarabel = pytest.importorskip("clarabel")
    sparse = pytest.importorskip("scipy.sparse")
    mesh = temper.generate.annulus()
    proof = temper.find_weights(mesh, goal=goal).optimality
    n = len(mesh.points)

    def rows(forms):
        matrix = sparse.lil_matrix((len(forms), n))
        for i, (at, _) in enumerate(forms):
            for v, x in at.items():
                matrix[i, v] += x
        return matrix.tocsc(), np.array([constant for _, constant in forms])

    a, b = rows([value(mesh.points, term[0]) for term in proof.terms])
    b = b - proof.margin
    anchor = sparse.csc_matrix(([1.0], ([0], [0])), (1, n))
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    if goal == "accuracy":
        c, d = rows([value(mesh.points, term.at) for term in proof.offsets])
        d = d - np.array([term.target for term in proof.offsets])
        factors = np.array([term.factor for term in proof.offsets])
        scaled = sparse.diags(factors) @ c
        p, q, constant = 2 * c.T @ scaled, 2 * scaled.T @ d, factors @ d**2
        rows_of, bounds = sparse.vstack([-a, anchor]).tocsc(), np.append(b, 0)
        cones = [clarabel.NonnegativeConeT(len(b)), clarabel.ZeroConeT(1)]
        solution = clarabel.DefaultSolver(sparse.triu(p).tocsc(), q, rows_of, bounds, cones, settings).solve()
        found = solution.obj_val + constant
    else:  # minimize -sum t with exp(t) <= s
        m = len(b)
        blocks, bounds = [], []
        for i in range(m):
            blocks.append(sparse.csc_matrix(([-1.0], ([0], [n + i])), (1, n + m)))
            blocks.append(sparse.csc_matrix((1, n + m)))
            blocks.append(sparse.hstack([-a[i], sparse.csc_matrix((1, m))]))
            bounds += [0, 1, b[i]]
        rows_of = sparse.vstack([*blocks, sparse.hstack([anchor, sparse.csc_matrix((1, m))])]).tocsc()
        cones = [clarabel.ExponentialConeT()] * m + [clarabel.ZeroConeT(1)]
        q = np.append(np.zeros(n), -np.ones(m))
        zero = sparse.csc_matrix((n + m, n + m))
        found = clarabel.DefaultSolver(zero, q, rows_of, np.append(bounds, 0), cones, settings).solve().obj_val
    assert proof.objective - proof.gap <= found * (1 + 1e-6) + 1e-12
    assert found == pytest.approx(proof.objective, rel=1e-5)


def value(points, at):
    """h/ℓ, d/ℓ or (h_r − h_s)/(2ℓ) of the plane: coefficients of the weights, and the rest."""
    if at.kind == "dual":
        (left, one), (right, other) = (
            value(points, temper.types.WeightConstraint("height", *corners))
            for corners in ((at.p, at.q, at.r), (at.q, at.p, at.s))
        )
        both = {v: (left.get(v, 0) - right.get(v, 0)) / 2 for v in {**left, **right}}
        return both, (one - other) / 2
    p, q = points[at.p], points[at.q]
    l2 = (q - p) @ (q - p)
    if at.kind == "crossing":
        return {at.p: 0.5 / l2, at.q: -0.5 / l2}, 0.5
    r = points[at.r]
    twice_area = (q - p)[0] * (r - p)[1] - (q - p)[1] * (r - p)[0]
    dp, dq, dr = (q - p) @ (r - p), (p - q) @ (r - q), (p - r) @ (q - r)
    scale = 0.5 / (twice_area * l2)
    return {at.p: scale * dq, at.q: scale * dp, at.r: -scale * l2}, scale * l2 * dr
