/** Sliders that move the curve, and the colours of curve and diffuse reflection. */
import type { FolderApi } from "tweakpane";
import { brightnessFromLinear, linearFromBrightness } from "./colour";
import { amountText, stopsText } from "./format";
import { understandKelvin } from "./kelvin";
import type { Materials } from "./materials";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import { clampTo } from "./wire/range";
import {
    type JsonObject,
    kRanges,
    type MaterialEdit,
    type MaterialsShape,
    type Triple,
} from "./wire/state";

/** What a curve is that no shape makes. */
const kDrawn = "drawn";

type NumberField = "roughness" | "exponent" | "f90";
type TripleField = "n" | "e" | "f0" | "value";

/** The parameters of the shapes [protocol/curves.md §4]. */
const kParameters: { [shape in MaterialsShape]: readonly (NumberField | TripleField)[] } = {
    beckmann: ["roughness"],
    ggx: ["roughness"],
    velvet: ["roughness"],
    conductor: ["n", "e"],
    dielectric: ["n"],
    schlick: ["f0", "f90"],
    cosine_power: ["exponent"],
    constant: ["value"],
};

/** Where not all of what the field may hold is a shape's [protocol/curves.md §4]. */
const kShapeRanges: {
    [shape in MaterialsShape]?: { [field: string]: { lowest: number; highest: number } };
} = {
    ggx: { roughness: { lowest: 0.001, highest: 1 } },
    velvet: { roughness: { lowest: 0.05, highest: 2 } },
    dielectric: { n: { lowest: 1, highest: 4 } },
};

const kTriples = new Set<string>(["n", "e", "f0", "value"]);
/** At the lower end of its range a colour is off. */
const kOffStops = -8;
const kMaxStops = 5;
/** Of sliders: files and the command line take more. */
const kUsualValue = 10;
const kUsualExponent = 2000;

function isTriple(field: string): field is TripleField {
    return kTriples.has(field);
}

export class MaterialControls {
    private readonly controls: StatePane;
    private readonly shapeFolder: FolderApi;
    private readonly model = {
        shape: kDrawn as MaterialsShape | typeof kDrawn,
        roughness: 0.2,
        exponent: 50,
        f90: 1,
        n: { x: 1.5, y: 1.5, z: 1.5 },
        e: { x: 0, y: 0, z: 0 },
        f0: { x: 0, y: 0, z: 0 },
        value: { x: 1, y: 1, z: 1 },
        tint: "#ffffff",
        tintStops: 0,
        diffuse: "#ffffff",
        diffuseStops: 0,
    };
    private built = "";

    constructor(
        private readonly root: HTMLElement,
        connection: RoomConnection,
        private readonly materials: Materials,
    ) {
        this.controls = new StatePane(root, connection, () => this.show());
        this.shapeFolder = this.controls.pane.addFolder({ title: "Shape" });
        this.addColours();
        understandKelvin(root);
        connection.statusChanged.listen(({ kind }) => {
            this.controls.pane.disabled = kind !== "open";
        });
        materials.selectionChanged.listen(() => this.controls.showSoon());
    }

    private show(): void {
        const { edit, selected } = this.materials;
        if (edit === null || selected === null) return;
        const { model } = this;
        model.shape = edit.shape ?? kDrawn;
        model.roughness = edit.roughness;
        model.exponent = edit.exponent;
        model.f90 = edit.f90;
        for (const field of ["n", "e", "f0", "value"] as const) {
            const [x, y, z] = edit[field];
            Object.assign(model[field], { x, y, z });
        }
        for (const key of ["tint", "diffuse"] as const) {
            const { intensity, colour } = brightnessFromLinear(edit[key]);
            model[`${key}Stops`] = intensity > 0 ? Math.log2(intensity) : kOffStops;
            if (intensity > 0) model[key] = colour;
        }
        const wanted = `${selected.id} ${model.shape}`;
        if (wanted !== this.built) {
            this.built = wanted;
            this.buildShape(selected.shapes, edit);
        }
    }

    private buildShape(shapes: readonly MaterialsShape[], edit: MaterialEdit): void {
        const { shapeFolder, model } = this;
        for (const child of [...shapeFolder.children]) child.dispose();
        const options = Object.fromEntries(shapes.map((shape) => [words(shape), shape]));
        if (model.shape === kDrawn) options[kDrawn] = kDrawn as MaterialsShape;
        shapeFolder
            .addBinding(model, "shape", { label: "made of", options })
            .on("change", () => {
                this.controls.byHand(() => {
                    if (model.shape === kDrawn) return;
                    this.materials.setShape(model.shape, this.parameters(model.shape));
                    this.materials.history.end();
                });
            });
        if (edit.shape !== null && edit.shape !== undefined) this.addParameters(edit.shape);
        labelFields(this.root);
    }

    private addParameters(shape: MaterialsShape): void {
        const { shapeFolder, model } = this;
        for (const field of kParameters[shape]) {
            const range = this.range(shape, field);
            // Without a step, which would count from the value that happens to be there.
            const options = { min: range.lowest, max: range.highest };
            const binding =
                shape === "dielectric" && field === "n"
                    ? shapeFolder.addBinding(model.n, "y", { ...options, label: "n" })
                    : isTriple(field)
                      ? shapeFolder.addBinding(model, field, {
                            label: `${field} r, g, b`,
                            x: options,
                            y: options,
                            z: options,
                        })
                      : shapeFolder.addBinding(model, field, {
                            ...options,
                            label: field,
                            ...(field === "exponent"
                                ? { max: kUsualExponent }
                                : { format: amountText }),
                        });
            binding.on("change", ({ last }) => {
                this.controls.byHand(() => {
                    this.materials.setShape(shape, this.parameters(shape));
                    if (last === true) this.materials.history.end();
                });
            });
        }
    }

    private range(shape: MaterialsShape, field: NumberField | TripleField): {
        lowest: number;
        highest: number;
    } {
        const range = kShapeRanges[shape]?.[field] ?? kRanges.materials[field];
        return field === "value" ? { ...range, highest: kUsualValue } : range;
    }

    /** What a patch says of the shape's parameters: all, so that it starts from what shows. */
    private parameters(shape: MaterialsShape): JsonObject {
        const { model } = this;
        return Object.fromEntries(
            kParameters[shape].map((field) => {
                const range = kShapeRanges[shape]?.[field] ?? kRanges.materials[field];
                if (!isTriple(field)) return [field, clampTo(range, model[field])];
                const { x, y, z } = model[field];
                const parts = shape === "dielectric" ? [y, y, y] : [x, y, z];
                return [field, parts.map((part) => clampTo(range, part))];
            }),
        );
    }

    private addColours(): void {
        const { model } = this;
        for (const [key, title] of [
            ["tint", "Colour of the curve"],
            ["diffuse", "Diffuse colour"],
        ] as const) {
            const folder = this.controls.pane.addFolder({ title });
            const change = ({ last }: { last?: boolean }): void => {
                this.controls.byHand(() => {
                    this.materials.setColour(key, this.colour(key));
                    if (last === true) this.materials.history.end();
                });
            };
            const colour = folder.addBinding(model, key, {
                label: `${key} colour`,
                view: "color",
                picker: "inline",
            });
            colour.element.title = "A colour (#ffcc88) or a temperature (3200K)";
            colour.on("change", change);
            folder
                .addBinding(model, `${key}Stops`, {
                    label: `${key} EV`,
                    min: kOffStops,
                    max: kMaxStops,
                    step: 0.01,
                    format: (stops) => (stops <= kOffStops ? "off" : stopsText(stops)),
                })
                .on("change", change);
        }
        labelFields(this.root);
    }

    private colour(key: "tint" | "diffuse"): Triple {
        const stops = this.model[`${key}Stops`];
        const intensity = stops <= kOffStops ? 0 : 2 ** stops;
        const linear = linearFromBrightness({ intensity, colour: this.model[key] });
        return linear.map((part) => Number(part.toPrecision(6))) as Triple;
    }
}

function words(shape: string): string {
    return shape.replace("_", " ");
}
