// From maps and lights to the mean radiance of every texel (light.md §2 to §4).
import {
    distance, middle, placeOnCube, pointOnFace, solidAngle, texelPastEdge, turnedBack, unit,
} from "./sphere.mjs";
import { density, directionAt, texelAngle } from "./source_map.mjs";

/** Shares of the four bins around a direction: calls take(bin, share). */
function forEachBin(d, m, take) {
    const [face, u, v] = placeOnCube(d);
    const [X, Y] = [((u + 1) * m) / 2 - 0.5, ((v + 1) * m) / 2 - 0.5];
    const [i, j] = [Math.floor(X), Math.floor(Y)];
    const isInside = (k) => k >= 0 && k < m;
    for (const [column, row, share] of [
        [i, j, (1 - (X - i)) * (1 - (Y - j))],
        [i + 1, j, (X - i) * (1 - (Y - j))],
        [i, j + 1, (1 - (X - i)) * (Y - j)],
        [i + 1, j + 1, (X - i) * (Y - j)],
    ]) {
        if (isInside(column) && isInside(row)) {
            take((face * m + row) * m + column, share);
        } else if (isInside(column) || isInside(row)) {
            take(texelPastEdge(face, column, row, m), share);
        } else {
            const [c, r] = [column, row].map((k) => Math.min(m - 1, Math.max(0, k)));
            take((face * m + r) * m + c, share / 3);
            take(texelPastEdge(face, column, r, m), share / 3);
            take(texelPastEdge(face, c, row, m), share / 3);
        }
    }
}

function splat(levels, m) {
    const level = levels.findLast((l) => texelAngle(l) <= 1 / m) ?? levels[0];
    const { width: w, height: h, texels } = level;
    const bins = new Float64Array(4 * 6 * m * m); // E·ω by colour, and ω
    const cutsDown = Math.max(1, Math.ceil(texelAngle(level) * m));
    for (let Y = 0; Y < h; ++Y) {
        const q = Math.max(0, 0.5 - (Y + 1) / h, Y / h - 0.5);
        const cuts = Math.max(1, Math.ceil(((2 * Math.PI * Math.cos(Math.PI * q)) / w) * m));
        for (let X = 0; X < w; ++X) {
            for (let part = 0; part < cuts * cutsDown; ++part) {
                const x = (X + ((part % cuts) + 0.5) / cuts) / w;
                const y = (Y + (Math.floor(part / cuts) + 0.5) / cutsDown) / h;
                const omega = density(y) / (w * h * cuts * cutsDown);
                if (omega <= 0) continue;
                forEachBin(directionAt(x, y), m, (bin, share) => {
                    for (let c = 0; c < 3; ++c) {
                        bins[4 * bin + c] += share * omega * texels[3 * (Y * w + X) + c];
                    }
                    bins[4 * bin + 3] += share * omega;
                });
            }
        }
    }
    return bins;
}

function centres(m) {
    const directions = new Float64Array(3 * 6 * m * m);
    for (let t = 0; t < 6 * m * m; ++t) {
        const [face, row, column] = [Math.floor(t / (m * m)), Math.floor(t / m) % m, t % m];
        directions.set(unit(pointOnFace(face, middle(column, m), middle(row, m))), 3 * t);
    }
    return directions;
}

function lowPass(bins, m) {
    const directions = centres(m);
    const radius = (Math.sqrt(10) * 1.5 * 2) / m;
    const inner = new Float64Array(3 * 6 * m * m);
    for (let i = 0; i < 6 * m * m; ++i) {
        const [x, y, z] = directions.subarray(3 * i, 3 * i + 3);
        const sum = [0, 0, 0, 0];
        for (let t = 0; t < 6 * m * m; ++t) {
            const squared =
                (directions[3 * t] - x) ** 2 +
                (directions[3 * t + 1] - y) ** 2 +
                (directions[3 * t + 2] - z) ** 2;
            const k = 1 - squared / (radius * radius);
            if (k <= 0) continue;
            for (let c = 0; c < 4; ++c) sum[c] += k * k * k * bins[4 * t + c];
        }
        for (let c = 0; c < 3; ++c) inner[3 * i + c] = sum[c] / sum[3];
    }
    return inner;
}

/** Texels a period apart give the brighter of two some of what the darker one has. */
function sharpened(inner, m) {
    const omega = Float64Array.from({ length: 6 * m * m }, (_, t) =>
        solidAngle(t % m, Math.floor(t / m) % m, m));
    const pairs = [];
    for (let t = 0; t < 6 * m * m; ++t) {
        const [face, row, column] = [Math.floor(t / (m * m)), Math.floor(t / m) % m, t % m];
        for (const [across, down] of [[-4, 0], [4, 0], [0, -4], [0, 4]]) {
            const [u, v] = [middle(column + across, m), middle(row + down, m)];
            const [other, x, y] = placeOnCube(pointOnFace(face, u, v));
            const [i, j] = [x, y].map((w) => Math.floor(((w + 1) * m) / 2));
            pairs.push([t, (other * m + j) * m + i]);
        }
    }
    const result = new Float64Array(inner.length);
    for (let c = 0; c < 3; ++c) {
        const fluxes = pairs.map(([t, s]) =>
            ((0.16 / 2) * (omega[t] + omega[s]) * (inner[3 * t + c] - inner[3 * s + c])) / 2);
        const asked = new Float64Array(6 * m * m);
        const giverOf = (k) => pairs[k][fluxes[k] > 0 ? 1 : 0];
        fluxes.forEach((flux, k) => (asked[giverOf(k)] += Math.abs(flux)));
        const energy = omega.map((w, t) => w * inner[3 * t + c]);
        const part = energy.map((held, t) => (asked[t] > held ? held / asked[t] : 1));
        fluxes.forEach((flux, k) => {
            const given = flux * part[giverOf(k)];
            energy[pairs[k][0]] += given;
            energy[pairs[k][1]] -= given;
        });
        energy.forEach((e, t) => (result[3 * t + c] = Math.max(0, e / omega[t])));
    }
    return result;
}

/** Every face with a border of one texel: six arrays of (m+2)² colours. */
function bordered(inner, m) {
    const side = m + 2;
    return Array.from({ length: 6 }, (_, face) => {
        const texels = new Float64Array(3 * side * side);
        const put = (column, row, colour) =>
            texels.set(colour, 3 * ((row + 1) * side + column + 1));
        const get = (column, row) => {
            const at = 3 * ((row + 1) * side + column + 1);
            return texels.subarray(at, at + 3);
        };
        const colourOf = (t) => inner.subarray(3 * t, 3 * t + 3);
        for (let row = 0; row < m; ++row) {
            for (let column = 0; column < m; ++column) {
                put(column, row, colourOf((face * m + row) * m + column));
            }
        }
        for (let k = 0; k < m; ++k) {
            for (const [column, row] of [[k, -1], [k, m], [-1, k], [m, k]]) {
                put(column, row, colourOf(texelPastEdge(face, column, row, m)));
            }
        }
        for (const column of [-1, m]) {
            for (const row of [-1, m]) {
                const [c, r] = [column, row].map((k) => Math.min(m - 1, Math.max(0, k)));
                const three = [get(c, r), get(column, r), get(c, row)];
                const mean = (i) => (three[0][i] + three[1][i] + three[2][i]) / 3;
                put(column, row, [0, 1, 2].map(mean));
            }
        }
        return texels;
    });
}

/** Of a map's levels: what is made once for every n. */
export function innerCubemap(levels, n) {
    const m = 4 * n;
    return { m, faces: bordered(sharpened(lowPass(splat(levels, m), m), m), m) };
}

function lookup({ m, faces }, d) {
    const [face, u, v] = placeOnCube(d);
    const [X, Y] = [((u + 1) * m) / 2 - 0.5, ((v + 1) * m) / 2 - 0.5];
    const i = Math.min(m - 1, Math.max(-1, Math.floor(X)));
    const j = Math.min(m - 1, Math.max(-1, Math.floor(Y)));
    const [s, t] = [X - i, Y - j];
    const side = m + 2;
    const at = 3 * ((j + 1) * side + i + 1);
    return [0, 1, 2].map((c) => {
        const texel = (offset) => faces[face][at + 3 * offset + c];
        const top = (1 - s) * texel(0) + s * texel(1);
        const bottom = (1 - s) * texel(side) + s * texel(side + 1);
        return (1 - t) * top + t * bottom;
    });
}

/** The mean of the eight samples of a texel: S of light.md §3. */
function turnedTexel(inner, n, face, i, j, quaternion) {
    const sum = [0, 0, 0];
    let weights = 0;
    for (let l = 0; l < 4; ++l) {
        const v = middle(4 * j + l, 4 * n);
        for (let k = 0; k < 2; ++k) {
            const u = (2 * (2 * i + k + (l % 2 === 0 ? 0.25 : 0.75))) / (2 * n) - 1;
            const weight = (1 + u * u + v * v) ** -1.5;
            const seen = lookup(inner, turnedBack(quaternion, pointOnFace(face, u, v)));
            for (let c = 0; c < 3; ++c) sum[c] += weight * seen[c];
            weights += weight;
        }
    }
    return sum.map((value) => value / weights);
}

/** f(r) of a round light whose edge is e wide, and where it is 1 and 0. */
export function profile(alpha, e) {
    const rho = 2 * Math.sin(alpha / 2);
    const isWide = rho * rho >= (e * e) / 3;
    const b = isWide ? Math.sqrt(rho * rho - (e * e) / 12) : e / 2;
    const h = isWide ? 1 : (3 * rho * rho) / (e * e);
    return {
        b,
        f: (r) => h * Math.min(1, Math.max(0, (b - r) / e + 0.5)),
    };
}

function coverageOf(light, n, face, i, j) {
    const e = 1 / n;
    const { b, f } = profile(light.alpha, e);
    const centre = unit(pointOnFace(face, middle(i, n), middle(j, n)));
    const away = distance(centre, light.direction);
    if (away + Math.SQRT2 / n <= b - e / 2) return 1;
    if (away - Math.SQRT2 / n >= b + e / 2) return 0;
    let [sum, weights] = [0, 0];
    for (let k = 0; k < 16; ++k) {
        const u = middle(4 * i + (k % 4), 4 * n);
        const v = middle(4 * j + Math.floor(k / 4), 4 * n);
        const weight = (1 + u * u + v * v) ** -1.5;
        sum += weight * f(distance(unit(pointOnFace(face, u, v)), light.direction));
        weights += weight;
    }
    return sum / weights;
}

/** What a state lights with: {scale, amount, quaternion, environment, blend, lights}. */
export function lightsOf(state) {
    const all = Object.values(state.lights);
    const isSolo = all.some((light) => light.solo);
    return {
        scale: state.environment.tint.map((t) => (isSolo ? 0 : t * state.environment.gain)),
        amount: "name" in state.blend ? state.blend.amount : 0,
        quaternion: state.rotation.quaternion,
        lights: all
            .filter((light) => !light.muted && (light.solo || !isSolo))
            .map((light) => ({
                direction: light.direction,
                alpha: (light.angular_radius_degrees * Math.PI) / 180,
                radiance: light.radiance.map((r, c) => r * light.gain * light.tint[c]),
            })),
    };
}

/** The lighting cubemap: one array of 6·n² mean radiances for each colour. */
export function lightingCubemap(rig, inner, innerBlend, n) {
    const texels = [0, 1, 2].map(() => new Float64Array(6 * n * n));
    const forEachTexel = (take) => {
        for (let t = 0; t < 6 * n * n; ++t) {
            take(t, Math.floor(t / (n * n)), t % n, Math.floor(t / n) % n);
        }
    };
    forEachTexel((t, face, i, j) => {
        const first = turnedTexel(inner, n, face, i, j, rig.quaternion);
        const second =
            rig.amount === 0 ? first : turnedTexel(innerBlend, n, face, i, j, rig.quaternion);
        for (let c = 0; c < 3; ++c) {
            texels[c][t] =
                rig.scale[c] * ((1 - rig.amount) * first[c] + rig.amount * second[c]);
        }
    });
    for (const light of rig.lights) {
        const coverages = new Float64Array(6 * n * n);
        let total = 0;
        forEachTexel((t, face, i, j) => {
            coverages[t] = coverageOf(light, n, face, i, j);
            total += coverages[t] * solidAngle(i, j, n);
        });
        const factor = (2 * Math.PI * (1 - Math.cos(light.alpha))) / total;
        for (let c = 0; c < 3; ++c) {
            for (let t = 0; t < 6 * n * n; ++t) {
                texels[c][t] += light.radiance[c] * factor * coverages[t];
            }
        }
    }
    return texels;
}
