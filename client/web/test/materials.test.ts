import { describe, expect, it } from "vitest";
import { lightingOf, patchToLighting } from "../src/lighting";
import { EditHistory } from "../src/edit_history";
import { entryOf, materialOf } from "../src/materials";
import { composePatches } from "../src/wire/merge_patch";
import { type EditableMaterial, messageFromText, WireError } from "../src/wire/message";
import type { Json, JsonObject, MaterialEdit } from "../src/wire/state";
import { stateWith } from "./states";

function samples(value: number): number[][] {
    return Array.from({ length: 256 }, () => [value, value, value]);
}

const kBaked: MaterialEdit = {
    samples: samples(1),
    scale: "linear",
    shape: "ggx",
    roughness: 0.2,
    exponent: 50,
    n: [1.5, 1.5, 1.5],
    e: [0, 0, 0],
    f0: [0.04, 0.04, 0.04],
    f90: 1,
    value: [1, 1, 1],
    tint: [1, 1, 1],
    diffuse: [1, 1, 1],
};

const kPearl: EditableMaterial = {
    id: "pearl",
    name: "Pearl",
    curve: "distribution",
    angle: "half",
    shapes: ["ggx", "beckmann"],
    presets: ["pearl"],
    baked: kBaked,
};

function withEntry(entry: JsonObject): ReturnType<typeof stateWith> {
    return stateWith({ materials: { pearl: entry as unknown as MaterialEdit } });
}

describe("a material", () => {
    it("is as baked without an entry", () => {
        expect(materialOf(kPearl, stateWith())).toBe(kBaked);
    });

    it("shows a stroke that the server has not made samples of yet", () => {
        const stroke = { from: 0, to: 1, values: [[5, 5, 5]] };
        const edit = materialOf(kPearl, withEntry({ stroke }));
        expect(edit.samples[100]).toEqual([5, 5, 5]);
        expect(edit.shape).toBeNull();
        expect("stroke" in edit).toBe(false);
    });

    it("has no shape where its entry has none", () => {
        const entry = { ...kBaked, samples: samples(2) } as unknown as JsonObject;
        delete entry["shape"];
        const edit = materialOf(kPearl, withEntry(entry));
        expect(edit.shape).toBeNull();
        expect(edit.samples[0]).toEqual([2, 2, 2]);
    });

    it("is given back whole: what it did not have is taken away", () => {
        expect(entryOf(null)).toBeNull();
        const entry = entryOf({ ...kBaked, shape: null })!;
        expect(entry["shape"]).toBeNull();
        expect(entry["points"]).toBeNull();
        expect(entry["samples"]).toHaveLength(256);
    });
});

describe("the history", () => {
    function room(): { history: EditHistory<MaterialEdit>; put: (value: number | null) => void; now: () => Json } {
        let now: MaterialEdit | null = null;
        const history = new EditHistory<MaterialEdit>(
            () => now,
            (_id, edit) => (now = edit),
        );
        return {
            history,
            put: (value) => {
                history.begin("pearl");
                now = value === null ? null : { ...kBaked, samples: samples(value) };
            },
            now: () => now?.samples[0]?.[0] ?? null,
        };
    }

    it("takes a drag for one step, and goes back and forth", () => {
        const { history, put, now } = room();
        put(1);
        put(2);
        put(3);
        history.end();
        put(7);
        history.end();
        history.undo();
        expect(now()).toBe(3);
        history.undo();
        expect(now()).toBeNull();
        expect(history.canUndo).toBe(false);
        history.redo();
        history.redo();
        expect(now()).toBe(7);
        expect(history.canRedo).toBe(false);
    });

    it("forgets what was undone once something else is done", () => {
        const { history, put, now } = room();
        put(1);
        history.end();
        history.undo();
        put(2);
        history.end();
        expect(history.canRedo).toBe(false);
        history.redo();
        expect(now()).toBe(2);
    });

    it("knows what was before the latest step", () => {
        const { history, put } = room();
        expect(history.before("pearl")).toBeUndefined();
        put(1);
        expect(history.before("pearl")).toBeNull();
        history.end();
        put(2);
        expect(history.before("pearl")?.samples[0]).toEqual([1, 1, 1]);
        expect(history.before("post")).toBeUndefined();
    });
});

describe("edits that wait for each other", () => {
    it("merge into one that states one way of making samples", () => {
        const other = { points: null, shape: null, preset: null, stroke: null };
        const first = { materials: { pearl: { ...other, stroke: { from: 0, to: 1, values: [] } } } };
        const second = { materials: { pearl: { ...other, shape: "ggx", roughness: 0.1 } } };
        const merged = composePatches(first, second)["materials"] as JsonObject;
        const stated = Object.entries(merged["pearl"] as JsonObject)
            .filter(([, value]) => value !== null)
            .map(([key]) => key);
        expect(stated).toEqual(["shape", "roughness"]);
    });
});

describe("the summary of a scene", () => {
    const snapshot = (materials: unknown): string =>
        JSON.stringify({
            type: "snapshot",
            protocol: 1,
            room: "r",
            revision: 0,
            state: {},
            viewers: 1,
            limits: {},
            scene: { name: "e", width: 1, height: 1, face_resolution: 0, materials },
        });

    it("has its materials", () => {
        const message = messageFromText(snapshot([{ ...kPearl, more: 1 }]));
        expect(message?.type === "snapshot" && message.scene.materials).toEqual([kPearl]);
    });

    it.each([
        ["no name", [{ ...kPearl, name: 3 }]],
        ["no samples", [{ ...kPearl, baked: {} }]],
        ["255 samples", [{ ...kPearl, baked: { ...kBaked, samples: samples(1).slice(1) } }]],
        ["words among the shapes", [{ ...kPearl, shapes: [4] }]],
        ["no object", [7]],
    ])("is refused with %s", (_, materials) => {
        expect(() => messageFromText(snapshot(materials))).toThrow(WireError);
    });
});

describe("a lighting with materials", () => {
    it("takes the room's materials to those of the file", () => {
        const to = lightingOf(withEntry(kBaked as unknown as JsonObject), stateWith().display);
        const from = stateWith({ materials: { post: kBaked } });
        const patch = patchToLighting(from, to)["materials"] as JsonObject;
        expect(patch["post"]).toBeNull();
        expect(patch["pearl"]).toMatchObject({ shape: "ggx", points: null });
        expect(Object.keys(patch).sort()).toEqual(["pearl", "post"]);
    });
});
