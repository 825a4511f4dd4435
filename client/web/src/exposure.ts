/**
 * Exposure and tone curve. On a settled image they act here at once and the room hears of it when
 * the hand rests; while JPEGs show, which come with the room's display applied, it hears at once.
 */
import { clampExposure } from "./display";
import type { ImageView } from "./image_view";
import type { Session } from "./session";
import { Signal } from "./signal";
import type { DisplayState } from "./wire/state";

const kRestMilliseconds = 180;

export class Exposure {
    readonly changed = new Signal<DisplayState>();
    private local: DisplayState | null = null;
    private timer = 0;

    constructor(
        private readonly session: Session,
        private readonly view: ImageView,
    ) {
        session.opened.listen(() => {
            clearTimeout(this.timer);
            this.local = null;
        });
        session.stateChanged.listen(() => this.publish());
    }

    get display(): DisplayState {
        return (
            this.local ??
            this.session.state?.display ?? { exposure_stops: 0, tone: "filmic" as const }
        );
    }

    /** The room has not heard yet of what shows here. */
    get isPending(): boolean {
        return this.local !== null;
    }

    set(change: Partial<DisplayState>): void {
        const display = { ...this.display, ...change };
        display.exposure_stops = clampExposure(display.exposure_stops);
        this.local = display;
        clearTimeout(this.timer);
        if (this.view.settled === null) this.tell();
        else this.timer = window.setTimeout(() => this.tell(), kRestMilliseconds);
        this.publish();
    }

    step(stops: number): void {
        this.set({
            exposure_stops: Math.round((this.display.exposure_stops + stops) * 1000) / 1000,
        });
    }

    private tell(): void {
        if (this.local === null || this.session.status.kind !== "open") return;
        const { exposure_stops, tone } = this.local;
        this.local = null;
        this.session.edit({ display: { exposure_stops, tone } });
    }

    private publish(): void {
        this.view.setDisplay(this.display);
        this.changed.send(this.display);
    }
}
