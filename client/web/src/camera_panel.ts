/** Where the scene is looked at from, and how large the image is, where they can change. */
import { framed, seenFrom, type Side } from "./camera";
import { movingBounds } from "./camera_hand";
import { make } from "./dom";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import type { SceneBounds } from "./wire/message";
import { type CameraState, kRanges, type RoomState } from "./wire/state";

/** The largest side that a server takes [protocol/README.md §3.1]. */
const kMostPixels = 4096;

interface View {
    title: string;
    words: string;
    camera: (now: CameraState, bounds: SceneBounds, aspect: number) => CameraState;
}

const sideView = (title: string, side: Side): View => ({
    title,
    words: `All of the scene from its ${side}`,
    camera: (now, bounds, aspect) => seenFrom(side, now, bounds, aspect),
});

const kViews: View[] = [
    sideView("Front", "front"),
    sideView("Back", "back"),
    sideView("Left", "left"),
    sideView("Right", "right"),
    sideView("Top", "top"),
    sideView("Bottom", "bottom"),
];

export class CameraPanel {
    private readonly model = { fov: 40, width: 512, height: 512 };
    private readonly controls: StatePane;

    constructor(
        private readonly card: HTMLElement,
        root: HTMLElement,
        buttons: HTMLElement,
        private readonly connection: RoomConnection,
    ) {
        this.addButtons(buttons);
        this.controls = new StatePane(root, connection, (state) => this.show(state));
        const { model } = this;
        const folder = this.controls.pane.addFolder({ title: "Lens and image" });
        folder
            .addBinding(model, "fov", {
                label: "field of view",
                min: kRanges.camera.fov_degrees.lowest,
                max: kRanges.camera.fov_degrees.highest,
                step: 0.01,
            })
            .on("change", () => this.controls.edit({ camera: { fov_degrees: model.fov } }));
        for (const side of ["width", "height"] as const) {
            folder
                .addBinding(model, side, { min: 1, max: kMostPixels, step: 1 })
                .on("change", ({ last }) => {
                    // Every size on the way would be drawn.
                    if (last === true) this.controls.edit({ image: { [side]: model[side] } });
                });
        }
        labelFields(root);
        connection.opened.listen(() => {
            this.card.hidden = movingBounds(connection) === null;
        });
    }

    /** All of the scene, from where it is looked at. */
    frameAll(): void {
        this.look(framed);
    }

    /** As the scene's file says. */
    reset(): void {
        const camera = this.connection.snapshot?.scene.camera;
        if (camera !== undefined) this.look(() => camera);
    }

    private look(view: View["camera"]): void {
        const { state } = this.connection;
        const bounds = movingBounds(this.connection);
        if (state === null || bounds === null) return;
        const aspect = state.image.width / state.image.height;
        const { eye, look_at, up, fov_degrees } = view(state.camera, bounds, aspect);
        this.connection.edit({ camera: { eye, look_at, up, fov_degrees } });
    }

    private addButtons(root: HTMLElement): void {
        const add = (title: string, words: string, act: () => void): void => {
            const button = make(
                "button",
                "small-button",
                { type: "button", title: words },
                title,
            );
            button.addEventListener("click", act);
            root.append(button);
        };
        for (const { title, words, camera } of kViews) {
            add(title, words, () => this.look(camera));
        }
        add("Frame all", "All of the scene, from this side (A)", () => this.frameAll());
        add("File", "The camera of the scene's file (C)", () => this.reset());
    }

    private show(state: RoomState): void {
        this.model.fov = state.camera.fov_degrees;
        this.model.width = state.image.width;
        this.model.height = state.image.height;
    }
}
