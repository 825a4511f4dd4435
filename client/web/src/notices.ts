/** Messages that come and go at the edge of the stage; errors and offers stay until they are dismissed. */
import { icon, make } from "./dom";

export interface Notice {
    tone: "error" | "warning" | "info";
    title: string;
    found?: string | undefined;
    expected?: string | undefined;
    details?: string[];
    action?: { words: string; run: () => void };
}

const kStayMilliseconds = 6000;
const kMostShown = 4;

export class Notices {
    constructor(private readonly list: HTMLElement) {}

    show(notice: Notice): void {
        const close = make("button", "notice-close", {
            type: "button",
            "aria-label": "Dismiss",
        });
        close.append(icon("close"));
        const facts = make("dl", "notice-facts");
        for (const [term, text] of [
            ["Found", notice.found],
            ["Expected", notice.expected],
        ]) {
            if (text !== undefined && term !== undefined) {
                facts.append(make("dt", "", {}, term), make("dd", "", {}, text));
            }
        }
        const body = make(
            "div",
            "notice-body",
            {},
            make("p", "notice-title", {}, notice.title),
        );
        if (facts.childElementCount > 0) body.append(facts);
        for (const detail of notice.details ?? []) {
            body.append(make("p", "notice-detail", {}, detail));
        }
        const { action } = notice;
        if (action !== undefined) {
            const button = make(
                "button",
                "small-button notice-action",
                { type: "button" },
                action.words,
            );
            button.addEventListener("click", () => {
                item.remove();
                action.run();
            });
            body.append(button);
        }
        const role = notice.tone === "error" ? "alert" : "status";
        const item = make("div", `notice notice-${notice.tone}`, { role }, body, close);
        close.addEventListener("click", () => item.remove());
        const stays = notice.tone === "error" || action !== undefined;
        if (!stays) setTimeout(() => item.remove(), kStayMilliseconds);
        this.list.append(item);
        while (this.list.childElementCount > kMostShown) this.list.firstElementChild?.remove();
    }
}
