import { describe, expect, it } from "vitest";
import type { OfferedMaterial } from "../src/api";
import { lobeTitles } from "../src/finish_controls";
import { titleOf } from "../src/finish_panel";
import { coloursOf, entryOf, parameterOf } from "../src/finishes";
import { lightingOf, patchToLighting } from "../src/lighting";
import { messageFromText, WireError } from "../src/wire/message";
import type { Finish } from "../src/wire/state";
import { stateWith } from "./states";

const kPhong: OfferedMaterial = {
    name: "phong",
    face_resolution: 64,
    colours: [[1, 1, 1]],
    parameter: "exponent",
    steps: [4, 16, 64],
};

function offered(colours: OfferedMaterial["colours"]): OfferedMaterial {
    return { name: "m", face_resolution: 64, colours };
}

describe("a finish", () => {
    it("is at the middle of its family where it states no number", () => {
        expect(parameterOf({ material: "phong" }, kPhong)).toBe(16);
        expect(parameterOf({ material: "phong" }, { ...kPhong, steps: [4, 16] })).toBe(16);
        expect(parameterOf({ material: "phong", parameter: 5 }, kPhong)).toBe(5);
    });

    it("has the material's colours where it states none", () => {
        expect(coloursOf({ material: "phong" }, kPhong)).toEqual([[1, 1, 1]]);
        expect(coloursOf({ material: "phong", colours: [[1, 0, 0]] }, kPhong)).toEqual([
            [1, 0, 0],
        ]);
    });

    it("comes back whole, also what it did not state", () => {
        expect(entryOf(null)).toBeNull();
        expect(entryOf({ material: "gold" })).toEqual({
            material: "gold",
            parameter: null,
            colours: null,
        });
    });

    it("is part of a lighting, and goes where another lighting lacks it", () => {
        const gold: Finish = { material: "gold" };
        const to = lightingOf(stateWith({ finishes: { floor: gold } }), stateWith().display);
        const from = stateWith({ finishes: { wall: gold } });
        expect(patchToLighting(from, to)["finishes"]).toEqual({
            wall: null,
            floor: { material: "gold", parameter: null, colours: null },
        });
    });
});

describe("a part", () => {
    it("is called by its ID where its name says too little", () => {
        const parts = [
            { id: "floor", name: "Floor" },
            { id: "Material_20", name: "Material_20" },
            { id: "Material_20-2", name: "Material_20" },
            { id: "material", name: "" },
        ];
        expect(parts.map((part) => titleOf(part, parts))).toEqual([
            "Floor",
            "Material_20",
            "Material_20-2",
            "material",
        ]);
    });
});

describe("the lobes of a material", () => {
    it("are called what they are", () => {
        expect(lobeTitles(offered([[1, 1, 1]]))).toEqual(["colour"]);
        expect(
            lobeTitles(
                offered([
                    [0.5, 0.5, 0.5],
                    [0.04, 0.04, 0.04],
                    [1, 1, 1],
                ]),
            ),
        ).toEqual(["diffuse", "straight on", "grazing"]);
        expect(
            lobeTitles(
                offered([
                    [1, 1, 1],
                    [1, 1, 1],
                ]),
            ),
        ).toEqual(["lobe 1", "lobe 2"]);
    });

    it("are not to be coloured where the material is measured", () => {
        expect(
            lobeTitles(
                offered([
                    [1, 0, 0],
                    [0, 1, 0],
                    [0, 0, 1],
                ]),
            ),
        ).toEqual([]);
    });
});

describe("a snapshot of a scene with parts", () => {
    const snapshot = (parts: unknown): string =>
        JSON.stringify({
            type: "snapshot",
            protocol: 1,
            room: "r",
            revision: 0,
            viewers: 1,
            limits: {},
            state: stateWith(),
            scene: {
                name: "t",
                width: 1,
                height: 1,
                face_resolution: 16,
                visibility_resolution: 64,
                parts,
            },
        });

    it("has them", () => {
        const message = messageFromText(snapshot([{ id: "floor", name: "Floor" }]));
        const scene = message?.type === "snapshot" ? message.scene : null;
        expect(scene?.parts).toEqual([{ id: "floor", name: "Floor" }]);
        expect(scene?.visibility_resolution).toBe(64);
    });

    it("is refused where a part has no ID", () => {
        expect(() => messageFromText(snapshot([{ name: "Floor" }]))).toThrow(WireError);
        expect(() => messageFromText(snapshot(["floor"]))).toThrow(WireError);
    });
});
