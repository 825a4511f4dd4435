/** The environments to choose from, as pictures. */
import type { Api, EnvironmentEntry } from "./api";
import { make, setText } from "./dom";
import type { Session } from "./session";

export class EnvironmentList {
    private entries: EnvironmentEntry[] = [];
    private readonly buttons = new Map<string, HTMLButtonElement>();
    /** Raised when an upload replaces a picture that the browser has in its cache. */
    private version = 0;

    constructor(
        private readonly root: HTMLElement,
        private readonly api: Api,
        private readonly session: Session,
    ) {
        session.stateChanged.listen(() => this.mark());
        session.statusChanged.listen(() => this.mark());
    }

    get names(): string[] {
        return this.entries.map((entry) => entry.name);
    }

    show(entries: EnvironmentEntry[], replaced = false): void {
        if (replaced) ++this.version;
        this.entries = entries;
        this.buttons.clear();
        this.root.replaceChildren(...entries.map((entry) => this.makeItem(entry)));
        this.mark();
    }

    choose(name: string): void {
        this.session.edit({ environment: { name } });
    }

    /** The one after the current (or before it, with −1), round and round. */
    step(by: number): void {
        const { names } = this;
        const current = names.indexOf(this.session.state?.environment.name ?? "");
        const next = names[(current + by + names.length) % names.length];
        if (next !== undefined) this.choose(next);
    }

    private makeItem(entry: EnvironmentEntry): HTMLElement {
        const picture = make("img", "environment-picture", {
            src: `${this.api.previewAddress(entry.name)}?v=${this.version}`,
            alt: "",
            loading: "lazy",
            draggable: "false",
            width: "256",
            height: "128",
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
        return make("li", "", {}, button);
    }

    private mark(): void {
        const { state } = this.session;
        const other = state?.blend.name ?? null;
        for (const [name, button] of this.buttons) {
            button.setAttribute("aria-pressed", String(name === state?.environment.name));
            button.disabled = this.session.status.kind !== "open";
            const blend = button.querySelector(".environment-blend");
            if (blend === null) continue;
            const amount = Math.round(100 * (state?.blend.amount ?? 0));
            setText(blend, name === other ? `+${amount} %` : "");
        }
    }
}
