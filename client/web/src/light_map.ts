/**
 * The small lat-long picture of the light. Round lights are added by a double click, moved by
 * dragging, resized by the wheel, removed by Delete; dragging beside them turns the environment.
 */
import { type AreaLights, lightsNow, nameOfLight } from "./area_lights";
import { amountText } from "./format";
import { notchesFromWheel, turnByDrag } from "./image_drag";
import {
    capOutline,
    directionFromPosition,
    type Position,
    positionFromDirection,
} from "./lat_long";
import { levelOfLight } from "./light_level";
import {
    kPictureHeight,
    environmentScale,
    kPictureWidth,
    LightPicture,
    type PictureSource,
} from "./light_picture";
import { onceAFrame } from "./once_a_frame";
import { listenForDrag } from "./pointer_drag";
import type { PreviewStore } from "./preview_store";
import type { RoomConnection } from "./room_connection";
import type { AreaLight } from "./wire/state";

const kSvg = "http://www.w3.org/2000/svg";
/** Units of the overlay: one per degree. */
const kWidth = 360;
const kHeight = 180;
const kResizePerNotch = 1.12;
const kStepDegrees = 2;
const kBigStepDegrees = 10;
const kCentreRadius = 4.5;
/** Small lights can be grasped as well as large ones. */
const kGraspRadius = 11;

export class LightMap {
    private readonly canvas = document.createElement("canvas");
    private readonly overlay = document.createElementNS(kSvg, "svg");
    private readonly picture = new LightPicture();
    private readonly shapes = new Map<string, SVGGElement>();
    private drawn = "";
    private readonly redrawSoon = onceAFrame(() => {
        this.drawPicture();
        this.drawLights();
    });

    constructor(
        private readonly root: HTMLElement,
        private readonly connection: RoomConnection,
        private readonly lights: AreaLights,
        private readonly previews: PreviewStore,
    ) {
        this.canvas.width = kPictureWidth;
        this.canvas.height = kPictureHeight;
        this.overlay.setAttribute("viewBox", `0 0 ${kWidth} ${kHeight}`);
        this.overlay.setAttribute("preserveAspectRatio", "none");
        root.append(this.canvas, this.overlay);

        connection.stateChanged.listen(() => this.redrawSoon());
        lights.selectionChanged.listen(() => this.redrawSoon());
        previews.loaded.listen(() => {
            this.drawn = "";
            this.redrawSoon();
        });
        root.addEventListener("dblclick", (event) => {
            if (event.target === this.overlay) {
                lights.add(directionFromPosition(this.positionOf(event)));
            }
        });
        listenForDrag(this.overlay, {
            start: (event) => {
                if (event.target !== this.overlay) return false;
                lights.select(null);
                return true;
            },
            move: (move) => turnByDrag(connection, move, 360 / Math.max(1, root.clientWidth)),
        });
    }

    private drawPicture(): void {
        const { state } = this.connection;
        if (state === null) return;
        const { environment, blend, rotation } = state;
        const other = blend.name ?? null;
        const amount = other === null ? 0 : blend.amount;
        const scale = environmentScale(state);
        const key = JSON.stringify([
            environment.name,
            other,
            amount,
            rotation.quaternion,
            scale,
        ]);
        if (key === this.drawn) return;
        const sources: PictureSource[] = [];
        const first = this.previews.get(environment.name);
        if (first !== null) sources.push({ pixels: first, weight: 1 - amount });
        const second = other === null || amount === 0 ? null : this.previews.get(other);
        if (second !== null) sources.push({ pixels: second, weight: amount });
        this.drawn = key;
        const image = this.picture.draw(sources, rotation.quaternion, scale);
        this.canvas.getContext("2d")?.putImageData(image, 0, 0);
    }

    private drawLights(): void {
        const lights = this.lights.all;
        for (const [id, shape] of this.shapes) {
            if (id in lights) continue;
            shape.remove();
            this.shapes.delete(id);
        }
        for (const [id, light] of Object.entries(lights)) {
            let shape = this.shapes.get(id);
            if (shape === undefined) {
                shape = this.makeShape(id);
                this.shapes.set(id, shape);
                this.overlay.append(shape);
            }
            this.drawLight(shape, id, light);
        }
    }

    private drawLight(shape: SVGGElement, id: string, light: AreaLight): void {
        const outline = capOutline(light.direction, light.angular_radius_degrees);
        const path = `M${outline.map(({ u, v }) => `${u * kWidth} ${v * kHeight}`).join("L")}Z`;
        const centre = positionFromDirection(light.direction);
        // Thrice, side by side: a light across the seam shows at both ends.
        [-1, 0, 1].forEach((turn, i) => {
            const copy = shape.children[i] as SVGGElement;
            copy.setAttribute("transform", `translate(${turn * kWidth} 0)`);
            copy.children[0]!.setAttribute("d", path);
            for (const circle of copy.querySelectorAll("circle")) {
                circle.setAttribute("cx", String(centre.u * kWidth));
                circle.setAttribute("cy", String(centre.v * kHeight));
            }
        });
        shape.style.setProperty("--light-colour", levelOfLight(light).colour);
        shape.classList.toggle("light-off", !lightsNow(light, this.lights.all));
        shape.classList.toggle("selected", id === this.lights.selected);
        shape.setAttribute(
            "aria-label",
            `Light ${nameOfLight(id, light)}: ` +
                `radius ${amountText(light.angular_radius_degrees)} degrees, ` +
                `azimuth ${Math.round(centre.u * 360 - 180)}, ` +
                `elevation ${Math.round(90 - centre.v * 180)} degrees`,
        );
    }

    private makeShape(id: string): SVGGElement {
        const shape = document.createElementNS(kSvg, "g");
        shape.setAttribute("class", "light");
        shape.setAttribute("tabindex", "0");
        shape.setAttribute("role", "button");
        shape.dataset["light"] = id;
        for (let i = 0; i < 3; ++i) {
            const copy = document.createElementNS(kSvg, "g");
            copy.append(
                document.createElementNS(kSvg, "path"),
                circleOf(kCentreRadius, "light-centre"),
                circleOf(kGraspRadius, "light-grasp"),
            );
            shape.append(copy);
        }
        shape.addEventListener("focus", () => this.lights.select(id));
        shape.addEventListener("keydown", (event) => this.press(id, event));
        shape.addEventListener(
            "wheel",
            (event) => {
                event.preventDefault();
                this.lights.resize(id, kResizePerNotch ** -notchesFromWheel(event));
            },
            { passive: false },
        );
        this.listenForMove(shape, id);
        return shape;
    }

    /** The light keeps its distance to the pointer, however small it is. */
    private listenForMove(shape: SVGGElement, id: string): void {
        let offset: Position = { u: 0, v: 0 };
        listenForDrag(shape, {
            start: (event) => {
                const light = this.lights.all[id];
                if (light === undefined) return false;
                shape.focus();
                const pointer = this.positionOf(event);
                const centre = positionFromDirection(light.direction);
                offset = { u: centre.u - pointer.u, v: centre.v - pointer.v };
                return true;
            },
            move: ({ event }) => {
                const { u, v } = this.positionOf(event);
                this.lights.aim(
                    id,
                    directionFromPosition({
                        u: u + offset.u,
                        v: Math.min(0.998, Math.max(0.002, v + offset.v)),
                    }),
                );
            },
        });
    }

    private press(id: string, event: KeyboardEvent): void {
        const light = this.lights.all[id];
        if (light === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
        const step = (event.shiftKey ? kBigStepDegrees : kStepDegrees) / 360;
        const { u, v } = positionFromDirection(light.direction);
        const aim = (du: number, dv: number): void => {
            const clamped = Math.min(0.998, Math.max(0.002, v + dv * 2));
            this.lights.aim(id, directionFromPosition({ u: u + du, v: clamped }));
        };
        if (event.key === "ArrowLeft") aim(-step, 0);
        else if (event.key === "ArrowRight") aim(step, 0);
        else if (event.key === "ArrowUp") aim(0, -step);
        else if (event.key === "ArrowDown") aim(0, step);
        else if (event.key === "+" || event.key === "=")
            this.lights.resize(id, kResizePerNotch);
        else if (event.key === "-") this.lights.resize(id, 1 / kResizePerNotch);
        else if (event.key === "Delete" || event.key === "Backspace") this.lights.remove(id);
        else return;
        event.preventDefault();
        event.stopPropagation();
    }

    private positionOf(event: MouseEvent): Position {
        const { left, top, width, height } = this.root.getBoundingClientRect();
        return { u: (event.clientX - left) / width, v: (event.clientY - top) / height };
    }
}

function circleOf(radius: number, className: string): SVGCircleElement {
    const circle = document.createElementNS(kSvg, "circle");
    circle.setAttribute("r", String(radius));
    circle.setAttribute("class", className);
    return circle;
}
