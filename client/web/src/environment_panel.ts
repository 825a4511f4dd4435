/** Controls of the environment as a whole: gain, tint, blend, rotation. */
import type { FolderApi } from "tweakpane";
import type { EnvironmentEntry } from "./api";
import { hexFromLinear, linearFromHex } from "./colour";
import { stopsText } from "./format";
import { understandKelvin } from "./kelvin";
import { labelFields } from "./pane_labels";
import { eulerFromQuaternion, kIdentity, quaternionFromEuler } from "./rotation";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import type { RoomState } from "./wire/state";

/** At the lower end of its range the environment is off. */
const kOffStops = -10;
const kMaxStops = 10;
const kNoBlend = "";

export class EnvironmentPanel {
    private readonly model = {
        gain: 0,
        tint: "#ffffff",
        blend: kNoBlend,
        amount: 0,
        yaw: 0,
        pitch: 0,
        roll: 0,
    };
    private readonly controls: StatePane;
    private readonly blendFolder: FolderApi;
    private names: string[] = [];

    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
    ) {
        this.controls = new StatePane(root, connection, (state) => this.show(state));
        this.addLightBindings();
        this.blendFolder = this.controls.pane.addFolder({ title: "Blend" });
        this.addBlendBindings();
        this.addRotationBindings();
        labelFields(root);
        understandKelvin(root);
        connection.statusChanged.listen(({ kind }) => {
            this.controls.pane.disabled = kind !== "open";
        });
    }

    /** The environments that can be blended in. */
    setEnvironments(entries: EnvironmentEntry[]): void {
        const names = entries.map((entry) => entry.name);
        if (names.join() === this.names.join()) return;
        this.names = names;
        for (const child of [...this.blendFolder.children]) child.dispose();
        this.addBlendBindings();
        labelFields(this.blendFolder.element);
    }

    private addLightBindings(): void {
        const { model } = this;
        const { pane } = this.controls;
        pane.addBinding(model, "gain", {
            label: "gain EV",
            min: kOffStops,
            max: kMaxStops,
            step: 0.01,
            format: (stops) => (stops <= kOffStops ? "off" : stopsText(stops)),
        }).on("change", () => {
            const gain = model.gain <= kOffStops ? 0 : 2 ** model.gain;
            this.controls.edit({ environment: { gain } });
        });
        const tint = pane.addBinding(model, "tint", { view: "color", picker: "inline" });
        tint.element.title = "A colour (#ffcc88) or a temperature (3200K)";
        tint.on("change", () => {
            this.controls.edit({ environment: { tint: linearFromHex(model.tint) } });
        });
    }

    private addBlendBindings(): void {
        const { blendFolder, model } = this;
        const options = [{ text: "none", value: kNoBlend }].concat(
            this.names.map((name) => ({ text: name, value: name })),
        );
        blendFolder.addBinding(model, "blend", { label: "with", options }).on("change", () => {
            if (model.blend === kNoBlend) this.controls.edit({ blend: { name: null, amount: 0 } });
            else this.controls.edit({ blend: { name: model.blend } });
        });
        blendFolder
            .addBinding(model, "amount", { min: 0, max: 1, step: 0.001 })
            .on("change", () => this.controls.edit({ blend: { amount: model.amount } }));
    }

    private addRotationBindings(): void {
        const { model } = this;
        const folder = this.controls.pane.addFolder({ title: "Rotation" });
        const rotate = (): void => {
            this.controls.edit({ rotation: { quaternion: quaternionFromEuler(model) } });
        };
        for (const [key, limit] of [
            ["yaw", 180],
            ["pitch", 90],
            ["roll", 180],
        ] as const) {
            folder
                .addBinding(model, key, {
                    label: `${key} °`,
                    min: -limit,
                    max: limit,
                    step: 0.1,
                })
                .on("change", rotate);
        }
        folder.addButton({ title: "Reset rotation" }).on("click", () => {
            this.connection.edit({ rotation: { quaternion: kIdentity } });
        });
    }

    private show(state: RoomState): void {
        const { model } = this;
        const { gain, tint } = state.environment;
        model.gain = gain > 0 ? Math.log2(gain) : kOffStops;
        model.tint = hexFromLinear(tint);
        model.blend = state.blend.name ?? kNoBlend;
        model.amount = state.blend.amount;
        Object.assign(model, eulerFromQuaternion(state.rotation.quaternion));
    }
}
