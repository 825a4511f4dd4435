/** JSON Merge Patch [RFC 7396]: applying one, and putting two into one. */
import type { Json, JsonObject } from "./state";

export function isObject(value: Json | undefined): value is JsonObject {
    return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** A JSON object may carry a key "__proto__", which plain assignment would not store. */
function put(object: JsonObject, key: string, value: Json): void {
    Object.defineProperty(object, key, {
        value,
        enumerable: true,
        configurable: true,
        writable: true,
    });
}

/** Returns `target` with `patch` applied; neither argument is changed. */
export function applyPatch(target: Json | undefined, patch: Json): Json {
    if (!isObject(patch)) return patch;
    const result: JsonObject = {};
    if (isObject(target)) {
        for (const [key, value] of Object.entries(target)) put(result, key, value);
    }
    for (const [key, change] of Object.entries(patch)) {
        if (change === null) {
            delete result[key];
        } else {
            const before = Object.hasOwn(result, key) ? result[key] : undefined;
            put(result, key, applyPatch(before, change));
        }
    }
    return result;
}

/**
 * One patch that does what `first` and then `second` do. A removal followed by an object under
 * the same key cannot be said in one merge patch; what comes out then merges into the old value.
 */
export function composePatches(first: JsonObject, second: JsonObject): JsonObject {
    const result: JsonObject = {};
    for (const [key, value] of Object.entries(first)) put(result, key, value);
    for (const [key, change] of Object.entries(second)) {
        const before = Object.hasOwn(result, key) ? result[key] : undefined;
        put(
            result,
            key,
            isObject(change) && isObject(before) ? composePatches(before, change) : change,
        );
    }
    return result;
}
