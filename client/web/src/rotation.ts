/** Rotations as unit quaternions w, x, y, z; world direction = R · source direction. */
import type { Quaternion, Triple } from "./wire/state";

export const kIdentity: Quaternion = [1, 0, 0, 0];

/** The rotation that turns by `b` first, then by `a`. */
export function multiply(a: Quaternion, b: Quaternion): Quaternion {
    const [aw, ax, ay, az] = a;
    const [bw, bx, by, bz] = b;
    return [
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    ];
}

export function conjugate([w, x, y, z]: Quaternion): Quaternion {
    return [w, -x, -y, -z];
}

export function normalized(q: Quaternion): Quaternion {
    const length = Math.hypot(...q);
    return length > 0 ? (q.map((part) => part / length) as Quaternion) : kIdentity;
}

/** By `degrees` about a unit axis, counter-clockwise seen against the axis. */
export function aboutAxis(axis: Triple, degrees: number): Quaternion {
    const half = (degrees * Math.PI) / 360;
    const sine = Math.sin(half);
    return [Math.cos(half), axis[0] * sine, axis[1] * sine, axis[2] * sine];
}

/** Rows of the 3×3 matrix of a unit quaternion. */
export function matrixFromQuaternion([w, x, y, z]: Quaternion): [Triple, Triple, Triple] {
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ];
}

export function rotate(q: Quaternion, v: Triple): Triple {
    const rows = matrixFromQuaternion(q);
    return rows.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) as Triple;
}

export interface EulerDegrees {
    yaw: number;
    pitch: number;
    roll: number;
}

/** R = R_y(yaw) · R_x(pitch) · R_z(roll). */
export function quaternionFromEuler({ yaw, pitch, roll }: EulerDegrees): Quaternion {
    return multiply(
        multiply(aboutAxis([0, 1, 0], yaw), aboutAxis([1, 0, 0], pitch)),
        aboutAxis([0, 0, 1], roll),
    );
}

/** The inverse of quaternionFromEuler with pitch in [−90, 90]; roll is 0 at the poles. */
export function eulerFromQuaternion(q: Quaternion): EulerDegrees {
    const m = matrixFromQuaternion(q);
    const degrees = 180 / Math.PI;
    const sinePitch = Math.min(1, Math.max(-1, -m[1][2]));
    const pitch = Math.asin(sinePitch) * degrees;
    if (Math.abs(sinePitch) > 1 - 1e-9) {
        return { yaw: Math.atan2(-m[2][0], m[0][0]) * degrees, pitch, roll: 0 };
    }
    return {
        yaw: Math.atan2(m[0][2], m[2][2]) * degrees,
        pitch,
        roll: Math.atan2(m[1][0], m[1][1]) * degrees,
    };
}

/**
 * The rotation after the hand has moved over the picture: across turns about the vertical,
 * `upright` turns over the horizontal, `roll` about the line of sight. What one sees in the
 * environment ahead (−Z) follows the hand: right on the screen, down on the screen, clockwise.
 */
export function turned(
    q: Quaternion,
    {
        across = 0,
        down = 0,
        clockwise = 0,
    }: { across?: number; down?: number; clockwise?: number },
): Quaternion {
    const turn = multiply(
        aboutAxis([0, 1, 0], -across),
        multiply(aboutAxis([1, 0, 0], -down), aboutAxis([0, 0, 1], -clockwise)),
    );
    return normalized(multiply(turn, q));
}
