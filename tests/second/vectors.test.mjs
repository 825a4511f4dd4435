// Every vector of protocol/ through the second implementation.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import {
    curveFromPoints, daubechies4, presetCurve, reflected, shapedCurve, withStroke,
} from "./curves.mjs";
import { innerCubemap, lightingCubemap, lightsOf, profile } from "./lighting_cubemap.mjs";
import { levelsOf } from "./source_map.mjs";
import { relit, readTransport } from "./transport.mjs";
import { codeOf, halfPlanes, imageHeader, isName, merged } from "./wire.mjs";

const wire = new URL("../../protocol/wire/vectors/", import.meta.url);
const read = (name) => JSON.parse(readFileSync(new URL(name, wire), "utf8"));
const frameOf = ({ hex }, more) => Buffer.concat([Buffer.from(hex, "hex"), Buffer.alloc(more)]);

test("image headers decode to their fields", () => {
    for (const vector of read("image_headers.json")) {
        const { fields } = vector;
        const header = imageHeader(frameOf(vector, fields.payload_bytes));
        for (const [key, value] of Object.entries(fields)) {
            const isFloat = key.endsWith("_ms") || key === "relative_error";
            const expected = isFloat ? Math.fround(value) : value;
            assert.equal(header[key], expected, `${vector.name}: ${key}`);
        }
    }
});

test("malformed image headers are refused at their field", () => {
    for (const vector of read("image_headers_malformed.json")) {
        assert.throws(() => imageHeader(frameOf(vector, vector.payload_bytes)),
            { message: vector.field }, vector.name);
    }
});

test("half planes decode to their values", () => {
    for (const v of read("half_images.json")) {
        const values = halfPlanes(Buffer.from(v.payload, "hex"), v.width, v.height, v.has_alpha);
        assert.deepEqual([...values], v.values, v.name);
    }
});

test("malformed half planes are refused", () => {
    for (const v of read("half_images_malformed.json")) {
        const decode = () =>
            halfPlanes(Buffer.from(v.payload, "hex"), v.width, v.height, v.has_alpha);
        assert.throws(decode, undefined, v.name);
    }
});

test("values are shown by their codes", () => {
    for (const vector of read("display.json")) {
        assert.equal(codeOf(vector.linear, vector), vector.code, JSON.stringify(vector));
    }
});

test("names are taken and refused", () => {
    const { valid, invalid } = read("names.json");
    for (const name of valid) assert.ok(isName(name), name);
    for (const name of invalid) assert.ok(!isName(name), name);
});

/** Numbers alike up to rounding. */
function assertAlike(found, expected, where) {
    if (typeof expected === "number" && typeof found === "number") {
        assert.ok(Math.abs(found - expected) <= 1e-12 * Math.max(1, Math.abs(expected)), where);
    } else if (expected !== null && typeof expected === "object") {
        assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort(), where);
        for (const key of Object.keys(expected)) {
            assertAlike(found[key], expected[key], `${where}/${key}`);
        }
    } else {
        assert.equal(found, expected, where);
    }
}

test("normalised patches merged into the state give the result", () => {
    for (const { name, state, normalised, result } of read("patches.json")) {
        if (normalised !== undefined) assertAlike(merged(state, normalised), result, name);
    }
});

test("states light as the texels of the cubemap say", () => {
    const { face_resolution: n, maps, cases } = read("lightings.json");
    const inner = Object.fromEntries(
        Object.entries(maps).map(([name, map]) => [name, innerCubemap(levelsOf(map), n)]));
    for (const { name, state, texels } of cases) {
        const [first, second] = [state.environment.name, state.blend.name];
        const found = lightingCubemap(lightsOf(state), inner[first], inner[second], n);
        texels.forEach((plane, colour) => {
            const tolerance = 1e-8 * Math.max(...plane);
            plane.forEach((expected, texel) => {
                const where = `${name}: colour ${colour}, texel ${texel}`;
                assert.ok(Math.abs(found[colour][texel] - expected) <= tolerance, where);
            });
        });
    }
});

test("round lights have the stated profile", () => {
    for (const vector of read("light_profiles.json")) {
        const { f } = profile((vector.angular_radius_degrees * Math.PI) / 180, vector.edge);
        vector.distances.forEach((distance, i) => {
            const off = Math.abs(f(distance) - vector.coverages[i]);
            assert.ok(off <= 1e-8, `${JSON.stringify(vector)} at ${distance}`);
        });
    }
});

test("transport directories give their stated values", () => {
    for (const name of ["haar", "sh"]) {
        const folder = fileURLToPath(
            new URL(`../../protocol/transport/vectors/${name}`, import.meta.url));
        const transport = readTransport(`${folder}.relume`);
        const responses = new Map();
        const stated = JSON.parse(readFileSync(`${folder}.json`, "utf8"));
        const { width } = transport.manifest.image;
        for (const { x, y, colour, column, value } of stated) {
            if (!responses.has(column)) {
                const one = new Float64Array(transport.columns);
                one[column] = 1;
                responses.set(column, relit(transport, [one, one, one]));
            }
            const found = responses.get(column)[3 * (y * width + x) + colour];
            const where = `${name}: (${x}, ${y}), colour ${colour}, column ${column}`;
            assert.ok(Math.abs(found - value) <= 1e-9 * Math.max(1, Math.abs(value)), where);
        }
    }
});

const curves = JSON.parse(
    readFileSync(new URL("../../protocol/curve/vectors/curves.json", import.meta.url), "utf8"));

function near(value, expected, tolerance, what) {
    expected.forEach((x, c) => {
        assert.ok(Math.abs(value[c] - x) <= tolerance, `${what}: found ${value[c]}, not ${x}`);
    });
}

function haveSamples(curve, { samples, ...what }) {
    for (const [k, expected] of Object.entries(samples)) {
        expected.forEach((x, c) => {
            near([curve[k][c]], [x], 1e-6 * x, `${JSON.stringify(what)}, sample ${k}`);
        });
    }
}

test("curves have their samples", () => {
    for (const v of curves.shapes) haveSamples(shapedCurve(v.shape, v.angle), v);
    for (const v of curves.presets) haveSamples(presetCurve(v.name), v);
    for (const v of curves.points) haveSamples(curveFromPoints(v.points, v.scale), v);
    for (const v of curves.strokes) {
        haveSamples(withStroke(shapedCurve(v.shape, v.angle), v.stroke), v);
    }
});

test("curves have their coefficients", () => {
    for (const v of curves.coefficients) {
        const curve = shapedCurve(v.shape, v.angle);
        const found = [0, 1, 2].map((c) => daubechies4(curve.map((sample) => sample[c])));
        for (const [j, expected] of Object.entries(v.coefficients)) {
            const largest = Math.max(...found.flatMap((values) => [...values]));
            near(found.map((values) => values[j]), expected, 1e-6 * largest, `coefficient ${j}`);
        }
    }
});

test("surfaces reflect by their curves", () => {
    for (const v of curves.reflected) {
        const what = JSON.stringify([v.brdf, v.wi, v.wo]);
        near(reflected(v.brdf, v.wi, v.wo), v.value, 2e-5 * Math.max(...v.value), what);
    }
});
