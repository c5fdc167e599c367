// Runs and explanations, apart from the page, which stays quick meanwhile and ends the worker to stop it: so the mesh is shown, and
// kept by the page, after sweeps, a few times a second.
import { explain, optimize, type Snapshot, type TraceEvent } from 'temper-mesh';
import { arraysOf, meshOf } from './arrays.ts';
import type { Ask, Start, Told } from './messages.ts';

const kInterval = 100; // ms between pictures
const kMostEvents = 200_000; // as many as are worth stepping through

const tell = (told: Told): void => postMessage(told);

function run({ mesh: arrays, given, traced }: Start): void {
  const mesh = meshOf(arrays);
  const events: TraceEvent[] = [];
  let last = 0;
  let seen: Snapshot | null = null;
  const report = optimize(mesh, {
    ...given,
    progress: (progress) => {
      if (performance.now() - last < kInterval) return;
      last = performance.now();
      tell({ kind: 'progress', progress, mesh: seen && arraysOf(seen.mesh) });
    },
    hooks: {
      tracer: traced ? (event) => void (events.length < kMostEvents && events.push(event)) : undefined,
      snapshots: (snapshot) => {
        seen?.mesh.free();
        seen = snapshot;
      },
    },
  });
  tell({ kind: 'done', mesh: arraysOf(mesh), report, events: events.length < kMostEvents ? events : [] });
}

async function why({ mesh: arrays, cures }: Ask): Promise<void> {
  const mesh = meshOf(arrays);
  let last = 0;
  const explanation = await explain(mesh, {
    cures,
    progress: (done, all) => {
      if (performance.now() - last < kInterval) return;
      last = performance.now();
      tell({ kind: 'explaining', done, all });
    },
  });
  mesh.free();
  tell({ kind: 'explained', explanation });
}

onmessage = async ({ data }: MessageEvent<Start | Ask>): Promise<void> => {
  try {
    if (data.kind === 'optimize') run(data);
    else await why(data);
  } catch (error) {
    tell({ kind: 'failed', message: error instanceof Error ? error.message : String(error) });
  }
};

tell({ kind: 'ready' });
