/**
 * The lighting of a room as a file: the part of its state that is artistic, as an edit's patch,
 * which is what `relume render --patch @FILE` takes.
 */
import { isObject } from "./wire/merge_patch";
import type { DisplayState, Json, JsonObject, RoomState } from "./wire/state";

export const kLightingSections = [
    "environment",
    "blend",
    "rotation",
    "lights",
    "background",
    "display",
] as const;

/** A file may say how to relight as well. */
const kSections = [...kLightingSections, "strategy", "budget"] as const;

export type Lighting = Partial<RoomState>;

export class LightingError extends Error {
    override readonly name = "LightingError";

    constructor(
        message: string,
        readonly found: string,
        readonly expected: string,
    ) {
        super(message);
    }
}

/** With the display that its viewer sees. */
export function lightingOf(state: RoomState, display: DisplayState): Lighting {
    const { environment, blend, rotation, lights, background } = state;
    return { environment, blend, rotation, lights, background, display };
}

export function textFromLighting(lighting: Lighting): string {
    return `${JSON.stringify(lighting, null, 2)}\n`;
}

/** A file may leave sections out; the server checks what is in them. */
export function lightingFromText(text: string): Lighting {
    let json: Json;
    try {
        json = JSON.parse(text) as Json;
    } catch (error) {
        const words = error instanceof Error ? error.message : String(error);
        throw new LightingError(
            "This file is not JSON",
            words,
            "a lighting saved by this page",
        );
    }
    const known: readonly string[] = kSections;
    if (!isObject(json)) {
        throw new LightingError(
            "This file holds no lighting",
            JSON.stringify(json).slice(0, 60),
            `an object with ${known.join(", ")}`,
        );
    }
    const other = Object.keys(json).filter((key) => !known.includes(key));
    const sections = known.filter((key) => key in json);
    if (other.length > 0 || sections.length === 0) {
        throw new LightingError(
            "This file holds no lighting",
            other.length > 0 ? other.slice(0, 6).join(", ") : "an empty object",
            `some of ${known.join(", ")}`,
        );
    }
    for (const key of sections) {
        if (!isObject(json[key])) {
            throw new LightingError(
                `"${key}" is no part of a lighting`,
                JSON.stringify(json[key]).slice(0, 60),
                "an object",
            );
        }
    }
    return json as unknown as Lighting;
}

/**
 * The edit that takes a room to a lighting, whole: lights that it does not have go, names that
 * it does not give are taken away. Sections that it leaves out stay as they are.
 */
export function patchToLighting(from: RoomState, to: Lighting): JsonObject {
    const patch: JsonObject = {};
    for (const key of [
        "environment",
        "rotation",
        "background",
        "strategy",
        "display",
    ] as const) {
        if (to[key] !== undefined) patch[key] = to[key] as unknown as JsonObject;
    }
    if (to.blend !== undefined) {
        patch["blend"] = { amount: to.blend.amount ?? 0, name: to.blend.name ?? null };
    }
    if (to.budget !== undefined) {
        const { milliseconds = null, coefficients = null, target_error = 0 } = to.budget;
        patch["budget"] = { milliseconds, coefficients, target_error };
    }
    if (to.lights !== undefined) {
        const lights: JsonObject = {};
        for (const id of Object.keys(from.lights)) {
            if (!(id in to.lights)) lights[id] = null;
        }
        for (const [id, light] of Object.entries(to.lights)) {
            lights[id] = { ...light, name: light.name ?? null } as unknown as JsonObject;
        }
        patch["lights"] = lights;
    }
    return patch;
}

/** Maps that a lighting asks for by name. */
export function mapsOf({ environment, blend }: Lighting): string[] {
    const names = [environment?.name, blend?.name].filter(
        (name): name is string => typeof name === "string",
    );
    return [...new Set(names)];
}

/** The same without the maps named in `missing`: what else it says stays. */
export function withoutMaps(lighting: Lighting, missing: string[]): Lighting {
    const { environment, blend, ...rest } = lighting;
    const kept: Lighting = { ...rest };
    if (environment !== undefined) {
        const { name, ...others } = environment;
        kept.environment = (
            missing.includes(name) ? others : environment
        ) as RoomState["environment"];
    }
    if (blend !== undefined) {
        const isMissing = typeof blend.name === "string" && missing.includes(blend.name);
        kept.blend = isMissing ? { amount: 0, name: null } : blend;
    }
    return kept;
}
