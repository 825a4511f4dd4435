/** Says in the header that lights are solo, and ends it: the rest of the light is dark then. */
import { type AreaLights, nameOfLight, soloLights } from "./area_lights";
import { byId, setText } from "./dom";
import type { RoomConnection } from "./room_connection";

export class SoloSign {
    private readonly button = byId<HTMLButtonElement>("solo-sign");

    constructor(connection: RoomConnection, lights: AreaLights) {
        this.button.addEventListener("click", () => lights.endSolo());
        connection.stateChanged.listen((state) => {
            const names = soloLights(state).map(([id, light]) => nameOfLight(id, light));
            this.button.hidden = names.length === 0;
            setText(this.button, `Solo: ${names.join(", ")}`);
            this.button.title = `Only ${names.join(", ")} can light. Click to end solo.`;
        });
    }
}
