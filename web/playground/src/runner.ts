// The worker as the page sees it: a run that can be stopped, one after the other.
import type { OptimizeReport, Progress, TraceEvent } from 'temper-mesh';
import { Helper } from './helper.ts';
import type { Arrays, Start, Told } from './messages.ts';

export interface Ended {
  mesh: Arrays | null;
  report: OptimizeReport | null;
  events: TraceEvent[];
  error: string | null;
}

export class Runner {
  private helper: Helper | null = null;
  private onEnd: ((ended: Ended) => void) | null = null;
  private onProgress: (progress: Progress, mesh: Arrays | null) => void = () => undefined;
  private last: Arrays | null = null;

  get running(): boolean {
    return this.onEnd !== null;
  }

  /** Starts the worker before it is needed. */
  warm(): Helper {
    return (this.helper ??= new Helper((told) => this.hear(told), (message) => {
      this.renew();
      this.finish({ mesh: this.last, report: null, events: [], error: message });
    }));
  }

  /** Ends with the result, or when it was stopped with the mesh that was last seen, if any. */
  run(start: Start, onProgress: (progress: Progress, mesh: Arrays | null) => void): Promise<Ended> {
    this.last = null;
    this.onProgress = onProgress;
    return new Promise((resolve) => {
      this.onEnd = resolve;
      void this.warm().post(start);
    });
  }

  /** The run is over at once: its worker is ended, and there is a new one. */
  stop(): void {
    if (!this.running) return;
    this.renew();
    this.finish({ mesh: this.last, report: null, events: [], error: null });
  }

  private hear(told: Told): void {
    if (told.kind === 'progress') {
      this.last = told.mesh ?? this.last;
      this.onProgress(told.progress, told.mesh);
    } else if (told.kind === 'done') {
      this.finish({ mesh: told.mesh, report: told.report, events: told.events, error: null });
    } else if (told.kind === 'failed') {
      this.finish({ mesh: null, report: null, events: [], error: told.message });
    }
  }

  private finish(ended: Ended): void {
    const end = this.onEnd;
    this.onEnd = null;
    end?.(ended);
  }

  private renew(): void {
    this.helper?.end();
    this.helper = null;
    this.warm();
  }
}
