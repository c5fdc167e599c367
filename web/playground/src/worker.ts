// The run, apart from the page, which stays quick meanwhile and ends the worker to stop it: so the mesh is shown, and
// kept by the page, after sweeps, a few times a second.
import { optimize, type Snapshot, type TraceEvent } from 'temper-mesh';
import { arraysOf, meshOf } from './arrays.ts';
import type { Start, Told } from './messages.ts';

const kInterval = 100; // ms between pictures
const kMostEvents = 200_000; // as many as are worth stepping through

const tell = (told: Told): void => postMessage(told);

onmessage = ({ data }: MessageEvent<Start>): void => {
  try {
    const mesh = meshOf(data.mesh);
    const events: TraceEvent[] = [];
    let last = 0;
    let seen: Snapshot | null = null;
    const report = optimize(mesh, {
      ...data.options,
      tracer: data.traced ? (event) => void (events.length < kMostEvents && events.push(event)) : undefined,
      snapshots: (snapshot) => {
        seen?.mesh.free();
        seen = snapshot;
      },
      observer: (progress) => {
        if (performance.now() - last < kInterval) return;
        last = performance.now();
        tell({ kind: 'progress', progress, mesh: seen && arraysOf(seen.mesh) });
      },
    });
    tell({ kind: 'done', mesh: arraysOf(mesh), report, events: events.length < kMostEvents ? events : [] });
  } catch (error) {
    tell({ kind: 'failed', message: error instanceof Error ? error.message : String(error) });
  }
};

tell({ kind: 'ready' });
