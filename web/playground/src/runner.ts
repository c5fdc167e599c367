// The worker as the page sees it: a run that can be stopped, one after the other.
import type { OptimizeReport, Progress, TraceEvent } from 'temper-mesh';
import type { Arrays, Start, Told } from './messages.ts';

export interface Ended {
  mesh: Arrays | null;
  report: OptimizeReport | null;
  events: TraceEvent[];
  error: string | null;
}

export class Runner {
  private worker: Worker | null = null;
  private end: ((ended: Ended) => void) | null = null;
  private last: Arrays | null = null;

  get running(): boolean {
    return this.end !== null;
  }

  /** Starts the worker before it is needed. */
  warm(): Worker {
    return (this.worker ??= new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
  }

  /** Ends with the result, or when it was stopped with the mesh that was last seen, if any. */
  run(start: Start, onProgress: (progress: Progress, mesh: Arrays | null) => void): Promise<Ended> {
    this.last = null;
    return new Promise((resolve) => {
      this.end = resolve;
      const worker = this.warm();
      worker.onmessage = ({ data }: MessageEvent<Told>): void => {
        if (data.kind === 'progress') {
          this.last = data.mesh ?? this.last;
          onProgress(data.progress, data.mesh);
        } else if (data.kind === 'done') {
          this.finish({ mesh: data.mesh, report: data.report, events: data.events, error: null });
        } else if (data.kind === 'failed') {
          this.finish({ mesh: null, report: null, events: [], error: data.message });
        }
      };
      worker.onerror = (event): void => {
        this.finish({ mesh: this.last, report: null, events: [], error: event.message || 'the run ended unexpectedly' });
        this.renew();
      };
      worker.postMessage(start);
    });
  }

  /** The run is over at once: its worker is ended, and there is a new one. */
  stop(): void {
    if (!this.running) return;
    this.renew();
    this.finish({ mesh: this.last, report: null, events: [], error: null });
  }

  private finish(ended: Ended): void {
    const end = this.end;
    this.end = null;
    end?.(ended);
  }

  private renew(): void {
    this.worker?.terminate();
    this.worker = null;
    this.warm();
  }
}
