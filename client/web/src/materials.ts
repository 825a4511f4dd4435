/** Edits of the scene's materials, which of them is selected on this page, and the way back. */
import { type Stroke, withStroke } from "./curve_stroke";
import { EditHistory } from "./edit_history";
import type { RoomConnection } from "./room_connection";
import { Signal } from "./signal";
import type { EditableMaterial } from "./wire/message";
import type { Json, JsonObject, MaterialEdit, RoomState } from "./wire/state";

/** An entry as this page's own edits may leave it until the server has made the samples. */
type PendingEdit = Partial<MaterialEdit> & { stroke?: Stroke | null };

/**
 * What makes the samples, of which an edit states one. The others are taken away, so that edits
 * that wait for each other merge into one that the server takes.
 */
const kNoOther: JsonObject = { points: null, shape: null, preset: null, stroke: null };

export function materialOf(material: EditableMaterial, state: RoomState): MaterialEdit {
    const entry: PendingEdit | undefined = state.materials[material.id];
    if (entry === undefined) return material.baked;
    const { stroke, ...fields } = entry;
    const edit: MaterialEdit = { ...material.baked, ...fields };
    // What was drawn is no shape; what an entry does not have it does not take from the bake.
    if ("samples" in entry || "points" in entry || "shape" in entry) {
        edit.points = fields.points ?? null;
        edit.shape = fields.shape ?? null;
    }
    if (stroke === undefined || stroke === null) return edit;
    return { ...edit, samples: withStroke(edit.samples, stroke), points: null, shape: null };
}

/** The patch of one material that makes it `edit` again, whatever it is; null as baked. */
export function entryOf(edit: MaterialEdit | null): JsonObject | null {
    if (edit === null) return null;
    return {
        ...(edit as unknown as JsonObject),
        points: (edit.points ?? null) as Json,
        shape: edit.shape ?? null,
    };
}

export class Materials {
    readonly selectionChanged = new Signal<EditableMaterial | null>();
    readonly history = new EditHistory<MaterialEdit>(
        (id) => this.stateOf(id),
        (id, edit) => this.connection.edit({ materials: { [id]: entryOf(edit) } }),
    );
    private selectedId: string | null = null;

    constructor(private readonly connection: RoomConnection) {
        connection.opened.listen(() => {
            this.history.forget();
            const { all } = this;
            const isThere = all.some(({ id }) => id === this.selectedId);
            if (!isThere) this.selectedId = all[0]?.id ?? null;
            this.selectionChanged.send(this.selected);
        });
    }

    get all(): readonly EditableMaterial[] {
        return this.connection.snapshot?.scene.materials ?? [];
    }

    /** Of a place in the map of the materials: of its curves the one selected, or the first. */
    idAtPlace(place: number): string | null {
        const name = [...new Set(this.all.map((material) => material.name))][place - 1];
        if (name === undefined) return null;
        if (this.selected?.name === name) return this.selectedId;
        return this.all.find((material) => material.name === name)?.id ?? null;
    }

    get selected(): EditableMaterial | null {
        return this.all.find(({ id }) => id === this.selectedId) ?? null;
    }

    select(id: string): void {
        if (id === this.selectedId || !this.all.some((material) => material.id === id)) return;
        this.history.end();
        this.selectedId = id;
        this.selectionChanged.send(this.selected);
    }

    /** The selected material as it shows. */
    get edit(): MaterialEdit | null {
        const { selected } = this;
        const { state } = this.connection;
        return selected === null || state === null ? null : materialOf(selected, state);
    }

    isEdited(id: string): boolean {
        return this.connection.state?.materials[id] !== undefined;
    }

    /** The curve of a drag so far, drawn over what was there when the drag began. */
    draw(stroke: Stroke): void {
        this.change({ ...kNoOther, stroke: stroke as unknown as Json });
    }

    setPoints(points: number[][], fields: JsonObject = {}): void {
        this.change({ ...kNoOther, points, ...fields });
    }

    setShape(shape: string, parameters: JsonObject): void {
        this.change({ ...kNoOther, shape, ...parameters });
    }

    setPreset(preset: string): void {
        this.history.begin(this.selectedId);
        this.change({ ...kNoOther, preset });
        this.history.end();
    }

    /**
     * Over the curve as it shows, which strokes that wait are part of: a stroke that followed one
     * would take its place, so the samples go whole.
     */
    lay(stroke: Stroke): void {
        const { edit } = this;
        if (edit === null) return;
        const samples = withStroke(edit.samples, stroke);
        this.change({ ...kNoOther, samples });
    }

    setColour(key: "tint" | "diffuse", colour: number[]): void {
        this.change({ [key]: colour });
    }

    /** Back to the bake. */
    reset(): void {
        const id = this.selectedId;
        if (id === null || !this.isEdited(id)) return;
        this.history.begin(id);
        this.connection.edit({ materials: { [id]: null } });
        this.history.end();
    }

    private change(fields: JsonObject): void {
        const id = this.selectedId;
        if (id === null) return;
        this.history.begin(id);
        this.connection.edit({ materials: { [id]: fields } });
    }

    private stateOf(id: string): MaterialEdit | null {
        const { state } = this.connection;
        const material = this.all.find((other) => other.id === id);
        if (state === null || material === undefined || !this.isEdited(id)) return null;
        return materialOf(material, state);
    }
}
