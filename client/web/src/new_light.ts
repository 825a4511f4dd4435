/** What a light is like when it is added: part, place, and a level that fits the picture. */
import { fieldsFromLevel, levelOfLight } from "./light_level";
import { clampTo } from "./wire/range";
import { type AreaLight, kRanges, type Triple } from "./wire/state";

interface Role {
    id: string;
    radiusDegrees: number;
    /** Against the key. */
    stops: number;
    /** For a scene seen along −Z. */
    direction: Triple;
}

const kKeyId = "key";
/** A fill is large and two stops down; a rim comes from behind, small. */
const kRoles: Role[] = [
    { id: kKeyId, radiusDegrees: 6, stops: 0, direction: [0.45, 0.75, 0.5] },
    { id: "fill", radiusDegrees: 25, stops: -2, direction: [-0.8, 0.4, 0.5] },
    { id: "rim", radiusDegrees: 4, stops: -0.5, direction: [-0.35, 0.6, -0.75] },
];
const kFurther: Omit<Role, "id" | "direction"> = { radiusDegrees: 8, stops: -1 };

/** The key alone lights a surface of usual albedo facing it by so many times what shows. */
const kKeyOverPicture = 1.5;
const kUsualAlbedo = 0.5;
const kMidGrey = 0.18;
/** Further lights stand between these heights, as sines of their elevations. */
const kLowest = 0.2;
const kHighest = 0.95;
const kCandidates = 128;
const kGoldenAngleDegrees = 137.508;

/** The first part that no light of the room plays; then light-4, light-5, … */
function freeRole(lights: { [id: string]: AreaLight }): Role {
    const role = kRoles.find(({ id }) => !(id in lights));
    if (role !== undefined) return role;
    let number = kRoles.length + 1;
    while (`light-${number}` in lights) ++number;
    return { ...kFurther, id: `light-${number}`, direction: freeDirection(lights) };
}

export function angleDegrees(a: Triple, b: Triple): number {
    const dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const cosine = dot / (Math.hypot(...a) * Math.hypot(...b));
    return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
}

/** Of the points of a spiral over the upper half, that which is furthest from all lights. */
function freeDirection(lights: { [id: string]: AreaLight }): Triple {
    const others = Object.values(lights).map((light) => light.direction);
    const distance = (direction: Triple): number =>
        Math.min(...others.map((other) => angleDegrees(other, direction)));
    const candidates = Array.from({ length: kCandidates }, (_, i): Triple => {
        const azimuth = (i * kGoldenAngleDegrees * Math.PI) / 180;
        const up = kLowest + ((kHighest - kLowest) * (i + 0.5)) / kCandidates;
        const across = Math.sqrt(1 - up * up);
        return [Math.sin(azimuth) * across, up, Math.cos(azimuth) * across];
    });
    return candidates.reduce((best, next) => (distance(next) > distance(best) ? next : best));
}

export interface Picture {
    /** Median linear radiance of what shows; null where nothing has settled yet. */
    medianRadiance: number | null;
    exposureStops: number;
}

/** Power of a key light in stops: what suits the picture, or its exposure where it is dark. */
export function keyStops({ medianRadiance, exposureStops }: Picture): number {
    const shownGrey = kMidGrey * 2 ** -exposureStops;
    // A picture that is nearly black says nothing about the light it wants.
    const shown =
        medianRadiance !== null && medianRadiance > shownGrey / 100
            ? medianRadiance
            : shownGrey;
    return Math.log2((kKeyOverPicture * shown) / kUsualAlbedo);
}

/**
 * The id and all the fields of a light added to `lights`, the last of their order. Its level is
 * relative to the room's key light, where there is one, else to the picture.
 */
export function newLight(
    lights: { [id: string]: AreaLight },
    picture: Picture,
    direction?: Triple,
): { id: string; light: AreaLight } {
    const role = freeRole(lights);
    const key = lights[kKeyId];
    const level = key === undefined ? -Infinity : levelOfLight(key).stops;
    const stops = (Number.isFinite(level) ? level : keyStops(picture)) + role.stops;
    return {
        id: role.id,
        light: {
            direction: direction ?? role.direction,
            angular_radius_degrees: role.radiusDegrees,
            ...fieldsFromLevel({ stops, colour: "#ffffff" }, role.radiusDegrees),
            name: null,
            muted: false,
            solo: false,
            order: nextOrder(lights),
        },
    };
}

export function nextOrder(lights: { [id: string]: AreaLight }): number {
    const orders = Object.values(lights).map((light) => light.order ?? 0);
    return orders.length === 0 ? 0 : clampTo(kRanges.lights.order, Math.max(...orders) + 1);
}
