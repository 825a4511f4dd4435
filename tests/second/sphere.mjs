// Directions, the cubemap, rotation (protocol/README.md §1).

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const unit = (a) => {
    const length = Math.sqrt(dot(a, a));
    return [a[0] / length, a[1] / length, a[2] / length];
};
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The cube's point at (u, v) of a face, 0 … 5: +X −X +Y −Y +Z −Z. */
export function pointOnFace(face, u, v) {
    switch (face) {
        case 0: return [1, -v, -u];
        case 1: return [-1, -v, u];
        case 2: return [u, 1, v];
        case 3: return [u, -1, -v];
        case 4: return [u, -v, 1];
        default: return [-u, -v, -1];
    }
}

/** The face that a direction pierces, and where. */
export function placeOnCube(d) {
    const [x, y, z] = d.map(Math.abs);
    if (x >= y && x >= z) {
        return d[0] > 0 ? [0, -d[2] / x, -d[1] / x] : [1, d[2] / x, -d[1] / x];
    }
    if (y >= z) return d[1] > 0 ? [2, d[0] / y, d[2] / y] : [3, d[0] / y, -d[2] / y];
    return d[2] > 0 ? [4, d[0] / z, -d[1] / z] : [5, -d[0] / z, -d[1] / z];
}

/** The middle of texel i of n along a face. */
export const middle = (i, n) => (2 * (i + 0.5)) / n - 1;

export function solidAngle(i, j, n) {
    const A = (u, v) => Math.atan2(u * v, Math.sqrt(u * u + v * v + 1));
    const [u0, u1, v0, v1] = [i, i + 1, j, j + 1].map((k) => (2 * k) / n - 1);
    return A(u1, v1) - A(u0, v1) - A(u1, v0) + A(u0, v0);
}

/** The texel past the edge at (column, row) of a face, one of them being −1 or n. */
export function texelPastEdge(face, column, row, n) {
    const onEdge = (k) => (k < 0 ? -1 - 1e-9 : k >= n ? 1 + 1e-9 : middle(k, n));
    const [other, u, v] = placeOnCube(pointOnFace(face, onEdge(column), onEdge(row)));
    const index = (w) => Math.min(n - 1, Math.max(0, Math.floor(((w + 1) * n) / 2)));
    return (other * n + index(v)) * n + index(u);
}

/** The direction that the inverse of the unit quaternion [w, x, y, z] gives. */
export function turnedBack([w, x, y, z], d) {
    const q = [-x, -y, -z];
    const t = cross(q, d).map((a) => 2 * a);
    const s = cross(q, t);
    return [0, 1, 2].map((i) => d[i] + w * t[i] + s[i]);
}
const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];
