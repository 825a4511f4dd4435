/**
 * Edits leave at most once per animation frame: everything asked for in between is merged into
 * one patch, so a pointer that reports a thousand moves a second costs sixty messages.
 */
import { composePatches } from "./wire/merge_patch";
import type { JsonObject } from "./wire/state";

/** The server allows 256 messages a second, acknowledgements included. */
const kShortestIntervalMilliseconds = 7;

export class EditQueue {
    private waiting: JsonObject | null = null;
    private frame = 0;
    private sentAt = -Infinity;

    /** `send` returns false when the connection cannot take the patch now. */
    constructor(private readonly send: (patch: JsonObject) => boolean) {}

    push(patch: JsonObject): void {
        this.waiting = this.waiting === null ? patch : composePatches(this.waiting, patch);
        if (this.frame === 0) this.frame = requestAnimationFrame((now) => this.flush(now));
    }

    /** What was not sent is forgotten: after a reconnect the server's state is the truth. */
    clear(): void {
        this.waiting = null;
        cancelAnimationFrame(this.frame);
        this.frame = 0;
    }

    private flush(now: number): void {
        this.frame = 0;
        if (this.waiting === null) return;
        if (now - this.sentAt >= kShortestIntervalMilliseconds && this.send(this.waiting)) {
            this.waiting = null;
            this.sentAt = now;
        } else {
            this.frame = requestAnimationFrame((later) => this.flush(later));
        }
    }
}
