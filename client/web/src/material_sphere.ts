/**
 * A small sphere of the selected material in a photographer's studio: two soft boxes and a dim
 * room. It shows at once where a curve leads, and is an indication: it has no shadows and no
 * interreflection, and what the server does not say of a BRDF is guessed from its bake. The image
 * is the server's.
 */
import { uFromDegrees } from "./curve_angle";
import { displayFromLinear } from "./display";
import { make } from "./dom";
import { kCurveSamples } from "./wire/message";
import type { EditableMaterial } from "./wire/message";
import type { MaterialEdit, Triple } from "./wire/state";

const kSide = 64;
const kRightAngle = Math.PI / 2;
/** Normals halfway between light and viewer: rings around the surface's, dense in the middle. */
const kRings = 48;
const kSpokes = 8;
const kHalfways = kRings * kSpokes;
/** Directions of the light that falls on a matt surface. */
const kSkyDirections = 256;

/** A rectangle of light in the direction of `towards`, half as wide and as high in tangents. */
interface SoftBox {
    towards: Triple;
    right: Triple;
    above: Triple;
    across: number;
    up: number;
    radiance: number;
}

function softBox(towards: Triple, across: number, up: number, radiance: number): SoftBox {
    const forward = unit(towards);
    const right = unit([forward[2], 0, -forward[0]]);
    return { towards: forward, right, above: cross(forward, right), across, up, radiance };
}

function unit(v: Triple): Triple {
    const length = Math.hypot(...v);
    return v.map((part) => part / length) as Triple;
}

function dot(a: Triple, b: Triple): number {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a: Triple, b: Triple): Triple {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

const kSoftBoxes = [
    softBox([-0.7, 0.75, 0.65], 0.36, 0.36, 5),
    softBox([0.95, 0.25, 0.35], 0.14, 0.6, 2.5),
];
/** Of the edges of a soft box, in its width. */
const kEdge = 0.12;

function radianceFrom(d: Triple): number {
    let radiance = 0.2 * (1 + 0.7 * d[1]);
    for (const box of kSoftBoxes) {
        const ahead = dot(d, box.towards);
        if (ahead <= 0) continue;
        const x = Math.abs(dot(d, box.right) / ahead) / box.across;
        const y = Math.abs(dot(d, box.above) / ahead) / box.up;
        const inside = Math.min(1, Math.max(0, (1 + kEdge - Math.max(x, y)) / (2 * kEdge)));
        radiance += box.radiance * inside;
    }
    return radiance;
}

function uFromRadians(angle: string, radians: number): number {
    return uFromDegrees(angle, (Math.min(kRightAngle, radians) / kRightAngle) * 90);
}

function radiansFromCosine(cosine: number): number {
    return Math.acos(Math.min(1, Math.max(0, cosine)));
}

/** Of a smooth surface, straight on. */
function reflectance({ baked }: EditableMaterial): Triple {
    if (baked.shape === "beckmann") {
        return baked.n.map((n, c) => {
            const e = baked.e[c]!;
            return ((n - 1) ** 2 + e * e) / ((n + 1) ** 2 + e * e);
        }) as Triple;
    }
    return baked.shape === "ggx" ? baked.f0 : [1, 1, 1];
}

interface Geometry {
    n: Triple;
    wi: Triple;
    ci: number;
    co: number;
    /** Of half and difference angle. */
    ch: number;
    cd: number;
    h: Triple;
}

const kView: Triple = [0, 0, 1];

/** u at which the curve is met, and what the rest of the BRDF multiplies it with. */
function meeting(material: EditableMaterial, at: Geometry): { u: number; rest: number } {
    const { angle, baked } = material;
    const { n, wi, ci, co, ch, cd, h } = at;
    const alpha = baked.roughness;
    const r = (c: number): number => Math.sqrt(c * c * (1 - alpha * alpha) + alpha * alpha);
    const smith = 0.5 / Math.max(1e-3, ci * r(co) + co * r(ci));
    switch (angle) {
        case "half":
            return { u: uFromRadians(angle, radiansFromCosine(ch)), rest: smith };
        case "difference": {
            const spread = alpha * alpha * ch * ch + (1 - ch * ch);
            const distribution = (alpha * alpha) / (Math.PI * spread * spread);
            return {
                u: uFromRadians(angle, radiansFromCosine(cd)),
                rest: distribution * smith,
            };
        }
        case "incidence":
            return { u: uFromRadians(angle, radiansFromCosine(ci)), rest: 1 };
        case "viewing":
            return { u: uFromRadians(angle, radiansFromCosine(co)), rest: 1 };
        case "reflection": {
            const mirrored = 2 * ci * co - dot(wi, kView);
            return { u: uFromRadians(angle, radiansFromCosine(mirrored)), rest: 1 };
        }
        default: {
            // The tangents run around the sphere's upright axis, and along it.
            const tangent = unit([n[2], 0, -n[0]]);
            const along = dot(h, tangent) ** 2 / Math.max(1e-9, 1 - ch * ch);
            const mine = angle === "along_u" ? along : 1 - along;
            const other = Math.sqrt(baked.exponent + 1) * ch ** (baked.exponent * (1 - mine));
            return {
                u: uFromRadians(angle, radiansFromCosine(ch ** mine)),
                rest: other / (8 * Math.PI * Math.max(1e-3, cd) * Math.max(ci, co)),
            };
        }
    }
}

/** Pixels that show the sphere, its normals there, and the light that falls on them. */
const sphere = ((): { pixels: number[]; normals: Triple[]; irradiance: number[] } => {
    const pixels: number[] = [];
    const normals: Triple[] = [];
    for (let i = 0; i < kSide * kSide; ++i) {
        const x = ((i % kSide) + 0.5) / (kSide / 2) - 1;
        const y = 1 - (Math.floor(i / kSide) + 0.5) / (kSide / 2);
        const rest = 1 - x * x - y * y;
        if (rest <= 0.002) continue;
        pixels.push(i);
        normals.push([x, y, Math.sqrt(rest)]);
    }
    const sky = Array.from({ length: kSkyDirections }, (_, i) => {
        const y = 1 - (2 * i + 1) / kSkyDirections;
        const turn = i * Math.PI * (3 - Math.sqrt(5));
        const across = Math.sqrt(1 - y * y);
        const d: Triple = [across * Math.cos(turn), y, across * Math.sin(turn)];
        return { d, power: (radianceFrom(d) * 4 * Math.PI) / kSkyDirections };
    });
    const irradiance = normals.map((n) =>
        sky.reduce((sum, { d, power }) => sum + Math.max(0, dot(n, d)) * power, 0),
    );
    return { pixels, normals, irradiance };
})();

/** Of every pixel of the sphere and every halfway normal: the sample met, and its weight. */
class SphereTable {
    readonly sample = new Uint8Array(sphere.pixels.length * kHalfways);
    readonly weight = new Float32Array(this.sample.length);

    constructor(readonly material: EditableMaterial) {
        sphere.normals.forEach((n, p) => {
            const t = unit([n[2], 0, -n[0]]);
            const b = cross(n, t);
            for (let i = 0; i < kHalfways; ++i) {
                const ring = Math.floor(i / kSpokes);
                const place = (ring + 0.5) / kRings;
                const theta = kRightAngle * place * place;
                const phi = 2 * Math.PI * ((i % kSpokes) / kSpokes + ring * 0.618034);
                const [ch, across] = [Math.cos(theta), Math.sin(theta)];
                const [x, y] = [across * Math.cos(phi), across * Math.sin(phi)];
                const h = [0, 1, 2].map((c) => x * t[c]! + y * b[c]! + ch * n[c]!) as Triple;
                const cd = dot(h, kView);
                if (cd <= 0) continue;
                const wi = [0, 1, 2].map((c) => 2 * cd * h[c]! - kView[c]!) as Triple;
                const ci = dot(n, wi);
                if (ci <= 0) continue;
                const { u, rest } = meeting(this.material, { n, wi, ci, co: n[2], ch, cd, h });
                const ringWidth = (2 * kRightAngle * place) / kRings;
                const solidAngle = 4 * cd * across * ringWidth * ((2 * Math.PI) / kSpokes);
                const at = p * kHalfways + i;
                this.sample[at] = Math.round(u * (kCurveSamples - 1));
                this.weight[at] = radianceFrom(wi) * rest * ci * solidAngle;
            }
        });
    }
}

export class MaterialSphere {
    readonly element = make("canvas", "material-sphere", {
        role: "img",
        "aria-label": "An indication of the material, in a studio",
        title: "The material in a studio: an indication. The image is exact, this is not.",
    });
    private table: SphereTable | null = null;

    draw(material: EditableMaterial, edit: MaterialEdit): void {
        this.element.width = this.element.height = kSide;
        const context = this.element.getContext("2d");
        if (context === null) return;
        if (this.table?.material !== material) this.table = new SphereTable(material);
        const { sample, weight } = this.table;
        const { pixels, irradiance } = sphere;
        const image = context.createImageData(kSide, kSide);
        const mirror = reflectance(material);
        const matt = mirror.map((part) => (0.6 * (1 - Math.min(1, part))) / Math.PI);
        for (let c = 0; c < 3; ++c) {
            const curve = edit.samples.map((rgb) => rgb[c]! * edit.tint[c]! * mirror[c]!);
            pixels.forEach((pixel, p) => {
                let radiance = matt[c]! * edit.diffuse[c]! * irradiance[p]!;
                for (let l = p * kHalfways; l < (p + 1) * kHalfways; ++l) {
                    radiance += curve[sample[l]!]! * weight[l]!;
                }
                image.data[pixel * 4 + c] = displayByte(radiance);
            });
        }
        for (const pixel of pixels) image.data[pixel * 4 + 3] = 255;
        context.putImageData(image, 0, 0);
    }
}

const kDisplay = { exposure_stops: 0, tone: "filmic" } as const;

function displayByte(radiance: number): number {
    return Math.round(255 * displayFromLinear(radiance, kDisplay));
}
