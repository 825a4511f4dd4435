/** Edits of the room's round area lights, and which of them is selected on this page. */
import { radianceAtRadius } from "./light_level";
import { newLight, nextOrder, type Picture } from "./new_light";
import type { RoomConnection } from "./room_connection";
import { Signal } from "./signal";
import { clampTo } from "./wire/range";
import {
    type AreaLight,
    type JsonObject,
    kRanges,
    type RoomState,
    type Triple,
} from "./wire/state";

const kMostNameCharacters = 64;
const kCopyTurnDegrees = 15;

type Lights = { [id: string]: AreaLight };

/** In ascending `order`, equals by id. */
export function orderedLights(lights: Lights): [string, AreaLight][] {
    return Object.entries(lights).sort(
        ([a, first], [b, second]) =>
            (first.order ?? 0) - (second.order ?? 0) || (a < b ? -1 : a > b ? 1 : 0),
    );
}

export function nameOfLight(id: string, light: AreaLight): string {
    return light.name ?? id;
}

/** What the server takes as a light's name; null where nothing is left of `text`. */
export function lightNameFromText(text: string): string | null {
    // eslint-disable-next-line no-control-regex
    const kept = [...text.replace(/[\u0000-\u001f\u007f-\u009f]+/g, " ").trim()];
    const name = kept.slice(0, kMostNameCharacters).join("").trim();
    return name === "" ? null : name;
}

export function soloLights(state: RoomState): [string, AreaLight][] {
    return orderedLights(state.lights).filter(([, light]) => light.solo);
}

/** Lights the scene at present, by mute and solo. */
export function lightsNow(light: AreaLight, lights: Lights): boolean {
    const anySolo = Object.values(lights).some((other) => other.solo);
    return !light.muted && light.gain > 0 && (light.solo || !anySolo);
}

/** `taken` is a name that a copy must not repeat: "Key 2", then "Key 3". */
function copyName(name: string, taken: Set<string>): string {
    const stem = name.replace(/ \d+$/, "");
    for (let number = 2; ; ++number) {
        const suffix = ` ${number}`;
        const copy = [...stem].slice(0, kMostNameCharacters - suffix.length).join("") + suffix;
        if (!taken.has(copy)) return copy;
    }
}

export class AreaLights {
    readonly selectionChanged = new Signal<string | null>();
    /** Whether resizing keeps a light's power, or its radiance. */
    keepsPower = true;
    private selectedId: string | null = null;

    constructor(
        private readonly connection: RoomConnection,
        private readonly picture: () => Picture,
    ) {
        connection.stateChanged.listen((state) => {
            if (this.selectedId !== null && !(this.selectedId in state.lights))
                this.select(null);
        });
    }

    get all(): Lights {
        return this.connection.state?.lights ?? {};
    }

    get selected(): string | null {
        return this.selectedId;
    }

    select(id: string | null): void {
        if (id === this.selectedId) return;
        this.selectedId = id;
        this.selectionChanged.send(id);
    }

    /** Returns the new light's id, or null where the room is full or cannot be reached. */
    add(direction?: Triple): string | null {
        const { id, light } = newLight(this.all, this.picture(), direction);
        return this.put(id, light);
    }

    /** A copy beside the light, with its own name. */
    duplicate(id: string): string | null {
        const { all } = this;
        const light = all[id];
        if (light === undefined) return null;
        const names = new Set(Object.entries(all).map(([key, l]) => nameOfLight(key, l)));
        const [x, y, z] = light.direction;
        const turn = (kCopyTurnDegrees * Math.PI) / 180;
        const [cosine, sine] = [Math.cos(turn), Math.sin(turn)];
        return this.put(newLight(all, this.picture()).id, {
            ...light,
            direction: [cosine * x + sine * z, y, cosine * z - sine * x],
            name: copyName(nameOfLight(id, light), names),
            order: nextOrder(all),
        });
    }

    remove(id: string): void {
        if (id in this.all) this.connection.edit({ lights: { [id]: null } });
    }

    aim(id: string, direction: Triple): void {
        this.change(id, { direction });
    }

    rename(id: string, text: string): void {
        const light = this.all[id];
        const name = lightNameFromText(text);
        if (light === undefined || name === (light.name ?? null)) return;
        this.change(id, { name: name === id ? null : name });
    }

    toggle(id: string, key: "muted" | "solo"): void {
        const light = this.all[id];
        if (light !== undefined) this.change(id, { [key]: !light[key] });
    }

    endSolo(): void {
        const { state } = this.connection;
        if (state === null) return;
        const solo = soloLights(state).map(([id]) => [id, { solo: false }] as const);
        if (solo.length > 0) this.connection.edit({ lights: Object.fromEntries(solo) });
    }

    /** By a factor; stays within what the server takes. */
    resize(id: string, factor: number): void {
        const light = this.all[id];
        if (light !== undefined) this.setRadius(id, light.angular_radius_degrees * factor);
    }

    setRadius(id: string, degrees: number): void {
        const light = this.all[id];
        if (light === undefined) return;
        const radius = clampTo(kRanges.lights.angular_radius_degrees, degrees);
        this.change(id, {
            angular_radius_degrees: radius,
            ...(this.keepsPower ? { radiance: radianceAtRadius(light, radius) } : {}),
        });
    }

    change(id: string, fields: Partial<AreaLight>): void {
        this.connection.edit({ lights: { [id]: { ...fields } as JsonObject } });
    }

    private put(id: string, light: AreaLight): string | null {
        const most = this.connection.snapshot?.limits["lights_per_room"] ?? 64;
        const isFull = Object.keys(this.all).length >= most;
        const isTaken = this.connection.status.kind === "open" && this.connection.takes("lights");
        if (!isTaken || isFull) return null;
        this.change(id, light);
        this.select(id);
        return id;
    }
}
