/** The server's HTTP side [protocol/README.md §3]. */
import { isObject } from "./wire/merge_patch";
import { refusalFromJson, type SceneSummary, titleOf } from "./wire/message";
import type { Json, JsonObject, Triple } from "./wire/state";

export interface SceneEntry extends SceneSummary {
    bytes: number;
}

export interface EnvironmentEntry {
    name: string;
    kind: "file" | "procedural" | "upload";
    width: number;
    height: number;
    /** Another number for another map of the same name. */
    version?: number;
}

/** What parts of scenes can be given: one material, or a family that differs in one number. */
export interface OfferedMaterial {
    name: string;
    face_resolution: number;
    /** Of its lobes. */
    colours: Triple[];
    /** Of a family: what its number is. */
    parameter?: "exponent" | "roughness";
    /** Of a family: the numbers that it has tables of, ascending. */
    steps?: number[];
}

export interface UploadResult {
    name: string;
    width: number;
    height: number;
    projection: string;
    warnings: string[];
}

/** A refusal by the server, or a server that cannot be reached, in words for people. */
export class ApiError extends Error {
    override readonly name = "ApiError";

    constructor(
        message: string,
        readonly found?: string,
        readonly expected?: string,
    ) {
        super(message);
    }
}

export class Api {
    constructor(
        private readonly server: string,
        private readonly token: string | null,
    ) {}

    async scenes(): Promise<SceneEntry[]> {
        const json = await this.request("/api/scenes");
        return json["scenes"] as unknown as SceneEntry[];
    }

    async environments(): Promise<EnvironmentEntry[]> {
        const json = await this.request("/api/environments");
        return json["environments"] as unknown as EnvironmentEntry[];
    }

    async materials(): Promise<OfferedMaterial[]> {
        const json = await this.request("/api/materials");
        return json["materials"] as unknown as OfferedMaterial[];
    }

    thumbnailAddress(scene: string): string {
        return `${this.server}/api/scenes/${encodeURIComponent(scene)}/thumbnail.png`;
    }

    /** A grey value a pixel: 0, or one more than the place of its material in the summary. */
    async materialMap(scene: string): Promise<ImageBitmap> {
        const path = `/api/scenes/${encodeURIComponent(scene)}/materials.png`;
        const response = await fetch(this.server + path);
        if (!response.ok) throw new ApiError(`No map of the materials of ${scene}`);
        return createImageBitmap(await response.blob(), { colorSpaceConversion: "none" });
    }

    /** As it is now, whatever the browser has kept. */
    async preview(environment: string): Promise<ImageBitmap> {
        const path = `/api/environments/${encodeURIComponent(environment)}/preview.jpg`;
        const response = await fetch(this.server + path, { cache: "no-cache" });
        if (!response.ok) throw new ApiError(`No preview of ${environment}`);
        return createImageBitmap(await response.blob());
    }

    /** Without a projection the server goes by the picture's shape. */
    async upload(name: string, file: Blob, projection: string | null): Promise<UploadResult> {
        const query = new URLSearchParams({ name });
        if (projection !== null) query.set("projection", projection);
        const json = await this.request(`/api/environments?${query.toString()}`, {
            method: "POST",
            headers: {
                "Content-Type": "application/octet-stream",
                ...(this.token === null
                    ? {}
                    : { Authorization: `Bearer ${utf8Bytes(this.token)}` }),
            },
            body: file,
        });
        return json as unknown as UploadResult;
    }

    private async request(path: string, init?: RequestInit): Promise<JsonObject> {
        let response: Response;
        try {
            response = await fetch(this.server + path, init);
        } catch {
            throw new ApiError("The server cannot be reached");
        }
        const text = await response.text();
        let json: Json = null;
        try {
            json = JSON.parse(text) as Json;
        } catch {
            // An answer that is not JSON is told apart below, by its status.
        }
        if (response.ok && isObject(json)) return json;
        if (isObject(json) && isObject(json["error"])) {
            const refusal = refusalFromJson(json["error"]);
            throw new ApiError(titleOf(refusal), refusal.found, refusal.expected);
        }
        throw new ApiError(`The server answered ${response.status} ${response.statusText}`);
    }
}

/** The bytes of `text` as characters U+0000 … U+00FF: a header carries bytes. */
function utf8Bytes(text: string): string {
    const bytes = new TextEncoder().encode(text);
    return Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
}
