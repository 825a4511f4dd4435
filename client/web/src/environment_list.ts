/** The environments to choose from, as pictures. */
import type { EnvironmentEntry } from "./api";
import { make, setText } from "./dom";
import { environmentScale } from "./light_picture";
import type { PreviewStore } from "./preview_store";
import type { RoomConnection } from "./room_connection";
import type { RoomState } from "./wire/state";

export class EnvironmentList {
    private entries: EnvironmentEntry[] = [];
    private readonly buttons = new Map<string, HTMLButtonElement>();

    constructor(
        private readonly root: HTMLElement,
        private readonly previews: PreviewStore,
        private readonly connection: RoomConnection,
    ) {
        connection.stateChanged.listen(() => this.mark());
        connection.statusChanged.listen(() => this.mark());
        previews.loaded.listen((name) => this.drawPicture(name));
    }

    get names(): string[] {
        return this.entries.map((entry) => entry.name);
    }

    show(entries: EnvironmentEntry[]): void {
        this.entries = entries;
        this.buttons.clear();
        this.root.replaceChildren(...entries.map((entry) => this.makeItem(entry)));
        this.mark();
    }

    choose(name: string): void {
        this.connection.edit({ environment: { name } });
    }

    /** The one after the current (or before it, with −1), round and round. */
    step(by: number): void {
        const { names } = this;
        const current = names.indexOf(this.connection.state?.environment.name ?? "");
        const next = names[(current + by + names.length) % names.length];
        if (next !== undefined) this.choose(next);
    }

    private makeItem(entry: EnvironmentEntry): HTMLElement {
        const picture = make("canvas", "environment-picture", {
            width: "256",
            height: "128",
            "aria-hidden": "true",
        });
        const blend = make("span", "environment-blend", { "aria-hidden": "true" });
        const button = make(
            "button",
            "environment",
            { type: "button", title: `${entry.name}, ${entry.width} × ${entry.height}` },
            picture,
            make("span", "environment-name", {}, entry.name),
            blend,
        );
        if (entry.kind === "upload") {
            button.append(make("span", "environment-kind", {}, entry.kind));
        }
        button.addEventListener("click", () => this.choose(entry.name));
        this.buttons.set(entry.name, button);
        this.drawPicture(entry.name);
        return make("li", "", {}, button);
    }

    /** Nothing where the picture is not there yet: it is drawn when it comes. */
    private drawPicture(name: string): void {
        const canvas = this.buttons.get(name)?.querySelector("canvas");
        const pixels = this.previews.get(name);
        if (!canvas || pixels === null) return;
        canvas.width = pixels.width;
        canvas.height = pixels.height;
        canvas.getContext("2d")?.putImageData(pixels, 0, 0);
    }

    private mark(): void {
        const { state } = this.connection;
        const other = state?.blend.name ?? null;
        for (const [name, button] of this.buttons) {
            button.setAttribute("aria-pressed", String(name === state?.environment.name));
            button.disabled = this.connection.status.kind !== "open";
            const isOn = state !== null && environmentScale(state).some((part) => part > 0);
            button.classList.toggle("environment-dark", !isOn && isUsed(name, state));
            const blend = button.querySelector(".environment-blend");
            if (blend === null) continue;
            const amount = Math.round(100 * (state?.blend.amount ?? 0));
            setText(blend, name === other ? `+${amount} %` : "");
        }
    }
}

function isUsed(name: string, state: RoomState | null): boolean {
    return state?.environment.name === name || state?.blend.name === name;
}
