/**
 * The lighting of a room as a file: the part of its state that is artistic, as an edit's patch,
 * which is what `relume render --patch @FILE` takes.
 */
import { isObject } from "./wire/merge_patch";
import {
    type DisplayState,
    type Json,
    type JsonObject,
    kAbsent,
    kStages,
    type RoomState,
} from "./wire/state";

/** All but the image's size and camera. A file may say how to relight as well. */
const kSections = (Object.keys(kStages) as (keyof RoomState)[]).filter(
    (key) => key !== "image" && key !== "camera",
);

/** What is artistic: all but how images are worked out. */
const kLightingSections = kSections.filter((key) => kStages[key] !== "policy");

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

/** With how to relight. */
export function wholeLightingOf(state: RoomState): Lighting {
    return Object.fromEntries(kSections.map((key) => [key, state[key]])) as Lighting;
}

/** With the display that its viewer sees. */
export function lightingOf(state: RoomState, display: DisplayState): Lighting {
    const sections = kLightingSections.map((key) => [key, state[key]]);
    return { ...Object.fromEntries(sections), display } as Lighting;
}

export function textFromLighting(lighting: Lighting): string {
    return `${JSON.stringify(lighting, null, 2)}\n`;
}

/** A file may leave sections out; the server checks what is in them. Size and camera are passed over. */
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
    const other = Object.keys(json).filter((key) => !(key in kStages));
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
    return Object.fromEntries(sections.map((key) => [key, json[key]])) as unknown as Lighting;
}

/**
 * The edit that takes a room to a lighting, whole: lights that it does not have go, names that
 * it does not give are taken away. Sections that it leaves out stay as they are.
 */
export function patchToLighting(from: RoomState, to: Lighting): JsonObject {
    const patch: JsonObject = {};
    for (const key of kSections) {
        const section = to[key] as JsonObject | undefined;
        if (section === undefined) continue;
        const absent = Object.fromEntries((kAbsent[key] ?? []).map((field) => [field, null]));
        if (key === "lights" || key === "materials" || key === "finishes") {
            const gone = Object.keys(from[key] ?? {}).filter((id) => !(id in section));
            const there = Object.entries(section as { [id: string]: JsonObject });
            patch[key] = Object.fromEntries<Json>([
                ...gone.map((id): [string, null] => [id, null]),
                ...there.map(([id, entry]): [string, Json] => [id, { ...absent, ...entry }]),
            ]);
        } else {
            patch[key] = { ...absent, ...section };
        }
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
