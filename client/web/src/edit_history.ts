/**
 * The way back through this page's edits of entries of one section: materials, or finishes. A drag
 * is one step. Undoing is an edit like any other, so that everybody in the room sees it.
 */
import { Signal } from "./signal";

/** null is as baked. */
interface Step<Entry> {
    id: string;
    edit: Entry | null;
}

const kMostSteps = 100;

export class EditHistory<Entry> {
    readonly changed = new Signal<void>();
    private readonly past: Step<Entry>[] = [];
    private readonly future: Step<Entry>[] = [];
    private isOpen = false;

    constructor(
        private readonly now: (id: string) => Entry | null,
        private readonly restore: (id: string, edit: Entry | null) => void,
    ) {}

    get canUndo(): boolean {
        return this.past.length > 0;
    }

    get canRedo(): boolean {
        return this.future.length > 0;
    }

    /** What an entry was before the latest step; undefined where that was another's. */
    before(id: string): Entry | null | undefined {
        const latest = this.past[this.past.length - 1];
        return latest?.id === id ? latest.edit : undefined;
    }

    /** Before an edit: what follows until `end` is one step. */
    begin(id: string | null): void {
        if (this.isOpen || id === null) return;
        this.isOpen = true;
        this.past.push({ id, edit: this.now(id) });
        if (this.past.length > kMostSteps) this.past.shift();
        this.future.length = 0;
        this.changed.send();
    }

    end(): void {
        this.isOpen = false;
    }

    undo(): void {
        this.step(this.past, this.future);
    }

    redo(): void {
        this.step(this.future, this.past);
    }

    forget(): void {
        this.isOpen = false;
        this.past.length = 0;
        this.future.length = 0;
        this.changed.send();
    }

    private step(from: Step<Entry>[], to: Step<Entry>[]): void {
        this.end();
        const step = from.pop();
        if (step === undefined) return;
        to.push({ id: step.id, edit: this.now(step.id) });
        this.restore(step.id, step.edit);
        this.changed.send();
    }
}
