/**
 * Exposure and tone curve are each viewer's own; the room has a default, which a viewer sees who
 * has chosen none. On a settled image they act here at once, and the server hears of the choice
 * when the hand rests or before an edit leaves; while JPEGs show, which come developed, it hears
 * at once.
 */
import { sameDisplay } from "./display";
import type { ImageView } from "./image_view";
import type { RoomConnection } from "./room_connection";
import { Signal } from "./signal";
import { clampTo } from "./wire/range";
import { type DisplayState, kRanges } from "./wire/state";

const kRestMilliseconds = 180;

export class Exposure {
    readonly changed = new Signal<DisplayState>();
    private mine: DisplayState | null = null;
    /** Of a choice that the server has not heard of; 0 where there is none. */
    private timer = 0;

    constructor(
        private readonly connection: RoomConnection,
        private readonly view: ImageView,
    ) {
        connection.stateChanged.listen(() => this.publish());
        // A new connection knows of no choice.
        connection.opened.listen(() => this.tell());
        connection.editSent.listen(() => {
            if (this.timer !== 0) this.tell();
        });
    }

    get display(): DisplayState {
        return this.mine ?? this.roomDisplay;
    }

    get roomDisplay(): DisplayState {
        return this.connection.state?.display ?? { exposure_stops: 0, tone: "filmic" as const };
    }

    /** This viewer sees something else than the room's default. */
    get differs(): boolean {
        return !sameDisplay(this.display, this.roomDisplay);
    }

    /** For this viewer alone. */
    set(change: Partial<DisplayState>): void {
        const display = { ...this.display, ...change };
        display.exposure_stops = clampTo(
            kRanges.display.exposure_stops,
            display.exposure_stops,
        );
        this.choose(display);
    }

    step(stops: number): void {
        this.set({
            exposure_stops: Math.round((this.display.exposure_stops + stops) * 1000) / 1000,
        });
    }

    /** What this viewer sees becomes what everyone sees who has chosen nothing else. */
    makeDefault(): void {
        const { exposure_stops, tone } = this.display;
        this.connection.edit({ display: { exposure_stops, tone } });
        this.followRoom();
    }

    /** Gives up what this viewer has chosen. */
    followRoom(): void {
        this.choose(null);
    }

    private choose(display: DisplayState | null): void {
        this.mine = display;
        clearTimeout(this.timer);
        if (this.view.settled === null) this.tell();
        else this.timer = window.setTimeout(() => this.tell(), kRestMilliseconds);
        this.publish();
    }

    private tell(): void {
        clearTimeout(this.timer);
        this.timer = 0;
        this.connection.chooseDisplay(this.mine);
    }

    private publish(): void {
        this.view.setDisplay(this.display);
        this.changed.send(this.display);
    }
}
