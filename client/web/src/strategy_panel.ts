/** How the scene is shown and how it is relit: display, background, method, priority, budget. */
import { Pane } from "tweakpane";
import { hexFromLinear, linearFromHex } from "./colour";
import { kMaxExposureStops, kMinExposureStops } from "./display";
import type { Exposure } from "./exposure";
import { percentText, stopsText } from "./format";
import { onceAFrame } from "./once_a_frame";
import { labelFields } from "./pane_labels";
import type { Session } from "./session";
import type {
    BackgroundMode,
    JsonObject,
    Method,
    Priority,
    RoomState,
    Tone,
} from "./wire/state";

type BudgetKind = "milliseconds" | "coefficients";
type BudgetRows = { [kind in BudgetKind]: { hidden: boolean } };

/** The slider's; any value the server takes can be typed. */
const kUsualStops = 8;
const kMostMilliseconds = 50;
const kMostCoefficients = 2000;
const kDefaultMilliseconds = 8;
const kDefaultCoefficients = 100;

export class StrategyPanel {
    private readonly model = {
        exposure: 0,
        tone: "filmic" as Tone,
        background: "environment" as BackgroundMode,
        colour: "#000000",
        method: "guarded" as Method,
        priority: "benefit" as Priority,
        budget: "milliseconds" as BudgetKind,
        milliseconds: kDefaultMilliseconds,
        coefficients: kDefaultCoefficients,
        target: 0,
    };
    private readonly pane: Pane;
    private readonly backgroundColour: { hidden: boolean };
    private readonly amounts: BudgetRows;
    private syncing = false;
    private readonly syncSoon = onceAFrame(() => {
        const { state } = this.session;
        if (state !== null) this.sync(state);
    });

    constructor(
        root: HTMLElement,
        private readonly session: Session,
        private readonly exposure: Exposure,
    ) {
        this.pane = new Pane({ container: root });
        this.addDisplayBindings();
        this.backgroundColour = this.addBackgroundBindings();
        this.amounts = this.addStrategyBindings();
        labelFields(root);
        session.stateChanged.listen(() => this.syncSoon());
        exposure.changed.listen(() => this.syncSoon());
    }

    private addDisplayBindings(): void {
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
        const colour = folder.addBinding(model, "colour", { view: "color" });
        colour.on("change", () => {
            this.apply({ background: { colour: linearFromHex(model.colour) } });
        });
        return colour;
    }

    private addStrategyBindings(): BudgetRows {
        const { model } = this;
        const folder = this.pane.addFolder({ title: "Relighting" });
        folder
            .addBinding(model, "method", {
                options: {
                    guarded: "guarded",
                    "per-band incremental": "pbi",
                    incremental: "bi",
                    "non-linear": "nwa",
                },
            })
            .on("change", () => this.apply({ strategy: { method: model.method } }));
        folder
            .addBinding(model, "priority", {
                options: {
                    "benefit per byte": "benefit",
                    transport: "transport",
                    area: "area",
                    magnitude: "none",
                },
            })
            .on("change", () => this.apply({ strategy: { priority: model.priority } }));
        folder
            .addBinding(model, "budget", {
                options: { "time per image": "milliseconds", coefficients: "coefficients" },
            })
            .on("change", () => {
                this.apply({ budget: this.budgetPatch() });
                this.showAmount();
            });
        const milliseconds = folder
            .addBinding(model, "milliseconds", {
                label: "ms",
                min: 0.5,
                max: kMostMilliseconds,
                step: 0.5,
            })
            .on("change", () => this.apply({ budget: this.budgetPatch() }));
        const coefficients = folder
            .addBinding(model, "coefficients", {
                label: "count",
                min: 1,
                max: kMostCoefficients,
                step: 1,
            })
            .on("change", () => this.apply({ budget: this.budgetPatch() }));
        folder
            .addBinding(model, "target", {
                label: "stop at",
                options: Object.fromEntries([
                    ["exact", 0],
                    ...[1e-4, 1e-3, 0.01, 0.05].map((error) => [percentText(error), error]),
                ]) as { [text: string]: number },
            })
            .on("change", () => this.apply({ budget: { target_error: model.target } }));
        return { milliseconds, coefficients };
    }

    private budgetPatch(): JsonObject {
        const { model } = this;
        return model.budget === "milliseconds"
            ? { milliseconds: model.milliseconds, coefficients: null }
            : { coefficients: Math.round(model.coefficients), milliseconds: null };
    }

    private apply(patch: JsonObject): void {
        if (!this.syncing) this.session.edit(patch);
    }

    private showAmount(): void {
        this.amounts.milliseconds.hidden = this.model.budget !== "milliseconds";
        this.amounts.coefficients.hidden = this.model.budget !== "coefficients";
    }

    private sync(state: RoomState): void {
        const { model } = this;
        const { display } = this.exposure;
        model.exposure = Math.min(
            kMaxExposureStops,
            Math.max(kMinExposureStops, display.exposure_stops),
        );
        model.tone = display.tone;
        model.background = state.background.mode;
        model.colour = hexFromLinear(state.background.colour);
        this.backgroundColour.hidden = model.background !== "colour";
        model.method = state.strategy.method;
        model.priority = state.strategy.priority;
        const { milliseconds, coefficients, target_error } = state.budget;
        model.budget = typeof coefficients === "number" ? "coefficients" : "milliseconds";
        if (typeof milliseconds === "number") model.milliseconds = milliseconds;
        if (typeof coefficients === "number") model.coefficients = coefficients;
        model.target = target_error;
        this.showAmount();
        this.syncing = true;
        this.pane.refresh();
        this.syncing = false;
    }
}
