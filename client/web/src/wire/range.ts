import type { Range } from "./state";

/** The value in the range that is next to `value`. */
export function clampTo({ lowest, highest }: Range, value: number): number {
    return Math.min(highest, Math.max(lowest, value));
}
