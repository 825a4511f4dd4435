/**
 * The room's state as this page should show it: what the server has confirmed, with this page's
 * own edits that are still on their way laid over it, so that a control never jumps back under
 * the hand that moves it.
 */
import { applyPatch, composePatches } from "./wire/merge_patch";
import { sameJson } from "./wire/same_json";
import type { Change, Snapshot } from "./wire/message";
import { makesAnotherImage } from "./wire/stages";
import type { Json, JsonObject, RoomState } from "./wire/state";

interface PendingEdit {
    id: number;
    patch: JsonObject;
}

export class SharedState {
    private confirmed: RoomState;
    private pending: PendingEdit[] = [];
    private queued: JsonObject | null = null;
    private cached: RoomState;
    revision: number;
    /** The last revision that made another image: not of display or policy alone. */
    imageRevision: number;

    constructor(snapshot: Snapshot) {
        this.confirmed = snapshot.state;
        this.cached = snapshot.state;
        this.revision = snapshot.revision;
        this.imageRevision = snapshot.revision;
    }

    get state(): RoomState {
        return this.cached;
    }

    /**
     * The room that `snapshot` is of does not go on from what this page knew of it: its
     * revisions began anew.
     */
    isForgottenBy({ revision, state }: Snapshot): boolean {
        if (revision !== this.revision) return revision < this.revision;
        return !sameJson(state as unknown as Json, this.confirmed as unknown as Json);
    }

    /** Edits that are not sent, or not yet confirmed. */
    get hasPending(): boolean {
        return this.queued !== null || this.pending.length > 0;
    }

    /** One of those makes another image. */
    get awaitsImage(): boolean {
        const patches = this.pending.map(({ patch }) => patch);
        if (this.queued !== null) patches.push(this.queued);
        return patches.some(makesAnotherImage);
    }

    /** An edit that waits to be sent. */
    queue(patch: JsonObject): void {
        this.queued = this.queued === null ? patch : composePatches(this.queued, patch);
        this.cached = patched(this.cached, patch);
    }

    /** All that was queued has been sent as `patch`. */
    expect(id: number, patch: JsonObject): void {
        this.queued = null;
        this.pending.push({ id, patch });
    }

    /** Edits taken together come back as one change with the last one's id. */
    confirm(change: Change): void {
        this.confirmed = patched(this.confirmed, change.patch);
        this.revision = change.revision;
        if (makesAnotherImage(change.patch)) this.imageRevision = change.revision;
        const id = change.edit_id;
        if (id !== undefined) this.pending = this.pending.filter((edit) => edit.id > id);
        this.overlay();
    }

    refuse(id: number): void {
        this.pending = this.pending.filter((edit) => edit.id !== id);
        this.overlay();
    }

    private overlay(): void {
        this.cached = this.pending.reduce(
            (state, edit) => patched(state, edit.patch),
            this.confirmed,
        );
        if (this.queued !== null) this.cached = patched(this.cached, this.queued);
    }
}

function patched(state: RoomState, patch: JsonObject): RoomState {
    return applyPatch(state as unknown as Json, patch) as unknown as RoomState;
}
