/**
 * The maps that this browser has uploaded, kept in IndexedDB so that they can be uploaded again
 * to a server that was started anew. Bounded in number and bytes: the oldest go first. Where the
 * browser offers no such store nothing is kept, and nothing else is different.
 */

export interface KeptUpload {
    name: string;
    file: Blob;
    /** The projection that was asked for, where one was. */
    projection: string | null;
}

interface StoredUpload extends KeptUpload {
    key: string;
    keptAt: number;
}

const kDatabase = "relume";
const kStore = "uploads";
export const kMostKeptFiles = 8;
export const kMostKeptBytes = 256 * 1024 * 1024;

/** Which of `kept`, oldest first, have to go so that one of `bytes` more can come. */
export function keysToForget(
    kept: { key: string; keptAt: number; bytes: number }[],
    bytes: number,
): string[] {
    const oldestFirst = [...kept].sort((a, b) => a.keptAt - b.keptAt);
    let count = kept.length + 1;
    let total = kept.reduce((sum, entry) => sum + entry.bytes, bytes);
    const keys: string[] = [];
    for (const entry of oldestFirst) {
        if (count <= kMostKeptFiles && total <= kMostKeptBytes) break;
        keys.push(entry.key);
        count -= 1;
        total -= entry.bytes;
    }
    return keys;
}

export class UploadStore {
    /** Maps of one server are no maps of another. */
    constructor(private readonly server: string) {}

    async keep(upload: KeptUpload): Promise<void> {
        if (upload.file.size > kMostKeptBytes) return;
        await this.withStore("readwrite", async (store) => {
            const key = this.keyOf(upload.name);
            const others = (await answer<StoredUpload[]>(store.getAll())).filter(
                (entry) => entry.key !== key,
            );
            const sizes = others.map(({ key: other, keptAt, file }) => ({
                key: other,
                keptAt,
                bytes: file.size,
            }));
            for (const old of keysToForget(sizes, upload.file.size)) {
                await answer(store.delete(old));
            }
            const stored: StoredUpload = { ...upload, key, keptAt: Date.now() };
            await answer(store.put(stored));
        });
    }

    async find(name: string): Promise<KeptUpload | null> {
        const found = await this.withStore("readonly", (store) =>
            answer<StoredUpload | undefined>(store.get(this.keyOf(name))),
        );
        return found ?? null;
    }

    private keyOf(name: string): string {
        return `${this.server} ${name}`;
    }

    private async withStore<T>(
        mode: IDBTransactionMode,
        work: (store: IDBObjectStore) => Promise<T>,
    ): Promise<T | null> {
        let database: IDBDatabase | null = null;
        try {
            const opening = indexedDB.open(kDatabase, 1);
            opening.onupgradeneeded = () => {
                opening.result.createObjectStore(kStore, { keyPath: "key" });
            };
            database = await answer(opening);
            return await work(database.transaction(kStore, mode).objectStore(kStore));
        } catch (error) {
            // A full disk or a private window: there is a picture to show all the same.
            console.warn("This browser keeps no copies of uploads:", error);
            return null;
        } finally {
            database?.close();
        }
    }
}

function answer<T>(request: IDBRequest<T>): Promise<T> {
    return new Promise((resolve, reject) => {
        request.onsuccess = () => resolve(request.result);
        request.onerror = () => reject(request.error ?? new Error("no answer from IndexedDB"));
    });
}
