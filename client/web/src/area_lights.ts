/** Edits of the room's round area lights, and which of them is selected on this page. */
import type { Session } from "./session";
import { Signal } from "./signal";
import type { AreaLight, JsonObject, Triple } from "./wire/state";

export const kSmallestRadiusDegrees = 0.05;
export const kLargestRadiusDegrees = 90;

const kFirstNames = ["key", "fill", "rim"];
const kNewRadiusDegrees = 6;
const kNewRadiance: Triple = [120, 120, 120];
/** High, to the right, towards the viewer of a scene seen along −Z. */
const kNewDirection: Triple = [0.45, 0.75, 0.5];

export class AreaLights {
    readonly selectionChanged = new Signal<string | null>();
    private selectedId: string | null = null;

    constructor(private readonly session: Session) {
        session.stateChanged.listen((state) => {
            if (this.selectedId !== null && !(this.selectedId in state.lights))
                this.select(null);
        });
    }

    get all(): { [id: string]: AreaLight } {
        return this.session.state?.lights ?? {};
    }

    get selected(): string | null {
        return this.selectedId;
    }

    select(id: string | null): void {
        if (id === this.selectedId) return;
        this.selectedId = id;
        this.selectionChanged.send(id);
    }

    /** Returns the new light's name, or null where the room is full or cannot be reached. */
    add(direction: Triple = kNewDirection): string | null {
        const count = Object.keys(this.all).length;
        const most = this.session.snapshot?.limits["lights_per_room"] ?? 64;
        if (this.session.status.kind !== "open" || count >= most) return null;
        const id = this.freeName();
        this.change(id, {
            direction,
            angular_radius_degrees: kNewRadiusDegrees,
            radiance: kNewRadiance,
            gain: 1,
            tint: [1, 1, 1],
        });
        this.select(id);
        return id;
    }

    remove(id: string): void {
        if (id in this.all) this.session.edit({ lights: { [id]: null } });
    }

    aim(id: string, direction: Triple): void {
        this.change(id, { direction });
    }

    /** By a factor; stays within what the server takes. */
    resize(id: string, factor: number): void {
        const light = this.all[id];
        if (light === undefined) return;
        const degrees = light.angular_radius_degrees * factor;
        this.change(id, {
            angular_radius_degrees: Math.min(
                kLargestRadiusDegrees,
                Math.max(kSmallestRadiusDegrees, degrees),
            ),
        });
    }

    change(id: string, fields: Partial<AreaLight>): void {
        this.session.edit({ lights: { [id]: { ...fields } as JsonObject } });
    }

    private freeName(): string {
        const { all } = this;
        const free = kFirstNames.find((name) => !(name in all));
        if (free !== undefined) return free;
        let number = kFirstNames.length + 1;
        while (`light-${number}` in all) ++number;
        return `light-${number}`;
    }
}
