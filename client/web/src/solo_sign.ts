/** Says in the header that lights are solo, and ends it: the rest of the light is dark meanwhile. */
import { type AreaLights, nameOfLight, soloLights } from "./area_lights";
import { byId, setText } from "./dom";
import type { Session } from "./session";

export class SoloSign {
    private readonly button = byId<HTMLButtonElement>("solo-sign");

    constructor(session: Session, lights: AreaLights) {
        this.button.addEventListener("click", () => lights.endSolo());
        session.stateChanged.listen((state) => {
            const names = soloLights(state).map(([id, light]) => nameOfLight(id, light));
            this.button.hidden = names.length === 0;
            setText(this.button, `Solo: ${names.join(", ")}`);
            this.button.title = `Only ${names.join(", ")} can light. Click to end solo.`;
        });
    }
}
