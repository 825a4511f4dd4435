/** The connection in words, with a countdown and a way to try at once. */
import { byId, setText } from "./dom";
import type { RoomConnection, ConnectionStatus } from "./room_connection";

export class StatusLine {
    private readonly line = byId("status");
    private readonly words = byId("status-words");
    private readonly retry = byId<HTMLButtonElement>("status-retry");
    private readonly veil = byId("stage-veil");
    private clock = 0;

    constructor(connection: RoomConnection) {
        this.retry.addEventListener("click", () => connection.retryNow());
        connection.statusChanged.listen((status) => this.show(status));
        this.show(connection.status);
    }

    private show(status: ConnectionStatus): void {
        clearInterval(this.clock);
        this.line.dataset["kind"] = status.kind;
        this.retry.hidden = status.kind !== "waiting";
        this.veil.hidden = status.kind === "open";
        if (status.kind === "waiting") {
            this.clock = window.setInterval(() => this.count(status), 250);
            this.count(status);
        } else {
            setText(this.words, status.words);
        }
        setText(this.veil, status.kind === "open" ? "" : status.words);
    }

    private count(status: Extract<ConnectionStatus, { kind: "waiting" }>): void {
        const seconds = Math.max(0, Math.ceil((status.retryAt - performance.now()) / 1000));
        setText(this.words, `${status.words}. Trying again in ${seconds} s`);
    }
}
