/** The list of area lights and the controls of the selected one. */
import type { AreaLights } from "./area_lights";
import type { HexColour } from "./colour";
import { make, setText } from "./dom";
import { amountText, stopsText } from "./format";
import { understandKelvin } from "./kelvin";
import { positionFromDirection, directionFromPosition } from "./lat_long";
import { fieldsFromLevel, levelOfLight, texelRadiusDegrees } from "./light_level";
import { LightList } from "./light_list";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import { type AreaLight, kRanges } from "./wire/state";

const kMinStops = -12;
const kMaxStops = 16;

interface Model {
    /** Of the brightest channel: power in EV, see light_level.ts. */
    stops: number;
    colour: HexColour;
    radius: number;
    keeps: "power" | "radiance";
    azimuth: number;
    elevation: number;
}

export class LightsPanel {
    private readonly list: LightList;
    private readonly paneHost = make("div", "pane-host");
    private readonly remark = make("p", "pane-remark", { role: "status" });
    private readonly model: Model = {
        stops: 0,
        colour: "#ffffff",
        radius: 5,
        keeps: "power",
        azimuth: 0,
        elevation: 0,
    };
    private readonly controls: StatePane;

    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
        private readonly lights: AreaLights,
    ) {
        this.list = new LightList(root, lights);
        root.append(this.paneHost);
        this.controls = new StatePane(this.paneHost, connection, () => {
            this.list.draw();
            this.showSelected();
        });
        this.addBindings();
        this.paneHost.append(this.remark);
        labelFields(this.paneHost);
        understandKelvin(this.paneHost);
        connection.statusChanged.listen(() => this.controls.showSoon());
        lights.selectionChanged.listen(() => this.controls.showSoon());
    }

    private addBindings(): void {
        const { model } = this;
        const { pane } = this.controls;
        const level = (): void => {
            this.apply(fieldsFromLevel(model, model.radius));
        };
        pane.addBinding(model, "stops", {
            label: "power EV",
            min: kMinStops,
            max: kMaxStops,
            step: 0.01,
            format: stopsText,
        }).on("change", level);
        const colour = pane.addBinding(model, "colour", { view: "color", picker: "inline" });
        colour.on("change", level);
        colour.element.title = "A colour (#ffcc88) or a temperature (3200K)";
        pane.addBinding(model, "radius", {
            label: "radius °",
            min: kRanges.lights.angular_radius_degrees.lowest,
            max: kRanges.lights.angular_radius_degrees.highest,
            step: 0.05,
            format: amountText,
        }).on("change", () => {
            const id = this.lights.selected;
            if (id !== null)
                this.controls.byHand(() => this.lights.setRadius(id, model.radius));
        });
        pane.addBinding(model, "keeps", {
            label: "resize keeps",
            options: { power: "power", radiance: "radiance" },
        }).on("change", () => {
            this.lights.keepsPower = model.keeps === "power";
            this.controls.showSoon();
        });
        const aim = (): void => {
            const position = { u: model.azimuth / 360 + 0.5, v: 0.5 - model.elevation / 180 };
            this.apply({ direction: directionFromPosition(position) });
        };
        for (const [key, limit] of [
            ["azimuth", 180],
            ["elevation", 89.5],
        ] as const) {
            const options = { label: `${key} °`, min: -limit, max: limit, step: 0.1 };
            pane.addBinding(model, key, options).on("change", aim);
        }
    }

    private apply(fields: Partial<AreaLight>): void {
        const id = this.lights.selected;
        if (id !== null) this.controls.byHand(() => this.lights.change(id, fields));
    }

    private showSelected(): void {
        const { selected } = this.lights;
        const light = selected === null ? undefined : this.lights.all[selected];
        this.paneHost.hidden = light === undefined;
        if (light === undefined) return;
        this.controls.pane.disabled = this.connection.status.kind !== "open";
        const { model } = this;
        const { stops, colour } = levelOfLight(light);
        const { u, v } = positionFromDirection(light.direction);
        if (Number.isFinite(stops)) {
            model.stops = stops;
            model.colour = colour;
        }
        model.radius = light.angular_radius_degrees;
        model.azimuth = u * 360 - 180;
        model.elevation = 90 - v * 180;
        setText(this.remark, this.remarkOn(light));
    }

    private remarkOn(light: AreaLight): string {
        const keeps = this.lights.keepsPower
            ? "Resizing keeps the power: a larger light has softer shadows, not more light."
            : "Resizing keeps the radiance: a larger light gives more light.";
        const faceResolution = this.connection.snapshot?.scene.face_resolution;
        if (faceResolution === undefined) return keeps;
        const texel = texelRadiusDegrees(faceResolution);
        return light.angular_radius_degrees < texel
            ? `Smaller than a texel of this scene's light (${amountText(texel)}°): ` +
                  `shadows do not get sharper than at ${amountText(texel)}°.`
            : keeps;
    }
}
