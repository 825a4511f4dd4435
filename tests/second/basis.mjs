// Coefficients of a cubemap in the bases of protocol/README.md §1.
import { middle, pointOnFace, solidAngle, unit } from "./sphere.mjs";

/** One face, in place: the orthonormal non-standard Haar transform. */
export function haarTransform(face, n) {
    for (let side = n; side > 1; side /= 2) {
        const half = side / 2;
        const before = face.slice();
        for (let row = 0; row < half; ++row) {
            for (let column = 0; column < half; ++column) {
                const at = 2 * row * n + 2 * column;
                const [p, q] = [before[at], before[at + 1]];
                const [r, s] = [before[at + n], before[at + n + 1]];
                face[row * n + column] = (p + q + r + s) / 2;
                face[row * n + column + half] = (p - q + r - s) / 2;
                face[(row + half) * n + column] = (p + q - r - s) / 2;
                face[(row + half) * n + column + half] = (p - q - r + s) / 2;
            }
        }
    }
}

/** The k² functions of order k in a direction, by index l² + l + m. */
export function harmonics(order, [x, y, z]) {
    const values = new Float64Array(order * order);
    const s = Math.sqrt(Math.max(0, 1 - z * z));
    const azimuth = Math.atan2(y, x);
    for (let m = 0; m < order; ++m) {
        let previous = 0;
        let legendre = 1;
        for (let i = 1; i <= m; ++i) legendre *= (2 * i - 1) * s;
        for (let l = m; l < order; ++l) {
            let factor = (2 * l + 1) / (4 * Math.PI);
            for (let i = l - m + 1; i <= l + m; ++i) factor /= i;
            const scaled = Math.sqrt(factor) * legendre;
            if (m === 0) {
                values[l * l + l] = scaled;
            } else {
                values[l * l + l + m] = Math.SQRT2 * scaled * Math.cos(m * azimuth);
                values[l * l + l - m] = Math.SQRT2 * scaled * Math.sin(m * azimuth);
            }
            const next = ((2 * l + 1) * z * legendre - (l + m) * previous) / (l - m + 1);
            [previous, legendre] = [legendre, next];
        }
    }
    return values;
}

/** Ω·M(j, t) of every function for one texel, by the midpoint rule. */
function harmonicsOverTexel(order, face, i, j, n) {
    const cuts = 16;
    const sums = new Float64Array(order * order);
    let weights = 0;
    for (let l = 0; l < cuts; ++l) {
        for (let k = 0; k < cuts; ++k) {
            const u = middle(cuts * i + k, cuts * n);
            const v = middle(cuts * j + l, cuts * n);
            const weight = (1 + u * u + v * v) ** -1.5;
            const values = harmonics(order, unit(pointOnFace(face, u, v)));
            for (let index = 0; index < sums.length; ++index) sums[index] += weight * values[index];
            weights += weight;
        }
    }
    const omega = solidAngle(i, j, n);
    return sums.map((sum) => (omega * sum) / weights);
}

/** Coefficients of every colour; each has 6·n² texels in order. */
export function coefficients(basis, colours) {
    const n = basis.face_resolution;
    if (basis.name === "haar") {
        return colours.map((radiance) => {
            const L = Float64Array.from(radiance);
            for (let face = 0; face < 6; ++face) {
                haarTransform(L.subarray(face * n * n, (face + 1) * n * n), n);
            }
            return L;
        });
    }
    const L = colours.map(() => new Float64Array(basis.order ** 2));
    for (let t = 0; t < 6 * n * n; ++t) {
        const [face, j, i] = [Math.floor(t / (n * n)), Math.floor(t / n) % n, t % n];
        const over = harmonicsOverTexel(basis.order, face, i, j, n);
        for (let c = 0; c < colours.length; ++c) {
            for (let index = 0; index < over.length; ++index) {
                L[c][index] += over[index] * colours[c][t];
            }
        }
    }
    return L;
}
