/**
 * Messages that come and go in a strip between image and readouts, beside the picture and never
 * on it. All expire, errors last; an offer stays until it is taken or dismissed. A message that
 * is said again is counted, not repeated.
 */
import { icon, make, setText } from "./dom";

export interface NoticeAction {
    words: string;
    run: () => void;
    /** The notice stays when this is chosen: what it offers may fail. */
    keeps?: boolean;
}

export interface Notice {
    tone: "error" | "warning" | "info";
    title: string;
    found?: string | undefined;
    expected?: string | undefined;
    details?: string[];
    actions?: NoticeAction[];
}

const kStayMilliseconds = { info: 6_000, warning: 14_000, error: 20_000 };
const kMostShown = 3;

interface Shown {
    key: string;
    item: HTMLElement;
    count: HTMLElement;
    times: number;
    offers: boolean;
    timer: number;
    tone: Notice["tone"];
}

export class Notices {
    private shown: Shown[] = [];

    constructor(private readonly list: HTMLElement) {}

    /** Returns the function that takes the notice away. */
    show(notice: Notice): () => void {
        const key = JSON.stringify([notice.tone, notice.title, notice.found, notice.expected]);
        const offers = (notice.actions?.length ?? 0) > 0;
        const known = this.shown.find((shown) => shown.key === key);
        if (known !== undefined && !offers) {
            setText(known.count, `× ${++known.times}`);
            this.expireLater(known);
            return () => this.remove(known);
        }
        const count = make("span", "notice-count");
        const close = make("button", "notice-close", {
            type: "button",
            "aria-label": "Dismiss",
        });
        close.append(icon("close"));
        const body = bodyOf(notice, count);
        const item = make(
            "div",
            `notice notice-${notice.tone}`,
            { role: notice.tone === "error" ? "alert" : "status" },
            body,
            close,
        );
        const shown: Shown = {
            key,
            item,
            count,
            times: 1,
            offers,
            timer: 0,
            tone: notice.tone,
        };
        body.append(...this.buttonsOf(notice, shown));
        close.addEventListener("click", () => this.remove(shown));
        // What is being read or reached for does not vanish.
        for (const type of ["pointerenter", "focusin"]) {
            item.addEventListener(type, () => clearTimeout(shown.timer));
        }
        for (const type of ["pointerleave", "focusout"]) {
            item.addEventListener(type, () => this.expireLater(shown));
        }
        this.list.append(item);
        this.shown.push(shown);
        this.expireLater(shown);
        while (this.shown.length > kMostShown) {
            this.remove(this.shown.find((other) => !other.offers) ?? this.shown[0]!);
        }
        return () => this.remove(shown);
    }

    private buttonsOf(notice: Notice, shown: Shown): HTMLElement[] {
        return (notice.actions ?? []).map((action) => {
            const button = make(
                "button",
                "small-button notice-action",
                { type: "button" },
                action.words,
            );
            button.addEventListener("click", () => {
                if (action.keeps !== true) this.remove(shown);
                action.run();
            });
            return button;
        });
    }

    private expireLater(shown: Shown): void {
        clearTimeout(shown.timer);
        if (shown.offers) return;
        shown.timer = window.setTimeout(
            () => this.remove(shown),
            kStayMilliseconds[shown.tone],
        );
    }

    private remove(shown: Shown): void {
        clearTimeout(shown.timer);
        shown.item.remove();
        this.shown = this.shown.filter((other) => other !== shown);
    }
}

function bodyOf(notice: Notice, count: HTMLElement): HTMLElement {
    const title = make("p", "notice-title", {}, notice.title, " ", count);
    const body = make("div", "notice-body", {}, title);
    const facts = make("dl", "notice-facts");
    for (const [term, text] of [
        ["Found", notice.found],
        ["Expected", notice.expected],
    ] as const) {
        if (text !== undefined)
            facts.append(make("dt", "", {}, term), make("dd", "", {}, text));
    }
    if (facts.childElementCount > 0) body.append(facts);
    for (const detail of notice.details ?? []) {
        body.append(make("p", "notice-detail", {}, detail));
    }
    return body;
}
