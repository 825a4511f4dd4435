/** What a WebSocket close code of the server means, and whether trying again can help. */

export type Retry = "soon" | "later" | "never";

export interface CloseMeaning {
    words: string;
    retry: Retry;
}

const kMeanings = new Map<number, CloseMeaning>([
    [1000, { words: "The server closed the connection", retry: "soon" }],
    [1001, { words: "The server is shutting down", retry: "soon" }],
    [1003, { words: "The server refused a binary message from this page", retry: "never" }],
    [1006, { words: "Connection lost", retry: "soon" }],
    [1009, { words: "A message was longer than the server allows", retry: "soon" }],
    [4001, { words: "The access token is not valid", retry: "never" }],
    [4002, { words: "Too many messages per second", retry: "soon" }],
    [4003, { words: "The room is full", retry: "later" }],
    [4004, { words: "The scene is unknown, or the room shows another one", retry: "never" }],
    [4005, { words: "Too many refused edits", retry: "soon" }],
    [4006, { words: "This page did not keep up with the images", retry: "soon" }],
    [4007, { words: "The server has no room left for another room", retry: "later" }],
]);

export function closeMeaning(code: number): CloseMeaning {
    return kMeanings.get(code) ?? { words: `Connection closed (code ${code})`, retry: "soon" };
}
