#!/usr/bin/env python3
"""CPU seconds of temper's interior point method and of other solvers for the best weights, against the number of vertices.

    bench/weights_solvers.py [--limit SECONDS] MESH ...

Needs the Python module of temper, SciPy, and of highspy, osqp and clarabel those that are to be compared. They get the
program that temper solves: the same rows, the same squares, one weight at zero. `temper` is find_weights() as a whole,
with its proof. `over` is the relative difference of a solver's objective from temper's, and `lacking` the most by which
its weights miss a constraint. A solver that needs more than the limit is stopped, and gets no further mesh for this mode.
"""

import argparse
import multiprocessing
import time

import numpy as np
import scipy.sparse as sparse

import temper

KINDS = ("crossing", "height", "dual")


def forms(points, constraints):
    """h/l, d/l and (h_r - h_s)/(2l) in the plane: a matrix by the weights, and constants."""
    corners = np.array([(c.p, c.q, c.r, c.s) for c in constraints])
    kinds = np.array([KINDS.index(c.kind) for c in constraints])
    matrix = sparse.csr_matrix((len(kinds), len(points)))
    constants = np.zeros(len(kinds))

    def add(rows, vertices, values):
        nonlocal matrix
        for v, x in zip(vertices, values):
            matrix = matrix + sparse.csr_matrix((x, (rows, v)), matrix.shape)

    def height(rows, p, q, r, factor):
        a, b, c = points[q] - points[p], points[r] - points[p], points[r] - points[q]
        l2, area = (a * a).sum(1), a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        scale = factor * 0.5 / area
        add(rows, (p, q, r), (-scale * (a * c).sum(1) / l2, scale * (a * b).sum(1) / l2, -scale))
        constants[rows] += scale * (b * c).sum(1)

    rows = np.flatnonzero(kinds == 0)
    p, q = corners[rows, 0], corners[rows, 1]
    l2 = ((points[q] - points[p]) ** 2).sum(1)
    add(rows, (p, q), (0.5 / l2, -0.5 / l2))
    constants[rows] += 0.5
    rows = np.flatnonzero(kinds == 1)
    height(rows, *corners[rows, :3].T, 1.0)
    rows = np.flatnonzero(kinds == 2)
    p, q, r, s = corners[rows].T
    height(rows, p, q, r, 0.5)
    height(rows, q, p, s, -0.5)
    return matrix.tocsc(), constants


class Problem:
    """Weights in units of the mean squared edge, without the first."""

    def __init__(self, mesh, proof):
        points = np.asarray(mesh.points)
        unit = np.mean(((points[mesh.edges[:, 0]] - points[mesh.edges[:, 1]]) ** 2).sum(1))
        rows, constants = forms(points, [c for c, _ in proof.terms])
        self.rows, self.constants = (unit * rows[:, 1:]).tocsc(), constants - proof.margin
        self.accuracy = proof.goal == "accuracy"
        if self.accuracy:
            squares, offsets = forms(points, [t.at for t in proof.offsets])
            offsets = offsets - np.array([t.target for t in proof.offsets])
            factors = np.array([t.factor for t in proof.offsets])
            self.scale = factors.sum()
            weighted = sparse.diags(factors / self.scale) @ (unit * squares[:, 1:])
            self.p = (2 * (unit * squares[:, 1:]).T @ weighted).tocsc()
            self.q, self.rest = 2 * weighted.T @ offsets, factors / self.scale @ offsets**2

    def objective(self, x):
        if self.accuracy:
            return self.scale * (0.5 * x @ (self.p @ x) + self.q @ x + self.rest)
        slack = self.rows @ x + self.constants
        return -np.log(slack).sum() if slack.min() > 0 else np.inf


def by_clarabel(problem):
    import clarabel

    settings = clarabel.DefaultSettings()
    settings.verbose = False
    m, n = problem.rows.shape
    if problem.accuracy:
        cones = [clarabel.NonnegativeConeT(m)]
        p, q, a, b = sparse.triu(problem.p).tocsc(), problem.q, -problem.rows, problem.constants
    else:  # t <= ln s: rows (t, 1, s) of exponential cones
        index = np.arange(m)
        top = sparse.csc_matrix((-np.ones(m), (3 * index, index)), (3 * m, m))
        spread = sparse.csc_matrix((np.ones(m), (3 * index + 2, index)), (3 * m, m))
        a = sparse.hstack([-(spread @ problem.rows), top]).tocsc()
        b = np.zeros(3 * m)
        b[1::3], b[2::3] = 1, problem.constants
        cones = [clarabel.ExponentialConeT()] * m
        p, q = sparse.csc_matrix((n + m, n + m)), np.append(np.zeros(n), -np.ones(m))
    return np.array(clarabel.DefaultSolver(p, q, a.tocsc(), b, cones, settings).solve().x)[:n]


def by_osqp(problem):
    import osqp

    solver = osqp.OSQP()
    solver.setup(sparse.triu(problem.p).tocsc(), problem.q, problem.rows, -problem.constants,
                 np.full(len(problem.constants), np.inf), verbose=False, eps_abs=1e-9, eps_rel=1e-9, max_iter=100000)
    return solver.solve().x


def by_highs(problem):
    import highspy

    highs = highspy.Highs()
    highs.setOptionValue("output_flag", False)
    m, n = problem.rows.shape
    model = highspy.HighsModel()
    model.lp_.num_col_, model.lp_.num_row_ = n, m
    model.lp_.col_cost_ = problem.q
    model.lp_.col_lower_, model.lp_.col_upper_ = np.full(n, -highspy.kHighsInf), np.full(n, highspy.kHighsInf)
    model.lp_.row_lower_, model.lp_.row_upper_ = -problem.constants, np.full(m, highspy.kHighsInf)
    model.lp_.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    for name, matrix, target in (("a", problem.rows, model.lp_.a_matrix_), ("q", sparse.tril(problem.p).tocsc(), model.hessian_)):
        target.start_, target.index_, target.value_ = matrix.indptr, matrix.indices, matrix.data
    model.hessian_.dim_ = n
    highs.passModel(model)
    highs.run()
    return np.array(highs.getSolution().col_value)


SOLVERS = {"clarabel": by_clarabel, "osqp": by_osqp, "highs": by_highs}


def timed(solve, problem, answers):
    start = time.process_time()
    x = solve(problem)
    answers.put((time.process_time() - start, x))


def with_limit(solve, problem, limit):
    """Seconds and weights, or nothing if the solver needs more than the limit or fails."""
    answers = multiprocessing.Queue()
    process = multiprocessing.Process(target=timed, args=(solve, problem, answers))
    process.start()
    try:
        return answers.get(timeout=limit)
    except Exception:
        return None
    finally:
        process.terminate()
        process.join()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--limit", type=float, default=300)
    options = parser.parse_args()
    print("| vertices | mode | solver | CPU seconds | over | lacking |\n|-|-|-|-|-|-|")
    stopped = set()
    for path in options.meshes:
        mesh = temper.read(path)
        for goal in ("center", "accuracy"):
            start = time.process_time()
            proof = temper.find_weights(mesh, goal=goal).optimality
            print(f"| {len(mesh.points)} | {goal} | temper | {time.process_time() - start:.2f} | "
                  f"gap {proof.relative_gap:.0e} | 0 |", flush=True)
            problem = Problem(mesh, proof)
            for name, solve in SOLVERS.items():
                if (goal == "center" and name != "clarabel") or (goal, name) in stopped:
                    continue
                answer = with_limit(solve, problem, options.limit)
                row = f"| {len(mesh.points)} | {goal} | {name} | "
                if answer is None:
                    stopped.add((goal, name))
                    print(row + f"more than {options.limit:g} | | |", flush=True)
                    continue
                seconds, x = answer
                over = (problem.objective(x) - proof.objective) / abs(proof.objective)
                lacking = max(0.0, -(problem.rows @ x + problem.constants).min())
                print(row + f"{seconds:.2f} | {over:.0e} | {lacking:.0e} |", flush=True)


if __name__ == "__main__":
    main()
