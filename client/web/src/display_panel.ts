/** How the scene is shown: this viewer's exposure and tone curve, the room's background. */
import type { FolderApi } from "tweakpane";
import { hexFromLinear, linearFromHex } from "./colour";
import type { Exposure } from "./exposure";
import { stopsText } from "./format";
import { understandKelvin } from "./kelvin";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import type { BackgroundMode, DisplayTone, RoomState } from "./wire/state";

/** The slider's; any value the server takes can be typed. */
const kUsualStops = 8;

export class DisplayPanel {
    private readonly model = {
        exposure: 0,
        tone: "filmic" as DisplayTone,
        background: "environment" as BackgroundMode,
        colour: "#000000",
    };
    private readonly controls: StatePane;
    private readonly backgroundColour: { hidden: boolean };
    private readonly backgroundFolder: FolderApi;
    private readonly defaultButtons: { hidden: boolean }[];

    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
        private readonly exposure: Exposure,
    ) {
        this.controls = new StatePane(root, connection, (state) => this.show(state));
        this.defaultButtons = this.addDisplayBindings();
        this.backgroundFolder = this.controls.pane.addFolder({ title: "Background" });
        this.backgroundColour = this.addBackgroundBindings(this.backgroundFolder);
        labelFields(root);
        understandKelvin(root);
        exposure.changed.listen(() => this.controls.showSoon());
    }

    private addDisplayBindings(): { hidden: boolean }[] {
        const { model } = this;
        const folder = this.controls.pane.addFolder({ title: "Display" });
        folder
            .addBinding(model, "exposure", {
                label: "exposure EV",
                min: -kUsualStops,
                max: kUsualStops,
                step: 0.01,
                format: stopsText,
            })
            .on("change", () => {
                this.controls.byHand(() =>
                    this.exposure.set({ exposure_stops: model.exposure }),
                );
            });
        folder
            .addBinding(model, "tone", { options: { filmic: "filmic", linear: "linear" } })
            .on("change", () => {
                this.controls.byHand(() => this.exposure.set({ tone: model.tone }));
            });
        const makeDefault = folder.addButton({ title: "Make it the room's default" });
        makeDefault.on("click", () => this.exposure.makeDefault());
        const follow = folder.addButton({ title: "Back to the room's default" });
        follow.on("click", () => this.exposure.followRoom());
        return [makeDefault, follow];
    }

    private addBackgroundBindings(folder: FolderApi): { hidden: boolean } {
        const { model } = this;
        folder
            .addBinding(model, "background", {
                label: "show",
                options: {
                    environment: "environment",
                    colour: "colour",
                    nothing: "transparent",
                },
            })
            .on("change", () => this.controls.edit({ background: { mode: model.background } }));
        const colour = folder.addBinding(model, "colour", {
            view: "color",
            picker: "inline",
        });
        colour.element.title = "A colour (#ffcc88) or a temperature (3200K)";
        colour.on("change", () => {
            this.controls.edit({ background: { colour: linearFromHex(model.colour) } });
        });
        return colour;
    }

    private show(state: RoomState): void {
        const { model } = this;
        const { display } = this.exposure;
        model.exposure = display.exposure_stops;
        model.tone = display.tone;
        model.background = state.background.mode;
        model.colour = hexFromLinear(state.background.colour);
        this.backgroundFolder.hidden = !this.connection.takes("background");
        this.backgroundColour.hidden = model.background !== "colour";
        for (const button of this.defaultButtons) button.hidden = !this.exposure.differs;
    }
}
