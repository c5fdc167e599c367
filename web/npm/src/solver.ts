// Linear programs for the module: by HiGHS, another module, which is loaded when it is first asked for.
import type { Highs, Model, ModelData } from 'highs';
import { useSolver } from './module.ts';

/** A program as temper has it, by rows; see LpProblem in temper/feasibility.hpp. */
export interface Program {
  cost: Float64Array;
  columnLower: Float64Array;
  columnUpper: Float64Array;
  rowLower: Float64Array;
  rowUpper: Float64Array;
  rowStart: Int32Array;
  column: Int32Array;
  value: Float64Array;
}
export interface Solution {
  primal: Float64Array;
  dual: Float64Array;
}
/** What the module takes for LpStatus, in its order, and the solution when it is optimal. */
export type Solved = { status: 'infeasible' | 'unbounded' | 'failed' } | ({ status: 'optimal' } & Solution);
export type Solver = (program: Program) => Solved;

// As the native program asks of Clp; entries of a program may be small, and large where triangles are flat.
const kOptions = {
  output_flag: false,
  solver: 'simplex',
  primal_feasibility_tolerance: 1e-9,
  dual_feasibility_tolerance: 1e-9,
  small_matrix_value: 1e-12,
  large_matrix_value: 1e30,
  infinite_bound: 1e30,
};

// One way after the other until there is an answer.
type Way = { presolve: 'off' | 'on'; simplex_scale_strategy: number };
const kScaled = 2; // HiGHS's default
const kWays: Way[] = [
  { presolve: 'off', simplex_scale_strategy: kScaled },
  { presolve: 'on', simplex_scale_strategy: kScaled },
  { presolve: 'off', simplex_scale_strategy: 0 },
];

function attempt(highs: Highs, model: Model, data: ModelData, how: Way): Solved {
  const { modelStatus } = highs.constants;
  model.options.set(how); // before the program, which they judge
  model.passModel(data);
  model.run();
  switch (model.getModelStatus()) {
    case modelStatus.optimal: {
      const { colValue, rowDual } = model.getSolution();
      return { status: 'optimal', primal: colValue, dual: rowDual };
    }
    case modelStatus.infeasible:
      return { status: 'infeasible' };
    case modelStatus.unbounded:
      return { status: 'unbounded' };
    default:
      return { status: 'failed' };
  }
}

function dataOf(p: Program): ModelData {
  const numCols = p.cost.length, numRows = p.rowLower.length;
  return {
    numCols,
    numRows,
    colCost: p.cost,
    colLower: p.columnLower,
    colUpper: p.columnUpper,
    rowLower: p.rowLower,
    rowUpper: p.rowUpper,
    matrix: { format: 'csr', numRows, numCols, starts: p.rowStart, indices: p.column, values: p.value },
  };
}

function solverBy(highs: Highs): Solver {
  const model = highs.createModel(); // for good: to make one takes longer than a small program
  model.options.set(kOptions);
  return (program) => {
    const data = dataOf(program);
    for (const how of kWays) {
      const solved = attempt(highs, model, data, how);
      if (solved.status !== 'failed') return solved;
    }
    return { status: 'failed' };
  };
}

let loading: Promise<void> | null = null;

/** Ends when the module has its solver. */
export function loadSolver(): Promise<void> {
  loading ??= import('highs')
    .then(({ default: load }) => load())
    .then((highs) => useSolver(solverBy(highs)));
  loading.catch(() => (loading = null)); // it may be there the next time
  return loading;
}
