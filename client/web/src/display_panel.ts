/** How the scene is shown: this viewer's exposure and tone curve, the room's background. */
import { Pane } from "tweakpane";
import { hexFromLinear, linearFromHex } from "./colour";
import type { Exposure } from "./exposure";
import { stopsText } from "./format";
import { understandKelvin } from "./kelvin";
import { onceAFrame } from "./once_a_frame";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import type { BackgroundMode, DisplayTone, JsonObject, RoomState } from "./wire/state";

/** The slider's; any value the server takes can be typed. */
const kUsualStops = 8;

export class DisplayPanel {
    private readonly model = {
        exposure: 0,
        tone: "filmic" as DisplayTone,
        background: "environment" as BackgroundMode,
        colour: "#000000",
    };
    private readonly pane: Pane;
    private readonly backgroundColour: { hidden: boolean };
    private readonly defaultButtons: { hidden: boolean }[];
    private syncing = false;
    private readonly syncSoon = onceAFrame(() => {
        const { state } = this.connection;
        if (state !== null) this.sync(state);
    });

    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
        private readonly exposure: Exposure,
    ) {
        this.pane = new Pane({ container: root });
        this.defaultButtons = this.addDisplayBindings();
        this.backgroundColour = this.addBackgroundBindings();
        labelFields(root);
        understandKelvin(root);
        connection.stateChanged.listen(() => this.syncSoon());
        exposure.changed.listen(() => this.syncSoon());
    }

    private addDisplayBindings(): { hidden: boolean }[] {
        const { model } = this;
        const folder = this.pane.addFolder({ title: "Display" });
        folder
            .addBinding(model, "exposure", {
                label: "exposure EV",
                min: -kUsualStops,
                max: kUsualStops,
                step: 0.01,
                format: stopsText,
            })
            .on("change", () => {
                if (!this.syncing) this.exposure.set({ exposure_stops: model.exposure });
            });
        folder
            .addBinding(model, "tone", { options: { filmic: "filmic", linear: "linear" } })
            .on("change", () => {
                if (!this.syncing) this.exposure.set({ tone: model.tone });
            });
        const makeDefault = folder.addButton({ title: "Make it the room's default" });
        makeDefault.on("click", () => this.exposure.makeDefault());
        const follow = folder.addButton({ title: "Back to the room's default" });
        follow.on("click", () => this.exposure.followRoom());
        return [makeDefault, follow];
    }

    private addBackgroundBindings(): { hidden: boolean } {
        const { model } = this;
        const folder = this.pane.addFolder({ title: "Background" });
        folder
            .addBinding(model, "background", {
                label: "show",
                options: {
                    environment: "environment",
                    colour: "colour",
                    nothing: "transparent",
                },
            })
            .on("change", () => this.apply({ background: { mode: model.background } }));
        const colour = folder.addBinding(model, "colour", {
            view: "color",
            picker: "inline",
        });
        colour.element.title = "A colour (#ffcc88) or a temperature (3200K)";
        colour.on("change", () => {
            this.apply({ background: { colour: linearFromHex(model.colour) } });
        });
        return colour;
    }

    private apply(patch: JsonObject): void {
        if (!this.syncing) this.connection.edit(patch);
    }

    private sync(state: RoomState): void {
        const { model } = this;
        const { display } = this.exposure;
        model.exposure = display.exposure_stops;
        model.tone = display.tone;
        model.background = state.background.mode;
        model.colour = hexFromLinear(state.background.colour);
        this.backgroundColour.hidden = model.background !== "colour";
        for (const button of this.defaultButtons) button.hidden = !this.exposure.differs;
        this.syncing = true;
        this.pane.refresh();
        this.syncing = false;
    }
}
