/**
 * A pane of controls over the room's state: what a hand changes becomes an edit, and what
 * changes in the room shows with the next frame, without becoming an edit again.
 */
import { Pane } from "tweakpane";
import { onceAFrame } from "./once_a_frame";
import type { RoomConnection } from "./room_connection";
import type { JsonObject, RoomState } from "./wire/state";

export class StatePane {
    readonly pane: Pane;
    readonly showSoon: () => void;
    private isShowing = false;

    /** `show` puts the state into the model that the controls are bound to. */
    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
        show: (state: RoomState) => void,
    ) {
        this.pane = new Pane({ container: root });
        this.showSoon = onceAFrame(() => {
            const { state } = connection;
            if (state === null) return;
            show(state);
            this.isShowing = true;
            this.pane.refresh();
            this.isShowing = false;
        });
        connection.stateChanged.listen(() => this.showSoon());
    }

    /** Runs where a control has changed by a hand. */
    byHand(act: () => void): void {
        if (!this.isShowing) act();
    }

    edit(patch: JsonObject): void {
        this.byHand(() => this.connection.edit(patch));
    }
}
