/** How the scene is relit: method, priority, budget. Few need it, so it is folded away. */
import type { FolderApi } from "tweakpane";
import { make } from "./dom";
import { percentText } from "./format";
import { labelFields } from "./pane_labels";
import type { RoomConnection } from "./room_connection";
import { StatePane } from "./state_pane";
import type { JsonObject, RoomState, StrategyMethod, StrategyPriority } from "./wire/state";

type BudgetKind = "milliseconds" | "coefficients";
type BudgetRows = { [kind in BudgetKind]: { hidden: boolean } };

/** The sliders'; any value the server takes can be typed. */
const kMostMilliseconds = 50;
const kMostCoefficients = 2000;
const kDefaultMilliseconds = 8;
const kDefaultCoefficients = 100;

export class StrategyPanel {
    private readonly model = {
        method: "guarded" as StrategyMethod,
        priority: "benefit" as StrategyPriority,
        budget: "milliseconds" as BudgetKind,
        milliseconds: kDefaultMilliseconds,
        coefficients: kDefaultCoefficients,
        target: 0,
    };
    private readonly controls: StatePane;
    private readonly amounts: BudgetRows;

    constructor(
        root: HTMLElement,
        connection: RoomConnection,
    ) {
        this.controls = new StatePane(root, connection, (state) => this.show(state));
        const folder = this.controls.pane.addFolder({ title: "Advanced", expanded: false });
        this.addStrategyBindings(folder);
        this.amounts = this.addBudgetBindings(folder);
        this.addTargetBinding(folder);
        labelFields(root);
    }

    private addStrategyBindings(folder: FolderApi): void {
        const { model } = this;
        const method = folder.addBinding(model, "method", {
            options: {
                guarded: "guarded",
                "per-band incremental": "pbi",
                incremental: "bi",
                "non-linear": "nwa",
            },
        });
        method.on("change", () => this.controls.edit({ strategy: { method: model.method } }));
        explain(
            method,
            "Which parts of the light each image adds. Guarded begins anew only where that " +
                "brings the image nearer.",
        );
        const priority = folder.addBinding(model, "priority", {
            options: {
                "benefit per byte": "benefit",
                transport: "transport",
                area: "area",
                magnitude: "none",
            },
        });
        priority.on("change", () => this.controls.edit({ strategy: { priority: model.priority } }));
        explain(priority, "What comes first while the light moves; at rest all of it comes.");
    }

    private addBudgetBindings(folder: FolderApi): BudgetRows {
        const { model } = this;
        const kind = folder.addBinding(model, "budget", {
            options: { "time per image": "milliseconds", coefficients: "coefficients" },
        });
        kind.on("change", () => {
            this.controls.edit({ budget: this.budgetPatch() });
            this.showAmount();
        });
        explain(kind, "How much an image may cost: less is quicker and further from exact.");
        const slider = (key: BudgetKind, label: string, step: number, max: number) =>
            folder
                .addBinding(model, key, { label, min: step, max, step })
                .on("change", () => this.controls.edit({ budget: this.budgetPatch() }));
        return {
            milliseconds: slider("milliseconds", "ms", 0.5, kMostMilliseconds),
            coefficients: slider("coefficients", "count", 1, kMostCoefficients),
        };
    }

    private addTargetBinding(folder: FolderApi): void {
        const { model } = this;
        const target = folder.addBinding(model, "target", {
            label: "stop at",
            options: Object.fromEntries([
                ["exact", 0],
                ...[1e-4, 1e-3, 0.01, 0.05].map((error) => [percentText(error), error]),
            ]) as { [text: string]: number },
        });
        target.on("change", () => this.controls.edit({ budget: { target_error: model.target } }));
        explain(target, "The error at which a resting image counts as settled.");
    }

    private budgetPatch(): JsonObject {
        const { model } = this;
        return model.budget === "milliseconds"
            ? { milliseconds: model.milliseconds, coefficients: null }
            : { coefficients: Math.round(model.coefficients), milliseconds: null };
    }

    private showAmount(): void {
        this.amounts.milliseconds.hidden = this.model.budget !== "milliseconds";
        this.amounts.coefficients.hidden = this.model.budget !== "coefficients";
    }

    private show(state: RoomState): void {
        const { model } = this;
        model.method = state.strategy.method;
        model.priority = state.strategy.priority;
        const { milliseconds, coefficients, target_error } = state.budget;
        model.budget = typeof coefficients === "number" ? "coefficients" : "milliseconds";
        if (typeof milliseconds === "number") model.milliseconds = milliseconds;
        if (typeof coefficients === "number") model.coefficients = coefficients;
        model.target = target_error;
        this.showAmount();
    }
}

/** A line of words below a control. */
function explain({ element }: { element: HTMLElement }, words: string): void {
    element.append(make("p", "blade-note", {}, words));
}
