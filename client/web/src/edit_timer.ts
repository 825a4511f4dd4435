/** How long an edit of this page takes from its sending to the first image that holds it. */

interface Waiting {
    revision: number;
    sentAt: number;
}

const kSamples = 64;

export class EditTimer {
    private readonly sent = new Map<number, number>();
    private waiting: Waiting[] = [];
    private readonly samples: number[] = [];
    private shownRevision = -1;
    private shownAt = 0;

    editSent(id: number, now: number): void {
        this.sent.set(id, now);
    }

    editDropped(id: number): void {
        this.sent.delete(id);
    }

    /** Ids ascend: a confirmation stands for all earlier edits that were taken together with it. */
    editConfirmed(id: number, revision: number): void {
        for (const [sentId, sentAt] of this.sent) {
            if (sentId > id) continue;
            this.sent.delete(sentId);
            if (revision <= this.shownRevision) this.record(this.shownAt - sentAt);
            else this.waiting.push({ revision, sentAt });
        }
    }

    imageShown(revision: number, now: number): void {
        if (revision <= this.shownRevision) return;
        this.shownRevision = revision;
        this.shownAt = now;
        for (const edit of this.waiting) {
            if (edit.revision <= revision) this.record(now - edit.sentAt);
        }
        this.waiting = this.waiting.filter((edit) => edit.revision > revision);
    }

    /** Revisions of another connection do not compare with those before it. */
    clear(): void {
        this.sent.clear();
        this.waiting = [];
        this.shownRevision = -1;
    }

    get latestMilliseconds(): number | null {
        return this.samples[this.samples.length - 1] ?? null;
    }

    /** Median of the last 64 edits. */
    get medianMilliseconds(): number | null {
        const sorted = [...this.samples].sort((a, b) => a - b);
        return sorted[sorted.length >> 1] ?? null;
    }

    private record(milliseconds: number): void {
        this.samples.push(milliseconds);
        if (this.samples.length > kSamples) this.samples.shift();
    }
}
