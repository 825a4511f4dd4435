/** The material of the selected part: which it is, the number of its family, its colours. */
import type { FolderApi } from "tweakpane";
import type { OfferedMaterial } from "./api";
import { brightnessFromLinear, linearFromBrightness } from "./colour";
import { coloursOf, type Finishes, parameterOf } from "./finishes";
import { amountText, stopsText } from "./format";
import { understandKelvin } from "./kelvin";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import type { Triple } from "./wire/state";

const kAsBaked = "as baked";
const kOffStops = -8;
const kMaxStops = 5;

/** GGX is a diffuse base under a coat, which reflects straight on and at grazing angles. */
const kCoatedLobes = ["diffuse", "straight on", "grazing"];

/** Red, green and blue apart: a measured material, whose colours are its own. */
function isMeasured({ colours }: OfferedMaterial): boolean {
    return (
        colours.length === 3 &&
        colours.every((colour, i) => colour.every((part, c) => part === (c === i ? 1 : 0)))
    );
}

/** What people call the lobes whose colours they choose. */
export function lobeTitles(offered: OfferedMaterial): string[] {
    if (isMeasured(offered)) return [];
    if (offered.colours.length === 1) return ["colour"];
    return offered.colours.map((_, i) =>
        offered.colours.length === kCoatedLobes.length ? kCoatedLobes[i]! : `lobe ${i + 1}`,
    );
}

interface Colour {
    colour: string;
    stops: number;
}

export class FinishControls {
    private readonly controls: StatePane;
    private readonly folder: FolderApi;
    private readonly model = { material: kAsBaked, parameter: 1 };
    private colours: Colour[] = [];
    private built = "";

    constructor(
        private readonly root: HTMLElement,
        connection: RoomConnection,
        private readonly finishes: Finishes,
    ) {
        this.controls = new StatePane(root, connection, () => this.show());
        this.folder = this.controls.pane.addFolder({ title: "Finish" });
        understandKelvin(root);
        connection.statusChanged.listen(({ kind }) => {
            this.controls.pane.disabled = kind !== "open";
        });
        finishes.selectionChanged.listen(() => this.controls.showSoon());
        finishes.offerChanged.listen(() => this.controls.showSoon());
    }

    private show(): void {
        const { finish, selected } = this.finishes;
        const offered = finish === null ? null : this.finishes.offeredAs(finish.material);
        this.model.material = finish?.material ?? kAsBaked;
        const key = JSON.stringify([
            selected?.id,
            finish?.material,
            offered,
            this.finishes.offered.map(({ name }) => name),
        ]);
        if (finish !== null && offered !== null) {
            this.model.parameter = parameterOf(finish, offered);
            this.colours = coloursOf(finish, offered).map((linear, i) => {
                const { intensity, colour } = brightnessFromLinear(linear);
                // Bindings keep the object; of black the hue stays as it was.
                const model = this.colours[i] ?? { colour, stops: kOffStops };
                model.stops = intensity > 0 ? Math.log2(intensity) : kOffStops;
                if (intensity > 0) model.colour = colour;
                return model;
            });
        }
        if (key !== this.built) {
            this.built = key;
            this.build(offered);
        }
    }

    private build(offered: OfferedMaterial | null): void {
        const { folder, model } = this;
        for (const child of [...folder.children]) child.dispose();
        const names = [kAsBaked, ...this.finishes.offered.map(({ name }) => name)];
        if (!names.includes(model.material)) names.push(model.material);
        folder
            .addBinding(model, "material", {
                options: Object.fromEntries(names.map((name) => [name, name])),
            })
            .on("change", ({ value }) => {
                this.controls.byHand(() =>
                    this.finishes.give(value === kAsBaked ? null : value),
                );
            });
        if (offered !== null) {
            if (offered.parameter !== undefined) this.addParameter(offered);
            lobeTitles(offered).forEach((title, lobe) => this.addColour(title, lobe));
        }
        labelFields(this.root);
    }

    private addParameter({ parameter, steps = [] }: OfferedMaterial): void {
        const lowest = steps[0] ?? 1;
        const highest = steps[steps.length - 1] ?? 1;
        if (lowest === highest) return;
        this.folder
            .addBinding(this.model, "parameter", {
                label: parameter ?? "number",
                min: lowest,
                max: highest,
                format: amountText,
            })
            .on("change", ({ value, last }) => {
                this.controls.byHand(() => {
                    this.finishes.setParameter(Number(value.toPrecision(6)));
                    if (last === true) this.finishes.history.end();
                });
            });
    }

    private addColour(title: string, lobe: number): void {
        const model = this.colours[lobe]!;
        const change = ({ last }: { last?: boolean }): void => {
            this.controls.byHand(() => {
                this.finishes.setColours(this.colours.map(linearOf));
                if (last === true) this.finishes.history.end();
            });
        };
        const colour = this.folder.addBinding(model, "colour", {
            label: title,
            view: "color",
            picker: "inline",
        });
        colour.element.title = "A colour (#ffcc88) or a temperature (3200K)";
        colour.on("change", change);
        this.folder
            .addBinding(model, "stops", {
                label: `${title} EV`,
                min: kOffStops,
                max: kMaxStops,
                step: 0.01,
                format: (stops) => (stops <= kOffStops ? "off" : stopsText(stops)),
            })
            .on("change", change);
    }
}

function linearOf({ colour, stops }: Colour): Triple {
    const intensity = stops <= kOffStops ? 0 : 2 ** stops;
    const linear = linearFromBrightness({ intensity, colour });
    return linear.map((part) => Number(part.toPrecision(6))) as Triple;
}
