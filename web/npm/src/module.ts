// The WebAssembly module: how it is started and called. Its functions take numbers and addresses, and leave in one buffer
// what they have to say (web/wasm/answer.hpp).
import { Directory, File, type Inode, PreopenDirectory, WASI } from '@bjorn3/browser_wasi_shim';
import type { Solver } from './solver.ts';

/** Bad input, told to a person: `where: message`, in the words of the library. */
export class TemperError extends Error {
  override name = 'TemperError';
  constructor(
    /** "duplicate_point", "syntax", …: stable across versions. */
    readonly code: string,
    /** "coast.msh:41", or empty when the input came as arrays. */
    readonly where: string,
    message: string,
  ) {
    super(where ? `${where}: ${message}` : message);
  }
}

/** Files by their names. */
export type Files = Record<string, Uint8Array>;

/** Where files are when they are not in memory: of Node. */
export interface Disk {
  read(path: string): Uint8Array | 'folder' | null;
  write(path: string, bytes: Uint8Array): void;
}

type Argument = number | string | null | Float64Array | Int32Array;
type Exports = { memory: WebAssembly.Memory } & Record<string, (...args: number[]) => number>;

/** Who hears of a run. What they throw is thrown on when the run has ended. */
export interface Listener {
  explained?(done: number, all: number): boolean;
  progress?(progress: string): boolean;
  trace?(event: string): void;
  snapshot?(handle: number, sweep: number): void;
}

let wasm: Exports | null = null;
let disk: Disk | null = null;
let listener: Listener = {};
let solver: Solver | null = null;
let thrown: { error: unknown } | null = null;

function fileOf(bytes: Uint8Array): File {
  const file = new File([]);
  file.data = bytes as Uint8Array<ArrayBuffer>;
  return file;
}

/** The folder that the module sees: given files, or those of the disk, which are read when they are looked for. */
class Folder extends Map<string, Inode> {
  onDisk = false;
  prefix = '';

  override get(name: string): Inode | undefined {
    const known = super.get(name);
    if (known || !this.onDisk) return known;
    const found = disk?.read(this.prefix + name);
    if (!found) return undefined;
    const entry = found === 'folder' ? new Directory([]) : fileOf(found);
    super.set(name, entry);
    return entry;
  }
}
const folder = new Folder();

export async function start(source: WebAssembly.Module | Promise<WebAssembly.Module>, files: Disk | null): Promise<void> {
  disk = files;
  const root = new PreopenDirectory('/', new Map<string, Inode>());
  root.dir.contents = folder;
  const wasi = new WASI([], [], [new Directory([]) as never, new Directory([]) as never, new Directory([]) as never, root], { debug: false });
  const instance = await WebAssembly.instantiate(await source, {
    wasi_snapshot_preview1: wasi.wasiImport,
    temper: {
      progress: (at: number, size: number): number => heard(() => listener.progress?.(textAt(at, size)) ?? true) ? 1 : 0,
      trace: (at: number, size: number): void => {
        heard(() => {
          listener.trace?.(textAt(at, size));
          return true;
        });
      },
      snapshot: (handle: number, sweep: number): void => {
        heard(() => {
          listener.snapshot?.(handle, sweep);
          return true;
        });
      },
      explained: (done: number, all: number): number => (heard(() => listener.explained?.(done, all) ?? true) ? 1 : 0),
      solve_lp: solveProgram,
    },
  });
  wasi.initialize(instance as Parameters<typeof wasi.initialize>[0]);
  wasm = instance.exports as Exports;
}

/** Who solves the module's linear programs from now on. */
export function useSolver(by: Solver): void {
  solver = by;
}

const kStatuses = ['optimal', 'infeasible', 'unbounded', 'failed']; // as LpStatus has them

/** What the module asks for: arrays by their addresses, and where the answer goes. */
function solveProgram(
  columns: number, rows: number, entries: number, cost: number, columnLower: number, columnUpper: number, rowLower: number,
  rowUpper: number, rowStart: number, column: number, value: number, primal: number, dual: number,
): number {
  const { buffer } = module().memory;
  const reals = (at: number, size: number): Float64Array => new Float64Array(buffer, at, size);
  const whole = (at: number, size: number): Int32Array => new Int32Array(buffer, at, size);
  const program = {
    cost: reals(cost, columns),
    columnLower: reals(columnLower, columns),
    columnUpper: reals(columnUpper, columns),
    rowLower: reals(rowLower, rows),
    rowUpper: reals(rowUpper, rows),
    rowStart: whole(rowStart, rows + 1),
    column: whole(column, entries),
    value: reals(value, entries),
  };
  let status = 'failed';
  heard(() => {
    const solved = solver!(program);
    if (solved.status === 'optimal') {
      reals(primal, columns).set(solved.primal);
      reals(dual, rows).set(solved.dual);
    }
    status = solved.status;
    return true;
  });
  return kStatuses.indexOf(status);
}

/** Calls a listener; false when it has thrown, now or before. */
function heard(call: () => boolean): boolean {
  if (thrown) return false;
  try {
    return call();
  } catch (error) {
    thrown = { error };
    return false;
  }
}

export function module(): Exports {
  if (!wasm) throw new Error('temper: the module has not been started');
  return wasm;
}

const decoder = new TextDecoder();
const encoder = new TextEncoder();

function textAt(at: number, size: number): string {
  return decoder.decode(new Uint8Array(module().memory.buffer, at, size));
}

/** Bytes of the last answer: a copy. */
export function answerBytes(): Uint8Array<ArrayBuffer> {
  const { memory, answer_data, answer_size } = module();
  const at = answer_data();
  return new Uint8Array(memory.buffer.slice(at, at + answer_size()) as ArrayBuffer);
}
export function answerText(): string {
  return textAt(module().answer_data(), module().answer_size());
}

// Numbers that JSON has not, as the module and this side mark them.
const kMark = '\u0001';
export function fromJson(text: string): unknown {
  return JSON.parse(text, (_key, value: unknown) =>
    typeof value === 'string' && value.startsWith(kMark) ? Number(value.slice(1)) : value,
  );
}
export function toJson(value: unknown): string {
  return JSON.stringify(value, (_key, v: unknown) => {
    if (typeof v === 'number' && !Number.isFinite(v)) return kMark + String(v);
    return ArrayBuffer.isView(v) ? Array.from(v as unknown as ArrayLike<number>) : v;
  });
}
export function answer<T>(): T {
  return fromJson(answerText()) as T;
}

function failure(): Error {
  const { code, where, message } = answer<{ code: string; where: string; message: string }>();
  if (code === 'type') return new TypeError(message);
  return new TemperError(code, where, message);
}

/** A number that is not 0: an address, or that all went well. Else the error that the answer says is thrown. Texts go as
 * address and size, arrays as address. */
export function call(name: string, ...args: Argument[]): number {
  const { [name]: exported, allocate, release } = module();
  const taken: number[] = [];
  const put = (bytes: Uint8Array): number => {
    const at = allocate(bytes.byteLength);
    if (at === 0) throw new TemperError('memory', '', 'needs more memory than there is');
    taken.push(at);
    new Uint8Array(module().memory.buffer).set(bytes, at);
    return at;
  };
  const flat: number[] = [];
  try {
    for (const arg of args) {
      if (typeof arg === 'number') {
        flat.push(arg);
      } else if (arg === null) {
        flat.push(0);
      } else if (typeof arg === 'string') {
        const bytes = encoder.encode(arg);
        flat.push(put(bytes), bytes.byteLength);
      } else {
        flat.push(put(new Uint8Array(arg.buffer, arg.byteOffset, arg.byteLength)));
      }
    }
    const result = exported(...flat);
    if (result === 0) throw failure();
    return result;
  } finally {
    for (const at of taken) release(at);
  }
}

/** Runs a call that tells listeners. */
export function listening<T>(to: Listener, run: () => T): T {
  const outer = { listener, thrown };
  listener = to;
  thrown = null;
  // `thrown` is set by listeners, which the compiler does not see.
  const throwOn = (): void => {
    const seen = thrown as { error: unknown } | null;
    if (seen) throw seen.error;
  };
  try {
    const result = run();
    throwOn();
    return result;
  } catch (error) {
    throwOn(); // that a run was stopped is no news to who stopped it by an error
    throw error;
  } finally {
    listener = outer.listener;
    thrown = outer.thrown;
  }
}

/** Runs a call that reads or writes files: given ones, or without them those of the disk. `path` as the module has it. */
export function withFiles<T>(path: string, files: Files | undefined, run: (name: string) => T): T {
  if (!files && !disk) throw new TypeError('files: expected the files by their names: this platform has no disk to look at');
  const slash = files ? -1 : path.lastIndexOf('/');
  folder.clear();
  folder.onDisk = !files;
  folder.prefix = path.slice(0, slash + 1);
  for (const [name, bytes] of Object.entries(files ?? {})) folder.set(name, fileOf(bytes));
  try {
    return run(path.slice(slash + 1));
  } catch (error) {
    // The module has seen the name alone.
    if (error instanceof TemperError && folder.prefix && error.where) {
      throw new TemperError(error.code, folder.prefix + error.where, error.message.slice(error.where.length + 2));
    }
    throw error;
  } finally {
    folder.clear();
    folder.onDisk = false;
  }
}

/** Takes what the module has written there to where it belongs. */
export function takeWritten(names: readonly string[], files: Files | undefined): string[] {
  const written: string[] = [];
  for (const name of names) {
    const file = folder.onDisk ? Map.prototype.get.call(folder, name) : folder.get(name);
    if (!(file instanceof File)) {
      if (files) delete files[name];
      continue;
    }
    if (files) files[name] = file.data;
    else disk?.write(folder.prefix + name, file.data);
    written.push(folder.prefix + name);
  }
  return written;
}
