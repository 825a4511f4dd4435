// A lat-long map and its levels (light.md §1), and what a pixel sees of it (light.md §5).
import { dot } from "./sphere.mjs";

/** Of a place, 0 ≤ x, y ≤ 1 over the image. */
export function directionAt(x, y) {
    const [phi, theta] = [2 * Math.PI * (x - 0.5), Math.PI * (0.5 - y)];
    return [
        Math.sin(phi) * Math.cos(theta),
        Math.sin(theta),
        -Math.cos(phi) * Math.cos(theta),
    ];
}
const placeOf = (d) => [
    Math.atan2(d[0], -d[2]) / (2 * Math.PI) + 0.5,
    0.5 - Math.asin(Math.min(1, Math.max(-1, d[1]))) / Math.PI,
];

/** Solid angle per unit of x·y. */
export const density = (y) => 2 * Math.PI ** 2 * Math.cos(Math.PI * (0.5 - y));

/** The side of a texel as an angle. */
export const texelAngle = (level) => Math.PI / level.height;

function nextLevel(level) {
    const [width, height] = [Math.ceil(level.width / 2), Math.ceil(level.height / 2)];
    const next = { width, height, texels: new Float64Array(3 * width * height) };
    for (let Y = 0; Y < height; ++Y) {
        const [top, bottom] = [Y, Y + 1].map((k) => (k * level.height) / height);
        for (let X = 0; X < width; ++X) {
            const [left, right] = [X, X + 1].map((k) => (k * level.width) / width);
            const sum = [0, 0, 0];
            let weights = 0;
            for (let y = Math.floor(top); y < Math.min(level.height, Math.ceil(bottom)); ++y) {
                const tall = Math.min(bottom, y + 1) - Math.max(top, y);
                const D = Math.max(density((y + 0.5) / level.height), 1e-6);
                for (let x = Math.floor(left); x < Math.min(level.width, Math.ceil(right)); ++x) {
                    const weight = tall * (Math.min(right, x + 1) - Math.max(left, x)) * D;
                    for (let c = 0; c < 3; ++c) {
                        sum[c] += weight * level.texels[3 * (y * level.width + x) + c];
                    }
                    weights += weight;
                }
            }
            for (let c = 0; c < 3; ++c) next.texels[3 * (Y * width + X) + c] = sum[c] / weights;
        }
    }
    return next;
}

/** The map first, then ever coarser ones. */
export function levelsOf(map) {
    const texels = map.texels.map((value) => Math.min(1e10, Math.max(0, value)));
    const levels = [{ ...map, texels }];
    while (Math.min(levels.at(-1).width, levels.at(-1).height) > 4) {
        levels.push(nextLevel(levels.at(-1)));
    }
    return levels;
}

function texel(level, X, Y) {
    const { width, height, texels } = level;
    if (Y < 0 || Y >= height) {
        Y = Y < 0 ? 0 : height - 1;
        X += Math.floor(width / 2);
    }
    const at = 3 * (Y * width + (((X % width) + width) % width));
    return [texels[at], texels[at + 1], texels[at + 2]];
}

function bilinear(level, x, y) {
    const [X, Y] = [x * level.width - 0.5, y * level.height - 0.5];
    const [i, j] = [Math.floor(X), Math.floor(Y)];
    const [s, t] = [X - i, Y - j];
    const corners = [
        [(1 - s) * (1 - t), texel(level, i, j)],
        [s * (1 - t), texel(level, i + 1, j)],
        [(1 - s) * t, texel(level, i, j + 1)],
        [s * t, texel(level, i + 1, j + 1)],
    ];
    return [0, 1, 2].map((c) => corners.reduce((sum, [w, value]) => sum + w * value[c], 0));
}

function lookup(level, d, omega) {
    const [x, y] = placeOf(d);
    const round = 2 * Math.PI * Math.sqrt(Math.max(0, 1 - d[1] * d[1]));
    const q = Math.min(1, Math.sqrt(omega) / Math.max(round, 1e-6));
    const count = q * level.width > 1 ? Math.min(16, Math.ceil(q * level.width)) : 1;
    const sum = [0, 0, 0];
    for (let t = 0; t < count; ++t) {
        const shift = count === 1 ? 0 : ((t + 0.5) / count - 0.5) * q;
        const seen = bilinear(level, x + shift, y);
        for (let c = 0; c < 3; ++c) sum[c] += seen[c] / count;
    }
    return sum;
}

/** E of the map towards the unit direction d, over the solid angle of a pixel. */
export function seenOf(levels, d, omega) {
    const unclamped = 0.5 * Math.log2(omega / texelAngle(levels[0]) ** 2);
    const lambda = Math.min(levels.length - 1, Math.max(0, unclamped));
    const fraction = lambda - Math.floor(lambda);
    const fine = lookup(levels[Math.floor(lambda)], d, omega);
    if (fraction === 0) return fine;
    const coarse = lookup(levels[Math.ceil(lambda)], d, omega);
    return [0, 1, 2].map((c) => (1 - fraction) * fine[c] + fraction * coarse[c]);
}

/** The direction of a pixel's ray and its solid angle. */
export function rayOf(camera, width, height, x, y) {
    const across = ((2 * (x + 0.5)) / width - 1) * camera.tan_half_width;
    const up = (1 - (2 * (y + 0.5)) / height) * camera.tan_half_height;
    const ray = [0, 1, 2].map(
        (i) => camera.forward[i] + across * camera.right[i] + up * camera.up[i],
    );
    const length = Math.sqrt(dot(ray, ray));
    const d = ray.map((a) => a / length);
    const area = (4 * camera.tan_half_width * camera.tan_half_height) / (width * height);
    return [d, area * dot(d, camera.forward) ** 3];
}
