/** The rows of the area lights: choosing, naming, mute, solo, copying, removing. */
import { type AreaLights, lightsNow, nameOfLight, orderedLights } from "./area_lights";
import { icon, make } from "./dom";
import { amountText, levelText } from "./format";
import { levelOfLight } from "./light_level";
import type { AreaLight } from "./wire/state";

export class LightList {
    private readonly list = make("ul", "light-list", { "aria-label": "Area lights" });
    private drawn = "";
    private renaming = false;

    constructor(
        root: HTMLElement,
        private readonly lights: AreaLights,
    ) {
        root.append(this.list);
    }

    draw(): void {
        const entries = orderedLights(this.lights.all);
        const key = JSON.stringify([entries, this.lights.selected]);
        // Rows stay under the pointer while others move the light, and while a name is typed.
        if (key === this.drawn || this.renaming) return;
        this.drawn = key;
        const { activeElement } = document;
        const focused = this.list.contains(activeElement)
            ? activeElement?.getAttribute("data-focus")
            : null;
        this.list.replaceChildren(...entries.map(([id, light]) => this.makeRow(id, light)));
        if (entries.length === 0) {
            this.list.append(
                make("li", "light-none", {}, "Double-click the map to add a light"),
            );
        }
        if (focused !== null && focused !== undefined) {
            this.list.querySelector<HTMLElement>(`[data-focus="${focused}"]`)?.focus();
        }
    }

    private makeRow(id: string, light: AreaLight): HTMLLIElement {
        const row = make("li", "light-item", { "data-light-item": id });
        const name = nameOfLight(id, light);
        row.append(
            this.makeSelector(row, id, light),
            this.makeSwitch(id, "muted", "M", `Mute ${name}`, light.muted),
            this.makeSwitch(id, "solo", "S", `Solo ${name}`, light.solo),
            this.makeAction(id, "copy", `Duplicate ${name}`, () => this.lights.duplicate(id)),
            this.makeAction(id, "close", `Remove ${name}`, () => this.lights.remove(id)),
        );
        return row;
    }

    private makeSelector(row: HTMLLIElement, id: string, light: AreaLight): HTMLElement {
        const { stops, colour } = levelOfLight(light);
        const chip = make("span", "light-chip");
        chip.style.background = colour;
        const select = make(
            "button",
            "light-row",
            {
                type: "button",
                "data-light-row": id,
                "data-focus": `${id} row`,
                "aria-pressed": String(id === this.lights.selected),
                title: "Double-click to rename (F2)",
            },
            chip,
            make("span", "light-name", {}, nameOfLight(id, light)),
            make(
                "span",
                "light-figures",
                {},
                `${levelText(stops)} · ${amountText(light.angular_radius_degrees)}°`,
            ),
        );
        select.classList.toggle("light-off", !lightsNow(light, this.lights.all));
        select.addEventListener("click", (event) => {
            // The second click of a double click must not undo what the first did.
            if (event.detail > 1) return;
            this.lights.select(id === this.lights.selected ? null : id);
        });
        row.addEventListener("dblclick", (event) => {
            if (event.target instanceof Element && event.target.closest(".light-row") !== null)
                this.startRename(id);
        });
        select.addEventListener("keydown", (event) => {
            if (event.key === "F2") this.startRename(id);
            else if (event.key === "Delete" || event.key === "Backspace")
                this.lights.remove(id);
            else return;
            event.preventDefault();
            event.stopPropagation();
        });
        return select;
    }

    private makeSwitch(
        id: string,
        key: "muted" | "solo",
        letter: string,
        words: string,
        isOn: boolean,
    ): HTMLElement {
        const button = make(
            "button",
            `light-switch light-switch-${key}`,
            {
                type: "button",
                "aria-pressed": String(isOn),
                "aria-label": words,
                title: words,
                "data-focus": `${id} ${key}`,
            },
            letter,
        );
        button.addEventListener("click", () => this.lights.toggle(id, key));
        return button;
    }

    private makeAction(
        id: string,
        picture: string,
        words: string,
        run: () => unknown,
    ): HTMLElement {
        const button = make("button", "icon-button", {
            type: "button",
            "aria-label": words,
            title: words,
            "data-focus": `${id} ${picture}`,
        });
        button.append(icon(picture));
        button.addEventListener("click", run);
        return button;
    }

    /** The row's name becomes a field: Enter and leaving take it, Escape does not. */
    private startRename(id: string): void {
        const light = this.lights.all[id];
        const selector = `[data-light-row="${id}"] .light-name`;
        const name = this.list.querySelector<HTMLElement>(selector);
        const row = name?.closest(".light-row");
        if (light === undefined || name === null || !row || this.renaming) return;
        this.renaming = true;
        const field = make("input", "light-rename", {
            type: "text",
            maxlength: "64",
            "aria-label": "Name of the light",
        });
        field.value = nameOfLight(id, light);
        // A button takes no field inside it: the field lies in the row in the button's place.
        row.replaceWith(field);
        field.select();
        const end = (takes: boolean): void => {
            if (!this.renaming) return;
            this.renaming = false;
            this.drawn = "";
            if (takes) this.lights.rename(id, field.value);
            this.draw();
            this.list.querySelector<HTMLElement>(`[data-light-row="${id}"]`)?.focus();
        };
        field.addEventListener("blur", () => end(true));
        field.addEventListener("keydown", (event) => {
            event.stopPropagation();
            if (event.key === "Enter") end(true);
            else if (event.key === "Escape") end(false);
        });
        field.focus();
    }
}
