/**
 * Exposure and tone curve are each viewer's own; the room has a default, which a viewer sees who
 * has chosen none. They act here at once: on linear light where the image is settled, else on the
 * JPEG that came with the room's display.
 */
import { clampExposure, sameDisplay } from "./display";
import type { ImageView } from "./image_view";
import type { Session } from "./session";
import { Signal } from "./signal";
import type { DisplayState } from "./wire/state";

export class Exposure {
    readonly changed = new Signal<DisplayState>();
    private mine: DisplayState | null = null;

    constructor(
        private readonly session: Session,
        private readonly view: ImageView,
    ) {
        session.stateChanged.listen(() => this.publish());
    }

    get display(): DisplayState {
        return this.mine ?? this.roomDisplay;
    }

    get roomDisplay(): DisplayState {
        return this.session.state?.display ?? { exposure_stops: 0, tone: "filmic" as const };
    }

    /** This viewer sees something else than the room's default. */
    get differs(): boolean {
        return !sameDisplay(this.display, this.roomDisplay);
    }

    /** For this viewer alone. */
    set(change: Partial<DisplayState>): void {
        const display = { ...this.display, ...change };
        display.exposure_stops = clampExposure(display.exposure_stops);
        this.mine = display;
        this.publish();
    }

    step(stops: number): void {
        this.set({
            exposure_stops: Math.round((this.display.exposure_stops + stops) * 1000) / 1000,
        });
    }

    /** What this viewer sees becomes what everyone sees who has chosen nothing else. */
    makeDefault(): void {
        const { exposure_stops, tone } = this.display;
        this.session.edit({ display: { exposure_stops, tone } });
        this.followRoom();
    }

    /** Gives up what this viewer has chosen. */
    followRoom(): void {
        this.mine = null;
        this.publish();
    }

    private publish(): void {
        this.view.setDisplay(this.display, this.roomDisplay);
        this.changed.send(this.display);
    }
}
