/**
 * Bringing a lighting into the room: the one that a restarted server has forgotten, or one from
 * a file. A map that the server does not have is uploaded again from this browser's copy; where
 * there is none, all but the map comes back, and words say so.
 */
import { type Api, ApiError } from "./api";
import { type Lighting, mapsOf, patchToLighting, withoutMaps } from "./lighting";
import type { Notices } from "./notices";
import type { RoomConnection } from "./room_connection";
import type { UploadStore } from "./upload_store";
import { titleOf } from "./wire/message";
import { sameJson } from "./wire/same_json";
import type { Json, RoomState } from "./wire/state";

const kLostWords = "The connection was lost before the light was back";

export class LightReturn {
    private offered: Lighting | null = null;
    private takeOfferAway: (() => void) | null = null;
    private busy = false;

    constructor(
        private readonly connection: RoomConnection,
        private readonly api: Api,
        private readonly uploads: UploadStore,
        private readonly notices: Notices,
        /** The server has maps that it did not have before. */
        private readonly mapsChanged: () => Promise<void>,
    ) {}

    /**
     * A server that was started anew begins the room anew; this page still knows the light. An
     * offer that was not taken up stands: the state in between is that of the new room.
     */
    offer(forgotten: Lighting): void {
        this.offered ??= this.taken(forgotten);
        this.showOffer("The server has begun this room anew", []);
    }

    /** Someone else in the room may have brought it back. */
    roomChanged(state: RoomState): void {
        const { offered } = this;
        if (offered === null || this.busy) return;
        const isThere = (Object.keys(offered) as (keyof RoomState)[]).every((key) =>
            sameJson(state[key] as unknown as Json, offered[key] as unknown as Json),
        );
        if (isThere) this.succeed();
    }

    /** Someone has uploaded a map: it may be the one that was missing. */
    mapArrived(name: string): void {
        if (this.offered !== null && mapsOf(this.offered).includes(name)) void this.bringBack();
    }

    /** Returns whether all of it is in the room. What is not is said in a notice. */
    async bring(whole: Lighting): Promise<boolean> {
        const lighting = this.taken(whole);
        const { missing, problems } = await this.provideMaps(mapsOf(lighting));
        const { state } = this.connection;
        if (state === null) return this.fail(kLostWords, []);
        this.connection.edit(patchToLighting(state, withoutMaps(lighting, missing)));
        const refusal = await this.connection.settled();
        if (refusal === "lost") return this.fail(kLostWords, []);
        if (refusal !== null) {
            this.notices.show({
                tone: "error",
                title: `The light was refused: ${titleOf(refusal)}`,
                found: refusal.found,
                expected: refusal.expected,
            });
            return false;
        }
        if (missing.length === 0) return true;
        const maps = missing.map((name) => `“${name}”`).join(" and ");
        return this.fail(
            `All but the map ${maps} is back. Drop the file on the page once more and it is used`,
            problems,
        );
    }

    /** What the scene takes edits of. */
    private taken(lighting: Lighting): Lighting {
        const sections = Object.keys(lighting) as (keyof RoomState)[];
        const kept = sections.filter((key) => this.connection.takes(key));
        return Object.fromEntries(kept.map((key) => [key, lighting[key]])) as Lighting;
    }

    /** Uploads what the server lacks and this browser has. */
    private async provideMaps(
        names: string[],
    ): Promise<{ missing: string[]; problems: string[] }> {
        const missing: string[] = [];
        const problems: string[] = [];
        let has: Set<string>;
        try {
            has = new Set((await this.api.environments()).map((entry) => entry.name));
        } catch (error) {
            if (!(error instanceof ApiError)) throw error;
            return { missing: names, problems: [error.message] };
        }
        for (const name of names.filter((wanted) => !has.has(wanted))) {
            const kept = await this.uploads.find(name);
            if (kept === null) {
                missing.push(name);
                problems.push(`This browser has no copy of “${name}”: it did not upload it.`);
                continue;
            }
            try {
                await this.api.upload(name, kept.file, kept.projection);
                this.notices.show({
                    tone: "info",
                    title: `“${name}” was uploaded again from this browser's copy`,
                });
            } catch (error) {
                if (!(error instanceof ApiError)) throw error;
                missing.push(name);
                problems.push(`“${name}” could not be uploaded again: ${error.message}.`);
            }
        }
        if (names.some((name) => !has.has(name) && !missing.includes(name)))
            await this.mapsChanged();
        return { missing, problems };
    }

    private async bringBack(): Promise<void> {
        if (this.offered === null || this.busy) return;
        this.busy = true;
        try {
            if (await this.bring(this.offered)) this.succeed();
        } finally {
            this.busy = false;
        }
    }

    private succeed(): void {
        this.endOffer();
        this.notices.show({ tone: "info", title: "The light is back as it was" });
    }

    private fail(title: string, details: string[]): false {
        if (this.offered !== null) this.showOffer(title, details);
        else this.notices.show({ tone: "warning", title, details });
        return false;
    }

    private showOffer(title: string, details: string[]): void {
        this.takeOfferAway?.();
        this.takeOfferAway = this.notices.show({
            tone: "warning",
            title,
            details,
            actions: [
                {
                    words: "Bring back the light as it was",
                    keeps: true,
                    run: () => void this.bringBack(),
                },
                { words: "Let it go", run: () => this.endOffer() },
            ],
        });
    }

    private endOffer(): void {
        this.offered = null;
        this.takeOfferAway?.();
        this.takeOfferAway = null;
    }
}
