import { describe, expect, it } from "vitest";
import { lightNameFromText, lightsNow, orderedLights } from "../src/area_lights";
import { linearFromHex } from "../src/colour";
import { levelText } from "../src/format";
import { hexFromKelvin, kelvinFromText, linearFromKelvin } from "../src/kelvin";
import {
    fieldsFromLevel,
    levelOfLight,
    radianceAtRadius,
    solidAngleSr,
    texelRadiusDegrees,
} from "../src/light_level";
import { environmentScale } from "../src/light_picture";
import { angleDegrees, keyStops, newLight } from "../src/new_light";
import { type AreaLight, kRanges, type RoomState } from "../src/wire/state";

const kLight: AreaLight = {
    direction: [0, 1, 0],
    angular_radius_degrees: 6,
    radiance: [100, 50, 25],
    gain: 1,
    tint: [1, 1, 1],
    muted: false,
    solo: false,
    order: 0,
};

describe("a light's level", () => {
    it("is power: radiance times solid angle, 0 EV for a white surface of radiance 1", () => {
        expect(solidAngleSr(90)).toBeCloseTo(2 * Math.PI, 12);
        expect(solidAngleSr(0.05)).toBeCloseTo(2 * Math.PI * 3.8077e-7, 9);
        const radiance = Math.PI / solidAngleSr(2);
        const light = {
            ...kLight,
            angular_radius_degrees: 2,
            radiance: [radiance, radiance, 0],
        } as AreaLight;
        expect(levelOfLight(light).stops).toBeCloseTo(0, 12);
        expect(levelOfLight({ ...light, gain: 4 }).stops).toBeCloseTo(2, 12);
        expect(levelOfLight({ ...light, tint: [0.5, 0.5, 0.5] }).stops).toBeCloseTo(-1, 12);
        expect(levelText(levelOfLight({ ...light, gain: 0 }).stops)).toBe("no light");
    });

    it("comes back from the fields it gives", () => {
        for (const stops of [-6, 0, 3.25]) {
            for (const radius of [0.5, 20, 90]) {
                const fields = fieldsFromLevel({ stops, colour: "#ff8040" }, radius);
                const level = levelOfLight({
                    ...kLight,
                    ...fields,
                    angular_radius_degrees: radius,
                });
                expect(level.stops).toBeCloseTo(stops, 9);
                expect(level.colour).toBe("#ff8040");
            }
        }
        expect(Math.max(...fieldsFromLevel({ stops: 60, colour: "#fff" }, 1).radiance)).toBe(
            kRanges.lights.radiance.highest,
        );
    });

    it("stays when the radius changes and power is kept", () => {
        for (const radius of [0.05, 0.7, 20, 90]) {
            const grown = {
                ...kLight,
                angular_radius_degrees: radius,
                radiance: radianceAtRadius(kLight, radius),
            };
            expect(levelOfLight(grown).stops).toBeCloseTo(levelOfLight(kLight).stops, 9);
        }
        const bright = { ...kLight, radiance: [9e7, 0, 0] } as AreaLight;
        expect(radianceAtRadius(bright, 0.05)[0]).toBeCloseTo(kRanges.lights.radiance.highest, 3);
    });

    it("knows the texel of the lighting cubemap", () => {
        for (const n of [16, 64, 256]) {
            expect(solidAngleSr(texelRadiusDegrees(n))).toBeCloseTo(
                (4 * Math.PI) / (6 * n * n),
                12,
            );
        }
    });
});

describe("new lights", () => {
    const picture = { medianRadiance: 0.3, exposureStops: 0 };

    it("are apart in place and level, last in order, each with its own id", () => {
        const lights: { [id: string]: AreaLight } = {};
        for (let i = 0; i < 12; ++i) {
            const { id, light } = newLight(lights, picture);
            expect(id in lights).toBe(false);
            for (const other of Object.values(lights)) {
                expect(angleDegrees(light.direction, other.direction)).toBeGreaterThan(15);
                expect(light.order).toBeGreaterThan(other.order);
            }
            lights[id] = light;
        }
        const { key, fill, rim } = lights;
        const stops = [key!, fill!, rim!].map((light) => levelOfLight(light).stops);
        expect(stops[1]! - stops[0]!).toBeCloseTo(-2, 9);
        expect(new Set(stops).size).toBe(3);
        expect(fill!.angular_radius_degrees).toBeGreaterThan(2 * key!.angular_radius_degrees);
    });

    it("follow the picture, and its exposure where it is black", () => {
        const brighter = { ...picture, medianRadiance: 1.2 };
        expect(keyStops(brighter) - keyStops(picture)).toBeCloseTo(2, 9);
        const dark = { medianRadiance: 0, exposureStops: 3 };
        const none = { medianRadiance: null, exposureStops: 0 };
        expect(keyStops(dark) - keyStops(none)).toBeCloseTo(-3, 9);
    });

    it("stand where they are asked for", () => {
        expect(newLight({}, picture, [0, 0, -1]).light.direction).toEqual([0, 0, -1]);
    });
});

describe("the list of lights", () => {
    it("is in order, equals by id", () => {
        const lights = {
            b: { ...kLight, order: 1 },
            a: { ...kLight, order: 1 },
            z: { ...kLight, order: -2 },
        };
        expect(orderedLights(lights).map(([id]) => id)).toEqual(["z", "a", "b"]);
    });

    it("keeps what the server takes of a name", () => {
        expect(lightNameFromText("  Window\u0007 left ")).toBe("Window  left");
        expect(lightNameFromText("キー")).toBe("キー");
        expect([...lightNameFromText("💡".repeat(80))!].length).toBe(64);
        for (const nothing of ["", "  ", "\n\u0000\u0085"]) {
            expect(lightNameFromText(nothing)).toBeNull();
        }
    });

    it("knows which lights light: mute wins over solo, solo over the rest", () => {
        const solo = { ...kLight, solo: true };
        const muted = { ...kLight, muted: true };
        const both = { ...solo, muted: true };
        expect(lightsNow(kLight, { kLight })).toBe(true);
        expect(lightsNow(muted, { muted })).toBe(false);
        expect(lightsNow(kLight, { kLight, solo })).toBe(false);
        expect(lightsNow(solo, { kLight, solo })).toBe(true);
        expect(lightsNow(both, { kLight, both })).toBe(false);
        expect(lightsNow(kLight, { kLight, both })).toBe(false);
        const state = (lights: object, gain: number) =>
            ({ environment: { gain, tint: [1, 0.5, 0] }, lights }) as unknown as RoomState;
        expect(environmentScale(state({ kLight }, 2))).toEqual([2, 1, 0]);
        expect(environmentScale(state({ both }, 2))).toEqual([0, 0, 0]);
        expect(environmentScale(state({}, 0))).toEqual([0, 0, 0]);
    });
});

describe("Kelvin", () => {
    it.each([
        ["3200K", 3200],
        [" 5600 k", 5600],
        ["4.5kK", 4500],
        ["4,5 kK", 4500],
        ["3200 Kelvin", 3200],
        ["3200", null],
        ["#3200ff", null],
        ["K", null],
        ["100K", null],
        ["90000K", null],
    ])("%s", (text, kelvin) => expect(kelvinFromText(text)).toBe(kelvin));

    it("gives the colours of black bodies", () => {
        // Chromaticities of the Planckian locus [CIE 1931, 2 degrees].
        for (const [kelvin, x, y] of [
            [2000, 0.5267, 0.4133],
            [2856, 0.4475, 0.4074],
            [3200, 0.4234, 0.399],
            [5000, 0.3451, 0.3516],
            [6500, 0.3135, 0.3237],
            [10000, 0.2807, 0.2884],
        ] as const) {
            const [r, g, b] = linearFromKelvin(kelvin);
            if (kelvin === 2000) {
                expect(b).toBeLessThan(0.02); // at the edge of the gamut
                continue;
            }
            const X = 0.4124564 * r + 0.3575761 * g + 0.1804375 * b;
            const Y = 0.2126729 * r + 0.7151522 * g + 0.072175 * b;
            const Z = 0.0193339 * r + 0.119192 * g + 0.9503041 * b;
            expect(X / (X + Y + Z)).toBeCloseTo(x, 2);
            expect(Y / (X + Y + Z)).toBeCloseTo(y, 2);
            expect(Math.max(r, g, b)).toBe(1);
        }
        const [r, g, b] = linearFromHex(hexFromKelvin(3200));
        expect(r).toBe(1);
        expect(g).toBeGreaterThan(b);
    });
});
