/** What an edit makes a server do again, by the sections in its patch. */
import { type JsonObject, kStages, type RoomState, type Stage } from "./state";

export function stagesOf(patch: JsonObject): Set<Stage> {
    const sections = Object.keys(kStages) as (keyof RoomState)[];
    return new Set(sections.filter((key) => key in patch).map((key) => kStages[key]));
}

/** More than how pictures are developed, and images worked out: the image is another one. */
export function makesAnotherImage(patch: JsonObject): boolean {
    const stages = stagesOf(patch);
    return stages.has("signal") || stages.has("view");
}
