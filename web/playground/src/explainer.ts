// Why the triangles of the mesh are bad, by a worker of its own; the answer is kept until the mesh changes.
import type { Explanation } from 'temper-mesh';
import { Helper } from './helper.ts';
import type { Arrays, Told } from './messages.ts';

const kCures = 50; // reasons whose cures are searched: a second or so

export class Explainer {
  /** Of the mesh as it is; null: not there yet. */
  explanation: Explanation | null = null;
  /** What the worker says meanwhile, and in the end when it fails. */
  said = '';
  private helper: Helper | null = null;
  private busy = false;

  constructor(private readonly changed: () => void) {}

  /** Begins to explain a mesh, unless that has been done. */
  ask(mesh: () => Arrays): void {
    if (this.busy || this.explanation || this.said) return;
    this.busy = true;
    this.say('looks for reasons and cures');
    this.helper ??= new Helper((told) => this.hear(told), (message) => this.end(null, message));
    void this.helper.post({ kind: 'explain', mesh: mesh(), cures: kCures });
  }

  /** The mesh is another one. */
  forget(): void {
    if (this.busy) {
      this.helper?.end();
      this.helper = null;
    }
    this.busy = false;
    this.explanation = null;
    this.said = '';
  }

  private hear(told: Told): void {
    if (told.kind === 'explaining') this.say(`explained ${told.done} of ${told.all} triangles`);
    else if (told.kind === 'explained') this.end(told.explanation, '');
    else if (told.kind === 'failed') this.end(null, told.message);
  }

  private end(explanation: Explanation | null, said: string): void {
    this.busy = false;
    this.explanation = explanation;
    this.say(said);
  }

  private say(text: string): void {
    this.said = text;
    this.changed();
  }
}
