/** Where a camera stands after a hand has moved it. Pure functions of the room's section. */
import { aboutAxis, rotate } from "./rotation";
import type { SceneBounds } from "./wire/message";
import { type CameraState, kRanges, type Triple } from "./wire/state";

/** Nearer to straight up or down than this no orbit goes, so that up stays up. */
const kLeastDegreesFromUp = 0.5;
/** Of the sphere around the scene, so much is left free where all of it is framed. */
const kFramingMargin = 1.05;
/** Of the scene's radius: a dolly comes no nearer to what it looks at. */
const kLeastDistance = 1e-4;

function add(a: Triple, b: Triple, times = 1): Triple {
    return [a[0] + b[0] * times, a[1] + b[1] * times, a[2] + b[2] * times];
}

function difference(a: Triple, b: Triple): Triple {
    return add(a, b, -1);
}

function dot(a: Triple, b: Triple): number {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a: Triple, b: Triple): Triple {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(v: Triple, otherwise: Triple): Triple {
    const length = Math.hypot(...v);
    return length > 0 ? (v.map((part) => part / length) as Triple) : otherwise;
}

/** Unit vectors to the right of the image, upwards in it, and into it. */
export function axesOf({ eye, look_at, up }: CameraState): {
    right: Triple;
    upwards: Triple;
    forward: Triple;
} {
    const forward = unit(difference(look_at, eye), [0, 0, -1]);
    const across = Math.abs(forward[1]) > 0.9 ? ([0, 0, 1] as Triple) : ([0, 1, 0] as Triple);
    const sine = Math.hypot(...cross(forward, up));
    const right = unit(cross(forward, sine > 1e-6 ? up : across), [1, 0, 0]);
    return { right, upwards: cross(right, forward), forward };
}

function distanceOf({ eye, look_at }: CameraState): number {
    return Math.hypot(...difference(look_at, eye));
}

function tanHalf(degrees: number): number {
    return Math.tan((degrees * Math.PI) / 360);
}

/**
 * About what it looks at: across, about `up`; down, over the top. What is seen follows the hand,
 * both in degrees.
 */
export function orbited(camera: CameraState, across: number, down: number): CameraState {
    const up = unit(camera.up, [0, 1, 0]);
    const { right, forward } = axesOf(camera);
    const fromUp = (Math.acos(Math.min(1, Math.max(-1, -dot(forward, up)))) * 180) / Math.PI;
    const tilted = Math.min(
        180 - kLeastDegreesFromUp,
        Math.max(kLeastDegreesFromUp, fromUp - down),
    );
    const back = difference(camera.eye, camera.look_at);
    const turned = rotate(aboutAxis(right, tilted - fromUp), back);
    return {
        ...camera,
        eye: add(camera.look_at, rotate(aboutAxis(up, -across), turned)),
    };
}

/** Sideways: what it looks at follows the hand, in parts of the image's height. */
export function panned(camera: CameraState, across: number, down: number): CameraState {
    const { right, upwards } = axesOf(camera);
    const height = 2 * distanceOf(camera) * tanHalf(camera.fov_degrees);
    const shift = add(
        right.map((part) => part * -across * height) as Triple,
        upwards,
        down * height,
    );
    return { ...camera, eye: add(camera.eye, shift), look_at: add(camera.look_at, shift) };
}

/** Nearer to what it looks at, or farther from it: the distance times `factor`. */
export function dollied(camera: CameraState, factor: number, bounds: SceneBounds): CameraState {
    const back = difference(camera.eye, camera.look_at);
    const distance = Math.hypot(...back);
    const least = kLeastDistance * bounds.radius;
    const next = Math.min(
        kRanges.camera.eye.highest / 4,
        Math.max(least, Math.max(distance, least) * factor),
    );
    return {
        ...camera,
        eye: add(camera.look_at, unit(back, [0, 0, 1]), next),
    };
}

/** From the same side, with all of the scene in the image; `aspect` is width over height. */
export function framed(camera: CameraState, bounds: SceneBounds, aspect: number): CameraState {
    const half = tanHalf(camera.fov_degrees) * Math.min(1, aspect);
    const sine = half / Math.hypot(1, half);
    const distance = (kFramingMargin * Math.max(bounds.radius, 1e-9)) / sine;
    const { forward } = axesOf(camera);
    return {
        ...camera,
        eye: add(bounds.centre, forward, -distance),
        look_at: bounds.centre,
    };
}

/** Sides from which all of a scene can be framed, +Y up and looking at −Z from the front. */
export const kSides = {
    front: { towards: [0, 0, -1], up: [0, 1, 0] },
    back: { towards: [0, 0, 1], up: [0, 1, 0] },
    left: { towards: [1, 0, 0], up: [0, 1, 0] },
    right: { towards: [-1, 0, 0], up: [0, 1, 0] },
    top: { towards: [0, -1, 0], up: [0, 0, -1] },
    bottom: { towards: [0, 1, 0], up: [0, 0, 1] },
} as const satisfies { [side: string]: { towards: Triple; up: Triple } };

export type Side = keyof typeof kSides;

export function seenFrom(
    side: Side,
    camera: CameraState,
    bounds: SceneBounds,
    aspect: number,
): CameraState {
    const { towards, up } = kSides[side];
    const looking: CameraState = {
        ...camera,
        eye: bounds.centre,
        look_at: add(bounds.centre, towards),
        up: [...up],
    };
    return framed(looking, bounds, aspect);
}
