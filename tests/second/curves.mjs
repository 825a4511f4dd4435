// Curves of BRDFs as protocol/curves.md has them. A curve is an array of 256 samples [r, g, b].

const kSamples = 256;
const kDegree = Math.PI / 180;
const kRootAngles = new Set(["half", "reflection", "along_u", "along_v"]);

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sum = (a, b) => a.map((x, i) => x + b[i]);
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const angleBetween = (a, b) => {
    const [x, y, z] = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0]];
    return Math.atan2(Math.hypot(x, y, z), dot(a, b));
};
const colours = (value) => (typeof value === "number" ? [value, value, value] : value);
const single = (sample) => sample.map(Math.fround);

/** θ in radians of u, §1. */
const thetaOf = (angle, u) => 90 * kDegree * (kRootAngles.has(angle) ? u * u : u);

/** u of two directions, §1. */
export function uOf(angle, wi, wo) {
    const normal = [0, 0, 1];
    const h = unit(sum(wi, wo));
    const phi = Math.atan2(h[1], h[0]);
    const theta = {
        half: () => angleBetween(h, normal),
        difference: () => angleBetween(wi, h),
        incidence: () => angleBetween(wi, normal),
        viewing: () => angleBetween(wo, normal),
        reflection: () => Math.min(90 * kDegree, angleBetween(wi, [-wo[0], -wo[1], wo[2]])),
        along_u: () => Math.acos(Math.min(1, h[2] ** (Math.cos(phi) ** 2))),
        along_v: () => Math.acos(Math.min(1, h[2] ** (Math.sin(phi) ** 2))),
    }[angle]();
    const part = theta / (90 * kDegree);
    return kRootAngles.has(angle) ? Math.sqrt(part) : part;
}

/** Between samples a curve is linear, §2. */
export function curveAt(curve, u) {
    const k = Math.min(Math.floor(255 * u), 254);
    const f = 255 * u - k;
    return curve[k].map((value, c) => (1 - f) * value + f * curve[k + 1][c]);
}

/** Coefficients of 256 numbers, §2. */
export function daubechies4(samples) {
    const r = Math.sqrt(3);
    const h = [1 + r, 3 + r, 3 - r, 1 - r].map((x) => x / (4 * Math.SQRT2));
    const g = [h[3], -h[2], h[1], -h[0]];
    const values = Float64Array.from(samples);
    for (let n = kSamples; n > 1; n /= 2) {
        const s = values.slice();
        for (let i = 0; i < n / 2; ++i) {
            let [a, d] = [0, 0];
            for (let k = 0; k < 4; ++k) {
                a += h[k] * s[(2 * i + k) % n];
                d += g[k] * s[(2 * i + k) % n];
            }
            values[i] = a;
            values[n / 2 + i] = d;
        }
    }
    return values;
}

/** Fresnel's reflectance of the index n + ie, §4. */
function reflectance(cosine, n, e) {
    const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
    const index2 = times([n, e], [n, e]);
    const [x, y] = [index2[0] - 1 + cosine * cosine, index2[1]];
    const length = Math.hypot(x, y);
    const w = [Math.sqrt((length + x) / 2), Math.sqrt((length - x) / 2)];
    const ratio2 = ([a, b]) =>
        ((a - w[0]) ** 2 + (b - w[1]) ** 2) / ((a + w[0]) ** 2 + (b + w[1]) ** 2);
    return (ratio2([cosine, 0]) + ratio2([index2[0] * cosine, index2[1] * cosine])) / 2;
}

function powerScale(angle, p) {
    if (angle === "half" || angle === "reflection") return (p + 2) / (2 * Math.PI);
    return angle === "along_u" || angle === "along_v" ? Math.sqrt(p + 1) : 1;
}

/** Value of one colour at θ, §4. */
function shapeValue(shape, angle, theta, c) {
    const of = (name) => colours(shape[name])[c];
    const cos = Math.cos(theta);
    const sin = Math.sin(theta);
    switch (shape.shape) {
        case "beckmann":
            return Math.exp(-((sin / cos / of("sigma")) ** 2)) /
                (Math.PI * of("sigma") ** 2 * cos ** 4);
        case "ggx":
            return of("alpha") ** 2 /
                (Math.PI * (of("alpha") ** 2 * cos ** 2 + sin ** 2) ** 2);
        case "velvet": {
            const rim = theta === 0
                ? 0
                : 4 * Math.exp(-((cos / sin / of("sigma")) ** 2)) / sin ** 4;
            return (1 + rim) / (Math.PI * (1 + 4 * of("sigma") ** 2));
        }
        case "conductor":
            return reflectance(cos, of("n"), of("e"));
        case "dielectric":
            return reflectance(cos, of("n"), 0);
        case "schlick":
            return of("f0") + (of("f90") - of("f0")) * (1 - cos) ** 5;
        case "cosine_power":
            return powerScale(angle, of("exponent")) * cos ** of("exponent");
        case "constant":
            return of("value");
        default:
            throw new Error(`shape ${shape.shape}`);
    }
}

const fromFunction = (value) =>
    Array.from({ length: kSamples }, (_, k) => single(value(k / (kSamples - 1))));

export const shapedCurve = (shape, angle) =>
    fromFunction((u) => [0, 1, 2].map((c) => shapeValue(shape, angle, thetaOf(angle, u), c)));

const metal = (n, e) => ["difference", [[1, { shape: "conductor", n, e }]]];
const ggx = (alpha) => ({ shape: "ggx", alpha });
const rough = (shape, sigma) => ({ shape, sigma });
const kPresets = {
    gold: metal([0.21, 0.43, 1.38], [3.272, 2.455, 1.914]),
    silver: metal([0.06, 0.06, 0.04], [4.152, 3.586, 2.657]),
    copper: metal([0.3, 1.02, 1.24], [3.205, 2.577, 2.397]),
    aluminium: metal([1.279, 0.992, 0.649], [7.246, 6.492, 5.414]),
    pearl: ["half", [[0.35, ggx(0.03)], [0.65, rough("beckmann", 0.35)]]],
    satin: ["half", [[0.7, rough("beckmann", 0.3)], [0.3, rough("velvet", 0.5)]]],
    velvet: ["half", [[1, rough("velvet", 0.4)]]],
};

export function presetCurve(name) {
    const [angle, parts] = kPresets[name];
    const curves = parts.map(([weight, shape]) => [weight, shapedCurve(shape, angle)]);
    return Array.from({ length: kSamples }, (_, k) =>
        single([0, 1, 2].map((c) => curves.reduce((all, [w, it]) => all + w * it[k][c], 0))));
}

/** The monotone cubic through [u, y], §5. */
function monotoneCubic(points) {
    const last = points.length - 1;
    const secants = points.slice(1).map(([u, y], i) => (y - points[i][1]) / (u - points[i][0]));
    const m = points.map((_, i) => {
        if (last === 0) return 0;
        if (i === 0) return secants[0];
        if (i === last) return secants[last - 1];
        return secants[i - 1] * secants[i] > 0 ? (secants[i - 1] + secants[i]) / 2 : 0;
    });
    secants.forEach((slope, i) => {
        const l = slope === 0 ? Infinity : Math.hypot(m[i], m[i + 1]) / Math.abs(slope);
        if (l > 3) {
            m[i] *= 3 / l;
            m[i + 1] *= 3 / l;
        }
    });
    return (u) => {
        if (u <= points[0][0]) return points[0][1];
        if (u >= points[last][0]) return points[last][1];
        const i = points.findLastIndex(([at]) => at <= u);
        const width = points[i + 1][0] - points[i][0];
        const t = (u - points[i][0]) / width;
        const [y0, y1] = [points[i][1], points[i + 1][1]];
        // The cubic with these values and tangents at both ends.
        const third = 2 * (y0 - y1) + width * (m[i] + m[i + 1]);
        const second = 3 * (y1 - y0) - width * (2 * m[i] + m[i + 1]);
        return y0 + t * (width * m[i] + t * (second + t * third));
    };
}

/** Points [u, r, g, b], §5. */
export function curveFromPoints(points, scale) {
    const [there, back] = scale === "logarithmic" ? [Math.log, Math.exp] : [(x) => x, (x) => x];
    const cubics = [1, 2, 3].map((c) => monotoneCubic(points.map((p) => [p[0], there(p[c])])));
    return fromFunction((u) => cubics.map((cubic) => back(cubic(u))));
}

/** §6. */
export function withStroke(curve, { from, to, softness, values }) {
    return curve.map((before, k) => {
        const u = k / (kSamples - 1);
        if (u < from || u > to) return before;
        const at = to > from ? ((u - from) / (to - from)) * (values.length - 1) : 0;
        const i = Math.min(Math.floor(at), Math.max(0, values.length - 2));
        const next = values[Math.min(i + 1, values.length - 1)];
        const x = softness === 0 ? 1 : Math.min(1, Math.min(u - from, to - u) / softness);
        const w = x * x * (3 - 2 * x);
        return single(before.map((c, colour) => {
            const s = values[i][colour] + (at - i) * (next[colour] - values[i][colour]);
            return c + w * (s - c);
        }));
    });
}

const schlick = (f0, f90) => ({ shape: "schlick", f0, f90 });
const power = (exponent) => ({ shape: "cosine_power", exponent });
const least = (cosine) => Math.max(cosine, 1e-4);

/** Curves by angle, and `rest`, §3. */
function factorsOf(brdf) {
    switch (brdf.model) {
        case "ggx": {
            const a2 = brdf.alpha ** 2;
            const root = (c) => Math.sqrt(c * c * (1 - a2) + a2);
            return {
                curves: { half: ggx(brdf.alpha), difference: schlick(brdf.f0, brdf.f90) },
                rest: (ci, co) => 0.5 / (ci * root(co) + co * root(ci)),
            };
        }
        case "cook_torrance":
            return {
                curves: {
                    half: rough("beckmann", brdf.sigma),
                    difference: { shape: "conductor", n: brdf.n, e: brdf.e },
                },
                rest: (ci, co, cd) => {
                    const ch = (ci + co) / (2 * cd);
                    return Math.min(1, (2 * ch * Math.min(ci, co)) / cd) / (4 * ci * co);
                },
            };
        case "ashikhmin_shirley":
            return {
                curves: {
                    along_u: power(brdf.nu),
                    along_v: power(brdf.nv),
                    difference: schlick(brdf.rs, 1),
                },
                rest: (ci, co, cd) => 1 / (8 * Math.PI * cd * Math.max(ci, co)),
            };
        case "phong":
            return { curves: { reflection: power(brdf.exponent) }, rest: () => 1 };
        default:
            throw new Error(`model ${brdf.model}`);
    }
}

/** What an analytic BRDF reflects, in 1/sr, §3. */
export function reflected(brdf, wi, wo) {
    if (!(wi[2] > 0 && wo[2] > 0)) return [0, 0, 0];
    const { curves, rest } = factorsOf(brdf);
    const cd = least(Math.cos(angleBetween(wi, wo) / 2));
    let value = colours(brdf.model === "phong" ? brdf.ks : 1);
    value = value.map((x) => x * rest(least(wi[2]), least(wo[2]), cd));
    for (const [angle, shape] of Object.entries(curves)) {
        const factor = curveAt(shapedCurve(shape, angle), uOf(angle, wi, wo));
        value = value.map((x, c) => x * factor[c]);
    }
    return value;
}
