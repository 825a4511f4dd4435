/** The scenes of the server with their thumbnails. Another scene is another room: a new page. */
import type { Api, SceneEntry } from "./api";
import { byId, make, setText } from "./dom";
import { bytesText } from "./format";
import { addressOfScene } from "./place";

export class ScenePicker {
    private readonly button = byId<HTMLButtonElement>("scene-button");
    private readonly name = byId("scene-name");
    private readonly dialog = byId<HTMLDialogElement>("scene-dialog");
    private readonly list = byId("scene-list");

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

    open(): void {
        this.dialog.showModal();
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
                    bytesText(scene.bytes),
            ),
        );
        if (scene.name === current) link.setAttribute("aria-current", "true");
        return make("li", "", {}, link);
    }
}
