/** The scenes of the server with their thumbnails. Another scene is another room: a new page. */
import type { Api, SceneEntry } from "./api";
import { byId, make, setText } from "./dom";
import { bakeErrorText, bytesText } from "./format";
import { nearNames } from "./near_names";
import { addressOfScene } from "./place";

const kMostNamed = 12;

export class ScenePicker {
    private readonly button = byId<HTMLButtonElement>("scene-button");
    private readonly name = byId("scene-name");
    private readonly dialog = byId<HTMLDialogElement>("scene-dialog");
    private readonly list = byId("scene-list");
    private saidInstead: string | null = null;

    constructor(private readonly api: Api) {
        this.button.addEventListener("click", () => this.dialog.showModal());
        this.dialog.addEventListener("click", (event) => {
            if (event.target === this.dialog) this.dialog.close();
        });
    }

    show(scenes: SceneEntry[], current: string | null): void {
        setText(this.name, current ?? "Choose a scene");
        this.list.replaceChildren(...scenes.map((scene) => this.makeItem(scene, current)));
        this.button.disabled = scenes.length === 0;
    }

    /** Says that there is no such scene, and what there is, the near names first. */
    offerInsteadOf(unknown: string, scenes: SceneEntry[]): void {
        const names = scenes.map(({ name }) => name);
        const near = nearNames(unknown, names);
        const linkTo = (name: string): HTMLElement =>
            make("a", "", { href: addressOfScene(new URL(location.href), name) }, name);
        const list = (of: string[]): (Node | string)[] =>
            of
                .slice(0, kMostNamed)
                .flatMap((name, i) => (i > 0 ? [", ", linkTo(name)] : [linkTo(name)]));
        const words: (Node | string)[] = [`There is no scene “${unknown}” here. `];
        if (near.length > 0) words.push("Did you mean ", ...list(near), "? ");
        words.push(
            names.length > 0 ? "There is: " : "This server has no scenes.",
            ...list(names),
        );
        if (names.length > kMostNamed) words.push(` and ${names.length - kMostNamed} more`);
        const veil = byId("stage-veil");
        if (this.saidInstead === names.join()) return; // links stay under the pointer
        this.saidInstead = names.join();
        veil.classList.add("stage-veil-links");
        veil.replaceChildren(...words);
        setText(this.name, unknown);
        byId("status").dataset["kind"] = "refused";
        setText(byId("status-words"), "There is no such scene");
    }

    private makeItem(scene: SceneEntry, current: string | null): HTMLElement {
        const link = make(
            "a",
            "scene",
            { href: addressOfScene(new URL(location.href), scene.name) },
            make("img", "scene-picture", {
                src: this.api.thumbnailAddress(scene.name),
                alt: "",
                loading: "lazy",
            }),
            make("span", "scene-title", {}, scene.name),
            make(
                "span",
                "scene-facts",
                {},
                `${scene.width} × ${scene.height} · 6 × ${scene.face_resolution}² lights · ` +
                    [bytesText(scene.bytes), bakeErrorText(scene.bake_error)]
                        .filter((text) => text !== "")
                        .join(" · "),
            ),
        );
        if (scene.name === current) link.setAttribute("aria-current", "true");
        return make("li", "", {}, link);
    }
}
