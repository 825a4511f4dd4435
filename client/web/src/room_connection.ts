/**
 * One place in a room: the WebSocket, the state, edits out, images in. Comes back by itself after
 * a lost connection; the server's snapshot then replaces what this page believed.
 */
import { Backoff } from "./backoff";
import { EditQueue } from "./edit_queue";
import { SharedState } from "./shared_state";
import { Signal } from "./signal";
import { closeMeaning } from "./wire/close_code";
import { messageFromText, type Refusal, type Snapshot, WireError } from "./wire/message";
import type { DisplayState, JsonObject, RoomState } from "./wire/state";

export type ConnectionStatus =
    | { kind: "connecting"; words: string }
    | { kind: "open"; words: string }
    | { kind: "waiting"; words: string; retryAt: number }
    | { kind: "refused"; words: string };

export interface Opening {
    snapshot: Snapshot;
    /** What this page showed last, where the server has since forgotten the room. */
    forgotten: RoomState | null;
}

/** Above this many unsent bytes, edits wait and go on merging. */
const kMostBufferedBytes = 64 * 1024;
const kPolicyClose = 4000;

export class RoomConnection {
    readonly statusChanged = new Signal<ConnectionStatus>();
    readonly opened = new Signal<Opening>();
    /** The state to show has changed: by the server or by an edit of this page. */
    readonly stateChanged = new Signal<RoomState>();
    /** The patch of an edit that the server has taken, of whoever made it. */
    readonly changed = new Signal<JsonObject>();
    readonly viewersChanged = new Signal<number>();
    readonly frameReceived = new Signal<ArrayBuffer>();
    readonly refused = new Signal<Refusal>();
    readonly editSent = new Signal<{ id: number; patch: JsonObject }>();
    readonly editConfirmed = new Signal<{ id: number; revision: number }>();
    readonly editDropped = new Signal<number>();

    status: ConnectionStatus = { kind: "connecting", words: "Connecting" };
    snapshot: Snapshot | null = null;

    private socket: WebSocket | null = null;
    private shared: SharedState | null = null;
    private readonly backoff = new Backoff();
    private readonly edits = new EditQueue((patch) => this.sendEdit(patch));
    private timer = 0;
    private nextEditId = 1;

    constructor(
        private readonly url: string,
        private readonly subprotocols: string[],
    ) {
        window.addEventListener("online", () => this.retryNow());
    }

    get state(): RoomState | null {
        return this.shared?.state ?? null;
    }

    get revision(): number {
        return this.shared?.revision ?? 0;
    }

    get imageRevision(): number {
        return this.shared?.imageRevision ?? 0;
    }

    /** An edit that makes another image is unsent or unconfirmed. */
    get awaitsImage(): boolean {
        return this.shared?.awaitsImage ?? false;
    }

    /** No edit of this page is unsent or unconfirmed. */
    get isSettled(): boolean {
        return this.shared !== null && !this.shared.hasPending;
    }

    /** Whether edits of a section are taken; an older server does not say, and takes all. */
    takes(section: keyof RoomState): boolean {
        return this.snapshot?.scene.edits?.includes(section) ?? true;
    }

    connect(): void {
        clearTimeout(this.timer);
        this.setStatus({ kind: "connecting", words: "Connecting" });
        const socket = new WebSocket(this.url, this.subprotocols);
        socket.binaryType = "arraybuffer";
        socket.onmessage = (event) => this.receive(socket, event.data as string | ArrayBuffer);
        socket.onclose = (event) => this.closed(socket, event);
        this.socket = socket;
    }

    retryNow(): void {
        if (this.status.kind === "waiting") this.connect();
    }

    /** Takes a merge patch of the state; it is shown at once and sent with the next frame. */
    edit(patch: JsonObject): void {
        if (this.status.kind !== "open") return;
        this.shared?.queue(patch);
        this.edits.push(patch);
        this.publishState();
    }

    /**
     * Resolves when every edit asked for so far is confirmed: to null, or to what refused one
     * meanwhile, or to "lost" where the connection ends first.
     */
    settled(): Promise<Refusal | "lost" | null> {
        return new Promise((resolve) => {
            let refusal: Refusal | null = null;
            const stops: (() => void)[] = [];
            const check = (): void => {
                const isLost = this.status.kind !== "open";
                if (!isLost && !this.isSettled) return;
                for (const stop of stops) stop();
                resolve(isLost ? "lost" : refusal);
            };
            stops.push(
                this.refused.listen((message) => {
                    if (message.edit_id !== undefined) refusal = message;
                    check();
                }),
                this.stateChanged.listen(check),
                this.statusChanged.listen(check),
            );
            check();
        });
    }

    acknowledge(sequence: number): void {
        this.sendText(JSON.stringify({ type: "ack", sequence }));
    }

    /** How this page's JPEGs are developed; null leaves it to the room. */
    chooseDisplay(display: DisplayState | null): void {
        const { exposure_stops, tone } = display ?? { exposure_stops: null, tone: null };
        this.sendText(JSON.stringify({ type: "display", exposure_stops, tone }));
    }

    private sendEdit(patch: JsonObject): boolean {
        if (this.socket === null || this.socket.bufferedAmount > kMostBufferedBytes)
            return false;
        const id = this.nextEditId++;
        this.shared?.expect(id, patch);
        this.editSent.send({ id, patch });
        this.sendText(JSON.stringify({ type: "edit", id, patch }));
        return true;
    }

    private sendText(text: string): void {
        if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
    }

    private receive(socket: WebSocket, data: string | ArrayBuffer): void {
        if (socket !== this.socket) return;
        try {
            if (typeof data === "string") this.receiveText(data);
            else this.frameReceived.send(data);
        } catch (error) {
            if (!(error instanceof WireError)) throw error;
            this.socket = null;
            socket.close(kPolicyClose, "not understood");
            this.leave({ kind: "refused", words: `Not understood: ${error.message}` });
        }
    }

    private receiveText(text: string): void {
        const message = messageFromText(text);
        if (message === null) return;
        if (message.type === "snapshot") {
            this.backoff.reset();
            const forgotten =
                this.shared !== null && this.shared.isForgottenBy(message)
                    ? this.shared.state
                    : null;
            this.snapshot = message;
            this.shared = new SharedState(message);
            this.setStatus({ kind: "open", words: "Connected" });
            this.opened.send({ snapshot: message, forgotten });
            this.viewersChanged.send(message.viewers);
            this.publishState();
        } else if (message.type === "change") {
            this.shared?.confirm(message);
            this.changed.send(message.patch);
            if (message.edit_id !== undefined) {
                this.editConfirmed.send({ id: message.edit_id, revision: message.revision });
            }
            this.publishState();
        } else if (message.type === "viewers") {
            this.viewersChanged.send(message.count);
        } else {
            if (message.edit_id !== undefined) {
                this.shared?.refuse(message.edit_id);
                this.editDropped.send(message.edit_id);
            }
            this.refused.send(message);
            if (message.edit_id !== undefined) this.publishState();
        }
    }

    private closed(socket: WebSocket, event: CloseEvent): void {
        if (socket !== this.socket) return;
        this.socket = null;
        const meaning = closeMeaning(event.code);
        const words =
            event.code === 1006 && this.snapshot === null
                ? "The server cannot be reached"
                : meaning.words;
        if (meaning.retry === "never") {
            this.leave({ kind: "refused", words });
            return;
        }
        const wait = meaning.retry === "later" ? this.backoff.later() : this.backoff.next();
        this.leave({ kind: "waiting", words, retryAt: performance.now() + wait });
        this.timer = window.setTimeout(() => this.connect(), wait);
    }

    private leave(status: ConnectionStatus): void {
        this.edits.clear();
        this.setStatus(status);
    }

    private publishState(): void {
        if (this.shared !== null) this.stateChanged.send(this.shared.state);
    }

    private setStatus(status: ConnectionStatus): void {
        this.status = status;
        this.statusChanged.send(status);
    }
}
