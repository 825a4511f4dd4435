/** Materials that parts of the scene are given, which part is selected here, and the way back. */
import type { OfferedMaterial } from "./api";
import { EditHistory } from "./edit_history";
import type { RoomConnection } from "./room_connection";
import { Signal } from "./signal";
import type { ScenePart } from "./wire/message";
import type { Finish, JsonObject, Triple } from "./wire/state";

/** The patch of one part that gives it `finish` again, whole; null as baked. */
export function entryOf(finish: Finish | null): JsonObject | null {
    if (finish === null) return null;
    const { material, parameter, colours } = finish;
    return { material, parameter: parameter ?? null, colours: colours ?? null };
}

/** The number that a finish of a family shows: a family without one is at its middle step. */
export function parameterOf(finish: Finish, { steps = [] }: OfferedMaterial): number {
    return finish.parameter ?? steps[Math.floor(steps.length / 2)] ?? 1;
}

/** One colour a lobe: the finish's, or else the material's own. */
export function coloursOf(finish: Finish, offered: OfferedMaterial): Triple[] {
    return (finish.colours as Triple[] | null | undefined) ?? offered.colours;
}

export class Finishes {
    readonly selectionChanged = new Signal<ScenePart | null>();
    readonly offerChanged = new Signal<void>();
    readonly history = new EditHistory<Finish>(
        (id) => this.finishOf(id),
        (id, finish) => this.connection.edit({ finishes: { [id]: entryOf(finish) } }),
    );
    private selectedId: string | null = null;
    private offer: readonly OfferedMaterial[] = [];

    constructor(private readonly connection: RoomConnection) {
        connection.opened.listen(() => {
            this.history.forget();
            const { parts } = this;
            if (!parts.some(({ id }) => id === this.selectedId)) {
                this.selectedId = parts[0]?.id ?? null;
            }
            this.selectionChanged.send(this.selected);
        });
    }

    /** Whether the scene takes edits of finishes, and has parts. */
    get isTaken(): boolean {
        const scene = this.connection.snapshot?.scene;
        return scene?.edits?.includes("finishes") === true && this.parts.length > 0;
    }

    get parts(): readonly ScenePart[] {
        return this.connection.snapshot?.scene.parts ?? [];
    }

    /** What the server offers, for scenes of any resolution. */
    setOffer(offer: readonly OfferedMaterial[]): void {
        this.offer = offer;
        this.offerChanged.send();
    }

    /** What the scene's parts can be given. */
    get offered(): readonly OfferedMaterial[] {
        const n = this.connection.snapshot?.scene.visibility_resolution;
        return this.offer.filter((material) => material.face_resolution === n);
    }

    offeredAs(name: string): OfferedMaterial | null {
        return this.offered.find((material) => material.name === name) ?? null;
    }

    get selected(): ScenePart | null {
        return this.parts.find(({ id }) => id === this.selectedId) ?? null;
    }

    select(id: string): void {
        if (id === this.selectedId || !this.parts.some((part) => part.id === id)) return;
        this.history.end();
        this.selectedId = id;
        this.selectionChanged.send(this.selected);
    }

    /** null is as baked. */
    finishOf(id: string): Finish | null {
        return this.connection.state?.finishes?.[id] ?? null;
    }

    /** Of the selected part. */
    get finish(): Finish | null {
        return this.selectedId === null ? null : this.finishOf(this.selectedId);
    }

    /** With the material's own number and colours; null takes the finish away. */
    give(material: string | null): void {
        const id = this.selectedId;
        if (id === null || (this.finishOf(id)?.material ?? null) === material) return;
        this.history.begin(id);
        const entry = material === null ? null : { material, parameter: null, colours: null };
        this.connection.edit({ finishes: { [id]: entry } });
        this.history.end();
    }

    setParameter(parameter: number): void {
        this.change({ parameter });
    }

    setColours(colours: readonly Triple[]): void {
        this.change({ colours: colours.map((colour) => [...colour]) });
    }

    private change(fields: JsonObject): void {
        const id = this.selectedId;
        if (id === null || this.finishOf(id) === null) return;
        this.history.begin(id);
        this.connection.edit({ finishes: { [id]: fields } });
    }
}
