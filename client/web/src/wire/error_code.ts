/** The server's error codes in words for people. */

const kWords = new Map([
    ["malformed_json", "The message is not JSON"],
    ["unknown_type", "The message is of an unknown type"],
    ["unknown_field", "There is no such field"],
    ["wrong_type", "The value is of the wrong type"],
    ["out_of_range", "The value is out of range"],
    ["missing_field", "Something is missing"],
    ["unknown_name", "There is no such name"],
    ["too_many", "Too many at once"],
    ["too_large", "Too large"],
    ["unsupported", "Not supported here"],
    ["not_found", "Not found"],
    ["bad_image", "Not an image that can be used"],
    ["shutting_down", "The server is shutting down"],
]);

/** Null for `internal` and for codes of a newer server: its own message says more. */
export function errorWords(code: string): string | null {
    return kWords.get(code) ?? null;
}
