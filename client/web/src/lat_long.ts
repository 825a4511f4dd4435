/**
 * The lat-long picture of directions [protocol/README.md §1]: width twice the height, −Z at the
 * centre, +X right of it, +Y on top. Positions are fractions: u across, v down, both 0 … 1.
 */
import type { Triple } from "./wire/state";

export interface Position {
    u: number;
    v: number;
}

export function directionFromPosition({ u, v }: Position): Triple {
    const longitude = 2 * Math.PI * (u - 0.5);
    const latitude = Math.PI * (0.5 - v);
    const radius = Math.cos(latitude);
    return [Math.sin(longitude) * radius, Math.sin(latitude), -Math.cos(longitude) * radius];
}

export function positionFromDirection([x, y, z]: Triple): Position {
    const length = Math.hypot(x, y, z);
    return {
        u: 0.5 + Math.atan2(x, -z) / (2 * Math.PI),
        v: 0.5 - Math.asin(Math.min(1, Math.max(-1, y / length))) / Math.PI,
    };
}

/**
 * Outline of the round cap of `angularRadiusDegrees` about `direction`, as positions whose u runs
 * on beyond 0 and 1 where the cap crosses the seam; it closes along the border over a pole.
 */
export function capOutline(
    direction: Triple,
    angularRadiusDegrees: number,
    points = 72,
): Position[] {
    const length = Math.hypot(...direction);
    const axis = direction.map((part) => part / length) as Triple;
    const helper: Triple = Math.abs(axis[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0];
    const right = normalizedCross(helper, axis);
    const up = normalizedCross(axis, right);
    const radius = (angularRadiusDegrees * Math.PI) / 180;
    const outline: Position[] = [];
    let previous = 0;
    for (let i = 0; i <= points; ++i) {
        const angle = (2 * Math.PI * i) / points;
        const [a, b, c] = [
            Math.cos(radius),
            Math.sin(radius) * Math.cos(angle),
            Math.sin(radius) * Math.sin(angle),
        ];
        const { u, v } = positionFromDirection([
            a * axis[0] + b * right[0] + c * up[0],
            a * axis[1] + b * right[1] + c * up[1],
            a * axis[2] + b * right[2] + c * up[2],
        ]);
        const unwrapped = i === 0 ? u : u + Math.round(previous - u);
        outline.push({ u: unwrapped, v });
        previous = unwrapped;
    }
    const first = outline[0]!;
    const last = outline[outline.length - 1]!;
    if (Math.abs(last.u - first.u) > 0.5) {
        const pole = axis[1] > 0 ? 0 : 1;
        outline.push({ u: last.u, v: pole }, { u: first.u, v: pole });
    }
    return outline;
}

function normalizedCross(a: Triple, b: Triple): Triple {
    const cross: Triple = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    const length = Math.hypot(...cross);
    return cross.map((part) => part / length) as Triple;
}
