// The mesh of the page with its past, and the trace of its last run.
import { type Files, type Mesh, type OptimizeReport, read, replay, restore_regularity, type TraceEvent } from 'temper-mesh';
import { meshOf } from './arrays.ts';
import type { Arrays } from './messages.ts';

const kPast = 50; // states that undo goes back to

export class Session {
  private past: Mesh[] = [];
  /** The events of the last run, and the mesh before them. */
  trace: { input: Mesh; events: TraceEvent[] } | null = null;
  /** The last run, while the mesh is its result, and the mesh before it. */
  run: { before: Mesh; report: OptimizeReport } | null = null;

  constructor(
    public mesh: Mesh,
    public name: string,
  ) {}

  /** The mesh of files that were dropped together: the one that can be read, with those beside it. */
  static open(files: Files): Session {
    const names = Object.keys(files);
    let first: unknown = null;
    for (const name of names) {
      try {
        return new Session(read(name, { files }), name);
      } catch (error) {
        first ??= error;
      }
    }
    throw first ?? new Error('there is no file');
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  /** Before a change that undo is to take back. */
  remember(): void {
    this.past.push(this.mesh.copy());
    if (this.past.length > kPast) this.past.shift()?.free();
  }
  forget(): void {
    this.past.pop()?.free();
  }
  undo(): void {
    const before = this.past.pop();
    if (!before) return;
    this.mesh = before;
    this.trace = null;
    this.run = null;
  }

  /** The result of a run takes the mesh's place. */
  take(arrays: Arrays, report: OptimizeReport | null, events: TraceEvent[]): void {
    const input = this.mesh.copy();
    this.mesh.replace(meshOf(arrays), report?.vertices ?? []);
    this.trace = events.length > 0 ? { input, events } : null;
    this.run = report && { before: input, report };
  }

  /** The mesh after so many events of the trace. */
  goTo(events: number): void {
    if (this.trace) this.mesh = replay(this.trace.input, this.trace.events.slice(0, events));
  }

  /** Puts a vertex elsewhere, and flips what the power diagram asks for. False: a triangle would turn over, and it stays. */
  place(vertex: number, x: number, y: number, w: number): boolean {
    try {
      this.mesh.set_point(vertex, x, y, w);
    } catch {
      return false;
    }
    restore_regularity(this.mesh);
    return true;
  }
}
