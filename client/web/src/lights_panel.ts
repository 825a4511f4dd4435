/** The list of area lights and the controls of the selected one. */
import { Pane } from "tweakpane";
import type { AreaLights } from "./area_lights";
import { brightnessFromLinear, type HexColour, linearFromBrightness } from "./colour";
import { icon, make } from "./dom";
import { amountText, stopsText } from "./format";
import { positionFromDirection, directionFromPosition } from "./lat_long";
import { onceAFrame } from "./once_a_frame";
import { labelFields } from "./pane_labels";
import type { Session } from "./session";
import type { AreaLight } from "./wire/state";

const kMinStops = -8;
const kMaxStops = 20;

interface Model {
    on: boolean;
    /** Of the brightest channel: log2 of radiance. */
    stops: number;
    colour: HexColour;
    radius: number;
    azimuth: number;
    elevation: number;
}

export class LightsPanel {
    private readonly list = make("ul", "light-list", { "aria-label": "Area lights" });
    private readonly paneHost = make("div", "pane-host");
    private readonly model: Model = {
        on: true,
        stops: 0,
        colour: "#ffffff",
        radius: 5,
        azimuth: 0,
        elevation: 0,
    };
    private readonly pane: Pane;
    private syncing = false;
    private readonly redrawSoon = onceAFrame(() => {
        this.drawList();
        this.syncPane();
    });
    private drawn = "";

    constructor(
        root: HTMLElement,
        private readonly session: Session,
        private readonly lights: AreaLights,
    ) {
        root.append(this.list, this.paneHost);
        this.pane = new Pane({ container: this.paneHost });
        this.addBindings();
        labelFields(this.paneHost);
        session.stateChanged.listen(() => this.redrawSoon());
        lights.selectionChanged.listen(() => this.redrawSoon());
    }

    private addBindings(): void {
        const { pane, model } = this;
        pane.addBinding(model, "on").on("change", () => {
            this.apply({ gain: model.on ? 1 : 0 });
        });
        const radiance = (): void => {
            const intensity = 2 ** model.stops;
            this.apply({ radiance: linearFromBrightness({ intensity, colour: model.colour }) });
        };
        pane.addBinding(model, "stops", {
            label: "radiance EV",
            min: kMinStops,
            max: kMaxStops,
            step: 0.01,
            format: stopsText,
        }).on("change", radiance);
        pane.addBinding(model, "colour", { view: "color" }).on("change", radiance);
        pane.addBinding(model, "radius", {
            label: "radius °",
            min: 0.05,
            max: 90,
            step: 0.05,
            format: amountText,
        }).on("change", () => this.apply({ angular_radius_degrees: model.radius }));
        const aim = (): void => {
            const position = { u: model.azimuth / 360 + 0.5, v: 0.5 - model.elevation / 180 };
            this.apply({ direction: directionFromPosition(position) });
        };
        pane.addBinding(model, "azimuth", {
            label: "azimuth °",
            min: -180,
            max: 180,
            step: 0.1,
        }).on("change", aim);
        pane.addBinding(model, "elevation", {
            label: "elevation °",
            min: -89.5,
            max: 89.5,
            step: 0.1,
        }).on("change", aim);
        pane.addButton({ title: "Remove light" }).on("click", () => {
            if (this.lights.selected !== null) this.lights.remove(this.lights.selected);
        });
    }

    private apply(fields: Partial<AreaLight>): void {
        const id = this.lights.selected;
        if (!this.syncing && id !== null) this.lights.change(id, fields);
    }

    private drawList(): void {
        const entries = Object.entries(this.lights.all);
        const key = JSON.stringify([entries, this.lights.selected]);
        if (key === this.drawn) return; // rows stay under the pointer while others move the light
        this.drawn = key;
        const focused = document.activeElement?.getAttribute("data-light-row");
        this.list.replaceChildren(...entries.map(([id, light]) => this.makeRow(id, light)));
        if (entries.length === 0) {
            this.list.append(
                make("li", "light-none", {}, "Double-click the map to add a light"),
            );
        }
        if (focused !== null && focused !== undefined) {
            this.list.querySelector<HTMLElement>(`[data-light-row="${focused}"]`)?.focus();
        }
    }

    private makeRow(id: string, light: AreaLight): HTMLLIElement {
        const chip = make("span", "light-chip");
        chip.style.background = brightnessFromLinear(light.radiance).colour;
        const select = make(
            "button",
            "light-row",
            {
                type: "button",
                "data-light-row": id,
                "aria-pressed": String(id === this.lights.selected),
            },
            chip,
            make("span", "light-name", {}, id),
            make(
                "span",
                "light-figure",
                {},
                amountText(Math.max(...light.radiance) * light.gain),
            ),
            make("span", "light-figure", {}, `${amountText(light.angular_radius_degrees)}°`),
        );
        select.classList.toggle("light-off", light.gain === 0);
        select.addEventListener("click", () => {
            this.lights.select(id === this.lights.selected ? null : id);
        });
        select.addEventListener("keydown", (event) => {
            if (event.key !== "Delete" && event.key !== "Backspace") return;
            event.stopPropagation();
            this.lights.remove(id);
        });
        const remove = make("button", "icon-button", {
            type: "button",
            "aria-label": `Remove light ${id}`,
            title: "Remove (Delete)",
        });
        remove.append(icon("close"));
        remove.addEventListener("click", () => this.lights.remove(id));
        return make("li", "", {}, select, remove);
    }

    private syncPane(): void {
        const { selected } = this.lights;
        const light = selected === null ? undefined : this.lights.all[selected];
        this.paneHost.hidden = light === undefined;
        if (light === undefined) return;
        this.pane.disabled = this.session.status.kind !== "open";
        const { model } = this;
        const { intensity, colour } = brightnessFromLinear(light.radiance);
        const { u, v } = positionFromDirection(light.direction);
        model.on = light.gain !== 0;
        if (intensity > 0) {
            model.stops = Math.log2(intensity);
            model.colour = colour;
        }
        model.radius = light.angular_radius_degrees;
        model.azimuth = u * 360 - 180;
        model.elevation = 90 - v * 180;
        this.syncing = true;
        this.pane.refresh();
        this.syncing = false;
    }
}
