/**
 * The curve of the selected material under the hand: drawn, smoothed or moved by control points,
 * its colours together or apart, over a linear or a logarithmic axis.
 */
import { degreesFromU, wordsOfAngle } from "./curve_angle";
import { axisEnd, CurveAxes, highestOf, type ValueAxis } from "./curve_axes";
import { CurveCanvas } from "./curve_canvas";
import { CurveHand, type CurveTool } from "./curve_hand";
import { pointsFromSamples } from "./curve_points";
import type { Channels } from "./curve_stroke";
import { make, setText } from "./dom";
import { amountText } from "./format";
import type { Materials } from "./materials";
import { onceAFrame } from "./once_a_frame";
import type { RoomConnection } from "./room_connection";
import type { MaterialEdit } from "./wire/state";

const kChannels = {
    RGB: [true, true, true],
    R: [true, false, false],
    G: [false, true, false],
    B: [false, false, true],
} as const satisfies { [name: string]: Channels };

const kTools: { [tool in CurveTool]: { title: string; words: string } } = {
    draw: { title: "Draw", words: "Draw over the curve (D)" },
    smooth: { title: "Smooth", words: "Smooth what the hand passes (M)" },
    points: { title: "Points", words: "Move control points; double-click adds or removes (P)" },
};

export class CurveEditor {
    tool: CurveTool = "draw";
    channels: Channels = kChannels.RGB;
    readonly canvas = new CurveCanvas();
    readonly showSoon = onceAFrame(() => this.show());
    private readonly readout = make("p", "curve-readout", { role: "status" });
    private readonly hand: CurveHand;
    private kind: ValueAxis = "linear";
    /** While a drag lasts the axis stands still under the hand. */
    private heldAxisEnd: number | null = null;

    constructor(
        private readonly root: HTMLElement,
        private readonly connection: RoomConnection,
        readonly materials: Materials,
    ) {
        const frame = make("div", "curve-frame", {
            tabindex: "0",
            role: "group",
            "aria-label":
                "Curve. Left and right choose a place or a point, up and down change its value, " +
                "Shift moves a point sideways, Insert adds one, Delete removes one.",
        });
        frame.append(this.canvas.element);
        root.append(this.makeTools(), frame, this.readout);
        this.hand = new CurveHand(frame, this);
        new ResizeObserver(() => this.show()).observe(frame);
        connection.stateChanged.listen(() => this.showSoon());
        connection.statusChanged.listen(() => this.showSoon());
        materials.selectionChanged.listen(() => this.showSoon());
        materials.history.changed.listen(() => this.showSoon());
    }

    get isOpen(): boolean {
        return this.connection.status.kind === "open";
    }

    get edit(): MaterialEdit | null {
        return this.materials.edit;
    }

    get scale(): ValueAxis {
        return this.kind;
    }

    get axes(): CurveAxes | null {
        const { edit } = this;
        if (edit === null) return null;
        const highest = axisEnd(Math.max(highestOf(edit.samples, edit.tint), this.ghostHighest));
        return new CurveAxes(this.canvas.box, this.kind, this.heldAxisEnd ?? highest);
    }

    /** The points of the edit, or those that a hand would begin with. */
    get points(): number[][] {
        const { edit } = this;
        if (edit === null) return [];
        return edit.points ?? pointsFromSamples(edit.samples, this.kind);
    }

    /** A drag begins, or ends. */
    hold(isHeld: boolean): void {
        this.heldAxisEnd = isHeld ? (this.axes?.highest ?? null) : null;
        if (!isHeld) this.materials.history.end();
        this.showSoon();
    }

    choose(tool: CurveTool): void {
        this.tool = tool;
        this.hand.forget();
        press(this.root, "tool", tool);
        this.showSoon();
    }

    /** Where a hand or the keyboard is: angle and colours of the curve there. */
    tell(u: number): void {
        const { edit } = this;
        const angle = this.materials.selected?.angle;
        if (edit === null || angle === undefined) return;
        const rgb = edit.samples[Math.round(u * (edit.samples.length - 1))]!;
        const colours = rgb.map((value, c) => amountText(value * edit.tint[c]!));
        const isGrey = colours.every((text) => text === colours[0]);
        const value = isGrey ? colours[0]! : colours.join(" · ");
        setText(this.readout, `${degreesFromU(angle, u).toFixed(1)}°   ${value}`);
    }

    private get ghost(): MaterialEdit | null {
        const { selected, history } = this.materials;
        if (selected === null) return null;
        const before = history.before(selected.id);
        return before === undefined ? null : (before ?? selected.baked);
    }

    private get ghostHighest(): number {
        const { ghost } = this;
        return ghost === null ? 0 : highestOf(ghost.samples, ghost.tint);
    }

    private show(): void {
        const { axes, edit } = this;
        const { selected } = this.materials;
        if (axes === null || edit === null || selected === null) return;
        if (this.root.closest("[hidden]") !== null) return;
        this.root.classList.toggle("curve-off", !this.isOpen);
        if (this.readout.textContent === "") setText(this.readout, wordsOfAngle(selected.angle));
        this.canvas.draw({
            axes,
            angle: selected.angle,
            samples: edit.samples,
            tint: edit.tint,
            ghost: this.ghost,
            channels: this.channels,
            points: this.tool === "points" ? this.points : null,
            chosen: this.hand.chosen,
            cursor: this.hand.cursor,
        });
    }

    private makeTools(): HTMLElement {
        const tools = make("div", "curve-tools", { role: "group", "aria-label": "Curve tools" });
        for (const tool of Object.keys(kTools) as CurveTool[]) {
            const { title, words } = kTools[tool];
            tools.append(this.makeChoice(title, words, "tool", tool, () => this.choose(tool)));
        }
        const channels = make("div", "curve-tools", { role: "group", "aria-label": "Colours" });
        for (const name of Object.keys(kChannels) as (keyof typeof kChannels)[]) {
            const words = name === "RGB" ? "All colours together" : `${name} alone`;
            const choose = (): void => {
                this.channels = kChannels[name];
                press(channels, "channels", name);
                this.showSoon();
            };
            channels.append(this.makeChoice(name, words, "channels", name, choose));
        }
        const axis = this.makeChoice("Log", "Logarithmic values (G)", "axis", "log", () =>
            this.toggleAxis(),
        );
        const all = make("div", "curve-bar", {}, tools, channels, axis);
        press(all, "tool", this.tool);
        press(all, "channels", "RGB");
        press(all, "axis", "");
        return all;
    }

    toggleAxis(): void {
        this.kind = this.kind === "linear" ? "logarithmic" : "linear";
        press(this.root, "axis", this.kind === "linear" ? "" : "log");
        this.showSoon();
    }

    private makeChoice(
        title: string,
        words: string,
        group: string,
        value: string,
        choose: () => void,
    ): HTMLElement {
        const button = make(
            "button",
            "small-button curve-choice",
            { type: "button", title: words, [`data-${group}`]: value },
            title,
        );
        button.addEventListener("click", choose);
        return button;
    }
}

/** Of a group of buttons one is pressed. */
function press(root: HTMLElement, group: string, value: string): void {
    root.querySelectorAll<HTMLElement>(`[data-${group}]`).forEach((button) => {
        button.setAttribute("aria-pressed", String(button.dataset[group] === value));
    });
}
