/** States to test with. */
import type { RoomState } from "../src/wire/state";

/** The default state but for `change`. */
export function stateWith(change: Partial<RoomState> = {}): RoomState {
    return {
        environment: { name: "city", gain: 1, tint: [1, 1, 1] },
        blend: { amount: 0 },
        rotation: { quaternion: [1, 0, 0, 0] },
        lights: {},
        materials: {},
        finishes: {},
        background: { mode: "environment", colour: [0, 0, 0] },
        camera: { eye: [0, 0, 0], look_at: [0, 0, -1], up: [0, 1, 0], fov_degrees: 40 },
        image: { width: 512, height: 512 },
        strategy: { method: "guarded", priority: "benefit" },
        budget: { milliseconds: 8, target_error: 0 },
        display: { exposure_stops: 0, tone: "filmic" },
        ...change,
    };
}
