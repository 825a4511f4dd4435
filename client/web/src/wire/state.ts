/**
 * The state of a room as protocol/README.md §3.1 defines it. Angles are degrees.
 *
 * Written by describe_state out of protocol/wire/sections; a test compares.
 */

export type Triple = [number, number, number];
/** w, x, y, z; unit length; world direction = R · source direction. */
export type Quaternion = [number, number, number, number];

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

export interface Range {
    lowest: number;
    highest: number;
}

export type MaterialsScale = "linear" | "logarithmic";
export type MaterialsShape = "beckmann" | "ggx" | "velvet" | "conductor" | "dielectric" | "schlick" | "cosine_power" | "constant";
export type BackgroundMode = "environment" | "colour" | "transparent";
export type StrategyMethod = "nwa" | "bi" | "pbi" | "guarded";
export type StrategyPriority = "area" | "none" | "transport" | "benefit";
export type DisplayTone = "filmic" | "linear";

/** The map that lights the scene. */
export interface EnvironmentState {
    /** The map, by its name in `/api/environments`. */
    name: string;
    /** Times the map's radiance. */
    gain: number;
    /** Times the map's radiance, by colour. */
    tint: Triple;
}

/** A second map, mixed with the first. */
export interface BlendState {
    /** The second map; without one there is none to mix. */
    name?: string | null;
    /** Radiance is `(1−amount)·environment + amount·blend`, gain and tint on both. */
    amount: number;
}

/** How environment and blend are turned. */
export interface RotationState {
    /** R; world direction = R · source direction; lights are not turned. */
    quaternion: Quaternion;
}

/** Round lights at infinity, by ID. */
export interface AreaLight {
    /** Towards the light, in the world. */
    direction: Triple;
    /** Half the angle that the disc spans. */
    angular_radius_degrees: number;
    /** Of the whole disc, linear Rec. 709. */
    radiance: Triple;
    /** Times the radiance. */
    gain: number;
    /** Times the radiance, by colour. */
    tint: Triple;
    /** What people call the light; without one it is called by its ID. */
    name?: string | null;
    /** It does not light. */
    muted: boolean;
    /** While any light is solo, only solo lights light. */
    solo: boolean;
    /** Lists show lights in ascending order; a new light without one comes last. */
    order: number;
}

/** Edited materials, by their names in the scene. */
export interface MaterialEdit {
    /** Of the curve, r, g, b at u = k/255. */
    samples: number[][];
    /** U, r, g, b of the control points that the samples were made from. */
    points?: number[][] | null;
    /** Of the values between control points. */
    scale: MaterialsScale;
    /** That the samples were made from, with the parameters below. */
    shape?: MaterialsShape | null;
    /** σ of shapes `beckmann` and `velvet`, α of `ggx`. */
    roughness: number;
    /** Of shape `cosine_power`. */
    exponent: number;
    /** Index of refraction, of `conductor`; its green that of `dielectric`. */
    n: Triple;
    /** Extinction, of shape `conductor`. */
    e: Triple;
    /** Reflected straight on, of shape `schlick`. */
    f0: Triple;
    /** Reflected at grazing angles, of shape `schlick`. */
    f90: number;
    /** Of shape `constant`. */
    value: Triple;
    /** Times the curve, by colour. */
    tint: Triple;
    /** Times the diffuse reflection as baked, by colour. */
    diffuse: Triple;
}

/** Materials given to parts of the scene, by the part's ID. */
export interface Finish {
    /** By its name in `/api/materials`. */
    material: string;
    /** Of a family of materials, such as the exponent of Phong. */
    parameter?: number | null;
    /** Of the material's lobes; without them they are its own. */
    colours?: number[][] | null;
}

/** What shows behind the scene. */
export interface BackgroundState {
    /** What it is: §3.2. */
    mode: BackgroundMode;
    /** Linear, in mode `colour`. */
    colour: Triple;
}

/** Where the image is looked at from. */
export interface CameraState {
    /** Where it stands, in the world. */
    eye: Triple;
    /** What lies in the middle of the image, in the world. */
    look_at: Triple;
    /** What points upwards in the image, as near as may be. */
    up: Triple;
    /** The angle between the image's lower and upper edge. */
    fov_degrees: number;
}

/** How large the image is. */
export interface ImageState {
    /** Pixels in a row. */
    width: number;
    /** Rows. */
    height: number;
}

/** How changed coefficients reach the image. */
export interface StrategyState {
    /** What becomes of the approximation when the light changes. */
    method: StrategyMethod;
    /** What a coefficient's change is weighted with to rank it. */
    priority: StrategyPriority;
}

/** What one image may take. */
export interface BudgetState {
    /** Of an image from edit to encoded picture: relighting gets what is left of them. */
    milliseconds?: number | null;
    /** Applied for an image; from the scene's `columns` on it is all of them. */
    coefficients?: number | null;
    /** Relative L2 at which an image has settled; 0 asks for exact. */
    target_error: number;
}

/** How pictures are developed for who has chosen nothing else. */
export interface DisplayState {
    /** Light is multiplied by 2 to the power of it. */
    exposure_stops: number;
    /** The tone curve: §3.2. */
    tone: DisplayTone;
}

export interface RoomState {
    environment: EnvironmentState;
    blend: BlendState;
    rotation: RotationState;
    lights: { [id: string]: AreaLight };
    materials: { [id: string]: MaterialEdit };
    finishes: { [id: string]: Finish };
    background: BackgroundState;
    camera: CameraState;
    image: ImageState;
    strategy: StrategyState;
    budget: BudgetState;
    display: DisplayState;
}

/** What an edit makes a server do again. */
export type Stage = "signal" | "view" | "display" | "policy";

export const kStages: { readonly [section in keyof RoomState]: Stage } = {
    environment: "signal",
    blend: "signal",
    rotation: "signal",
    lights: "signal",
    materials: "signal",
    finishes: "signal",
    background: "view",
    camera: "view",
    image: "view",
    strategy: "policy",
    budget: "policy",
    display: "display",
};

/** Fields that a state may lack; null in a patch takes them away. */
export const kAbsent: { readonly [section in keyof RoomState]?: readonly string[] } = {
    blend: ["name"],
    lights: ["name"],
    materials: ["points", "shape"],
    finishes: ["parameter", "colours"],
    budget: ["milliseconds", "coefficients"],
};

/** Of numbers, and of each number of a triple. */
export const kRanges = {
    environment: {
        gain: { lowest: 0, highest: 1e6 },
        tint: { lowest: 0, highest: 1e4 },
    },
    blend: {
        amount: { lowest: 0, highest: 1 },
    },
    lights: {
        angular_radius_degrees: { lowest: 0.05, highest: 90 },
        radiance: { lowest: 0, highest: 1e8 },
        gain: { lowest: 0, highest: 1e6 },
        tint: { lowest: 0, highest: 1e4 },
        order: { lowest: -1e9, highest: 1e9 },
    },
    materials: {
        samples: { lowest: 0, highest: 1e6 },
        points: { lowest: 0, highest: 1e6 },
        roughness: { lowest: 0.001, highest: 2 },
        exponent: { lowest: 0, highest: 1e5 },
        n: { lowest: 0.01, highest: 10 },
        e: { lowest: 0, highest: 20 },
        f0: { lowest: 0, highest: 1 },
        f90: { lowest: 0, highest: 1 },
        value: { lowest: 0, highest: 1e6 },
        tint: { lowest: 0, highest: 1e4 },
        diffuse: { lowest: 0, highest: 1e4 },
    },
    finishes: {
        parameter: { lowest: 0, highest: 1e5 },
        colours: { lowest: 0, highest: 1e4 },
    },
    background: {
        colour: { lowest: 0, highest: 1e4 },
    },
    camera: {
        eye: { lowest: -1e12, highest: 1e12 },
        look_at: { lowest: -1e12, highest: 1e12 },
        fov_degrees: { lowest: 0.01, highest: 179 },
    },
    image: {
        width: { lowest: 1, highest: 16384 },
        height: { lowest: 1, highest: 16384 },
    },
    budget: {
        milliseconds: { lowest: 0.1, highest: 1000 },
        coefficients: { lowest: 1, highest: 393216 },
        target_error: { lowest: 0, highest: 1 },
    },
    display: {
        exposure_stops: { lowest: -20, highest: 20 },
    },
} as const satisfies { [section: string]: { [field: string]: Range } };
