/** The state of a room as protocol/README.md §3.1 defines it. Angles are degrees. */

export type Triple = [number, number, number];
/** w, x, y, z; unit length; world direction = R · source direction. */
export type Quaternion = [number, number, number, number];

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

export interface SourceState {
    name: string;
    gain: number;
    tint: Triple;
}

export interface AreaLight {
    /** Towards the light, in the world. */
    direction: Triple;
    angular_radius_degrees: number;
    /** Linear Rec. 709. */
    radiance: Triple;
    gain: number;
    tint: Triple;
    /** What people call it; without one it is called by its id. */
    name?: string | null;
    muted: boolean;
    /** While any light is solo, only solo lights light. */
    solo: boolean;
    /** Lists show lights in ascending order, equals by id. */
    order: number;
}

export type BackgroundMode = "environment" | "colour" | "transparent";
export type Method = "nwa" | "bi" | "pbi" | "guarded";
export type Priority = "area" | "none" | "transport" | "benefit";
export type Tone = "filmic" | "linear";

export interface DisplayState {
    exposure_stops: number;
    tone: Tone;
}

export interface RoomState {
    environment: SourceState;
    blend: { name?: string | null; amount: number };
    rotation: { quaternion: Quaternion };
    lights: { [id: string]: AreaLight };
    background: { mode: BackgroundMode; colour: Triple };
    strategy: { method: Method; priority: Priority };
    /** Holds milliseconds or coefficients, never both. */
    budget: {
        milliseconds?: number | null;
        coefficients?: number | null;
        target_error: number;
    };
    display: DisplayState;
}
