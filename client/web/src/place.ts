/** Where this page is: server, scene, room and token, from the address of the page. */

const kNamePattern = /^(?!\.)[A-Za-z0-9._-]{1,64}$/;

export interface Place {
    /** Origin of the server, without a slash at the end. */
    server: string;
    scene: string | null;
    room: string | null;
    token: string | null;
    /** False where the address asks for the way without WebGL2. */
    mayUseGl: boolean;
}

export class PlaceError extends Error {
    override readonly name = "PlaceError";
}

export function isName(text: string): boolean {
    return kNamePattern.test(text);
}

/** The name nearest to `text` that the server takes; empty where nothing is left of it. */
export function nameFromText(text: string): string {
    return text
        .normalize("NFKD")
        .replace(/[\u0300-\u036f]/g, "")
        .replace(/[^A-Za-z0-9._-]+/g, "-")
        .replace(/^[-.]+|[-.]+$/g, "")
        .slice(0, 64);
}

/**
 * Reads `?server=&scene=&room=&token=&painter=`, and `#token=`, which no server gets to see in an
 * address; throws PlaceError naming the parameter that is wrong.
 */
export function placeFromAddress(address: URL): Place {
    const named = (key: string): string | null => {
        const value = address.searchParams.get(key);
        if (value === null || value === "") return null;
        if (!isName(value)) {
            throw new PlaceError(
                `${key} is "${value}", expected 1 to 64 of A-Z a-z 0-9 . _ - and no dot first`,
            );
        }
        return value;
    };
    let server = address.origin;
    const given = address.searchParams.get("server");
    if (given !== null && given !== "") {
        let url: URL;
        try {
            url = new URL(given.includes("://") ? given : `${address.protocol}//${given}`);
        } catch {
            throw new PlaceError(`server is "${given}", expected an address such as host:port`);
        }
        if (url.protocol !== "http:" && url.protocol !== "https:") {
            throw new PlaceError(`server is "${given}", expected http or https`);
        }
        server = url.origin;
    }
    return {
        server,
        scene: named("scene"),
        room: named("room"),
        token:
            new URLSearchParams(address.hash.slice(1)).get("token") ??
            address.searchParams.get("token"),
        mayUseGl: address.searchParams.get("painter") !== "canvas2d",
    };
}

export function defaultRoom(scene: string): string {
    return `studio-${scene}`.slice(0, 64);
}

export function connectionAddress(place: Place, scene: string, room: string): string {
    const url = new URL(`/session/${room}`, place.server);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.searchParams.set("scene", scene);
    return url.href;
}

/** What the page offers a server: the protocol's version, and the token, if it has one. */
export function subprotocols(place: Place): string[] {
    if (place.token === null) return ["relume.v1"];
    const bytes = String.fromCharCode(...new TextEncoder().encode(place.token));
    const base64url = btoa(bytes).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
    return ["relume.v1", `relume.token.${base64url}`];
}

/** The address of this page showing another scene, in that scene's default room. */
export function addressOfScene(address: URL, scene: string): string {
    const url = new URL(address);
    url.searchParams.set("scene", scene);
    url.searchParams.delete("room");
    return url.href;
}
