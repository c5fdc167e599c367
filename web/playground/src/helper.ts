// A worker of the page: what it is asked, once it listens, and what it tells.
import type { Ask, Start, Told } from './messages.ts';

export class Helper {
  private readonly worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  private readonly ready: Promise<void>;
  private ended = false;

  /** `hear` hears all that the worker tells; `fail`, that it has broken down. */
  constructor(hear: (told: Told) => void, fail: (message: string) => void) {
    // It waits for its module before it listens: what is posted earlier is lost.
    this.ready = new Promise((resolve) => {
      this.worker.onmessage = ({ data }: MessageEvent<Told>): void => {
        if (data.kind === 'ready') resolve();
        else hear(data);
      };
    });
    this.worker.onerror = (event): void => fail(event.message || 'the worker ended unexpectedly');
  }

  async post(message: Start | Ask): Promise<void> {
    await this.ready;
    if (!this.ended) this.worker.postMessage(message);
  }

  end(): void {
    this.ended = true;
    this.worker.terminate();
  }
}
