/** Text frames of the connection, server to client [protocol/README.md §3.1]. */
import { errorWords } from "./error_code";
import { isObject } from "./merge_patch";
import type {
    CameraState,
    Json,
    JsonObject,
    MaterialEdit,
    MaterialsShape,
    RoomState,
    Triple,
} from "./state";

/** A sphere around all that a scene shows, in the world. */
export interface SceneBounds {
    centre: Triple;
    radius: number;
}

/** A material whose curve and diffuse colour people edit, in scenes of kind `curves`. */
export interface EditableMaterial {
    /** Its key in the state's section `materials`. */
    id: string;
    /** In the scene's file. */
    name: string;
    /** That is edited, such as `distribution`. */
    curve: string;
    /** Over which the curve runs, such as `half`. */
    angle: string;
    shapes: MaterialsShape[];
    presets: string[];
    /** What it is without an edit. */
    baked: MaterialEdit;
}

/** A part of a scene that may be given another material. */
export interface ScenePart {
    /** Its key in the state's section `finishes`. */
    id: string;
    /** Of its material, in the scene's file. */
    name: string;
}

export interface SceneSummary {
    name: string;
    width: number;
    height: number;
    face_resolution: number;
    /** Relative L2 error that the bake's sampling leaves in an image, where the bake states it. */
    bake_error?: number;
    /** Where its rooms begin. */
    camera?: CameraState;
    /** Where the camera can move. */
    bounds?: SceneBounds;
    /** Of kind `curves`. */
    materials?: EditableMaterial[];
    /** Texels along a face of what the vertices see of the light, where they know it. */
    visibility_resolution?: number;
    /** Where vertices know what they see. */
    parts?: ScenePart[];
    /** The sections of the state that take edits. */
    edits?: string[];
}

export interface Snapshot {
    type: "snapshot";
    protocol: number;
    room: string;
    scene: SceneSummary;
    revision: number;
    state: RoomState;
    viewers: number;
    limits: { [name: string]: number };
}

export interface Change {
    type: "change";
    revision: number;
    patch: JsonObject;
    /** Present only for the author of the edit. */
    edit_id?: number;
}

export interface Refusal {
    type: "error";
    code: string;
    message: string;
    path?: string;
    found?: string;
    expected?: string;
    edit_id?: number;
}

export interface Viewers {
    type: "viewers";
    count: number;
}

export type ServerMessage = Snapshot | Change | Refusal | Viewers;

export const kProtocolVersion = 1;

/** Of a curve: sample k stands at u = k/255. */
export const kCurveSamples = 256;

export class WireError extends Error {
    override readonly name = "WireError";

    constructor(
        message: string,
        /** The field at fault, where it is one. */
        readonly field?: string,
    ) {
        super(message);
    }
}

function numberAt(object: JsonObject, key: string): number {
    const value = object[key];
    if (typeof value !== "number") {
        throw new WireError(`"${key}" is ${JSON.stringify(value)}, expected a number`);
    }
    return value;
}

function textAt(object: JsonObject, key: string): string {
    const value = object[key];
    if (typeof value !== "string") {
        throw new WireError(`"${key}" is ${JSON.stringify(value)}, expected a string`);
    }
    return value;
}

function objectAt(object: JsonObject, key: string): JsonObject {
    const value = object[key];
    if (!isObject(value)) {
        throw new WireError(`"${key}" is ${JSON.stringify(value)}, expected an object`);
    }
    return value;
}

/** `found` and `expected` may be any JSON value; people read them, so they become text. */
function optionalText(value: Json | undefined): string | undefined {
    if (value === undefined || value === null || value === "") return undefined;
    return typeof value === "string" ? value : JSON.stringify(value);
}

function tripleAt(object: JsonObject, key: string): Triple {
    const value = object[key];
    const isTriple =
        Array.isArray(value) &&
        value.length === 3 &&
        value.every((number) => typeof number === "number");
    if (!isTriple) {
        throw new WireError(`"${key}" is ${JSON.stringify(value)}, expected three numbers`);
    }
    return value as Triple;
}

function textsAt(object: JsonObject, key: string): string[] {
    const value = object[key];
    if (!Array.isArray(value) || !value.every((text) => typeof text === "string")) {
        throw new WireError(`"${key}" is ${JSON.stringify(value)}, expected strings`);
    }
    return value as string[];
}

function materialFromJson(json: Json): EditableMaterial {
    if (!isObject(json)) {
        throw new WireError(`a material is ${JSON.stringify(json)}, expected an object`);
    }
    const baked = objectAt(json, "baked");
    const { samples } = baked;
    const isCurve =
        Array.isArray(samples) &&
        samples.length === kCurveSamples &&
        samples.every((rgb) => Array.isArray(rgb) && rgb.length === 3);
    if (!isCurve) {
        throw new WireError(
            `"samples" of a material are ${JSON.stringify(samples)?.slice(0, 60)}, ` +
                `expected ${kCurveSamples} of three numbers`,
        );
    }
    return {
        id: textAt(json, "id"),
        name: textAt(json, "name"),
        curve: textAt(json, "curve"),
        angle: textAt(json, "angle"),
        shapes: textsAt(json, "shapes") as MaterialsShape[],
        presets: textsAt(json, "presets"),
        baked: baked as unknown as MaterialEdit,
    };
}

function partFromJson(json: Json): ScenePart {
    if (!isObject(json)) {
        throw new WireError(`a part is ${JSON.stringify(json)}, expected an object`);
    }
    return { id: textAt(json, "id"), name: textAt(json, "name") };
}

/** What an older server does not say is left out. */
function sceneFromJson(json: JsonObject): SceneSummary {
    const scene: SceneSummary = {
        name: textAt(json, "name"),
        width: numberAt(json, "width"),
        height: numberAt(json, "height"),
        face_resolution: numberAt(json, "face_resolution"),
    };
    const { bake_error: bakeError, bounds, camera, edits, materials } = json;
    if (typeof bakeError === "number") scene.bake_error = bakeError;
    if (isObject(bounds)) {
        scene.bounds = {
            centre: tripleAt(bounds, "centre"),
            radius: numberAt(bounds, "radius"),
        };
    }
    if (isObject(camera)) {
        scene.camera = {
            eye: tripleAt(camera, "eye"),
            look_at: tripleAt(camera, "look_at"),
            up: tripleAt(camera, "up"),
            fov_degrees: numberAt(camera, "fov_degrees"),
        };
    }
    if (Array.isArray(materials)) scene.materials = materials.map(materialFromJson);
    const { parts, visibility_resolution: resolution } = json;
    if (Array.isArray(parts)) scene.parts = parts.map(partFromJson);
    if (typeof resolution === "number") scene.visibility_resolution = resolution;
    if (Array.isArray(edits)) {
        scene.edits = edits.filter((section): section is string => typeof section === "string");
    }
    return scene;
}

export function refusalFromJson(json: JsonObject): Refusal {
    const refusal: Refusal = {
        type: "error",
        code: textAt(json, "code"),
        message: textAt(json, "message"),
    };
    const path = optionalText(json["path"]);
    const found = optionalText(json["found"]);
    const expected = optionalText(json["expected"]);
    if (path !== undefined) refusal.path = path;
    if (found !== undefined) refusal.found = found;
    if (expected !== undefined) refusal.expected = expected;
    if (typeof json["edit_id"] === "number") refusal.edit_id = json["edit_id"];
    return refusal;
}

/** The message repeats what was found and expected; where those stand apart, words will do. */
export function titleOf(refusal: Refusal): string {
    const isApart = refusal.found !== undefined && refusal.expected !== undefined;
    return (isApart ? errorWords(refusal.code) : null) ?? refusal.message;
}

/**
 * Parses a text frame; null for a type this version does not know, which a newer server may
 * send. Throws WireError naming what was found where the frame is malformed.
 */
export function messageFromText(text: string): ServerMessage | null {
    let json: Json;
    try {
        json = JSON.parse(text) as Json;
    } catch {
        throw new WireError(`text frame is not JSON: ${text.slice(0, 80)}`);
    }
    if (!isObject(json)) throw new WireError("text frame is not a JSON object");
    switch (json["type"]) {
        case "snapshot": {
            const protocol = numberAt(json, "protocol");
            if (protocol !== kProtocolVersion) {
                throw new WireError(
                    `server speaks protocol ${protocol}, this page ${kProtocolVersion}`,
                );
            }
            return {
                type: "snapshot",
                protocol,
                room: textAt(json, "room"),
                scene: sceneFromJson(objectAt(json, "scene")),
                revision: numberAt(json, "revision"),
                state: objectAt(json, "state") as unknown as RoomState,
                viewers: numberAt(json, "viewers"),
                limits: objectAt(json, "limits") as { [name: string]: number },
            };
        }
        case "change": {
            const change: Change = {
                type: "change",
                revision: numberAt(json, "revision"),
                patch: objectAt(json, "patch"),
            };
            if (typeof json["edit_id"] === "number") change.edit_id = json["edit_id"];
            return change;
        }
        case "error":
            return refusalFromJson(json);
        case "viewers":
            return { type: "viewers", count: numberAt(json, "count") };
        default:
            textAt(json, "type");
            return null;
    }
}
