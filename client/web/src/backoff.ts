/** Waiting times between attempts: exponential with full jitter above half, so that the pages of
 *  a restarted server do not come back all at once. */

const kFirstMilliseconds = 300;
const kLongestMilliseconds = 10_000;
const kLaterMilliseconds = 15_000;

export class Backoff {
    private failures = 0;

    constructor(private readonly random: () => number = Math.random) {}

    /** Milliseconds to wait before the next attempt; each call counts one more failure. */
    next(): number {
        const ceiling = Math.min(kLongestMilliseconds, kFirstMilliseconds * 2 ** this.failures);
        this.failures = Math.min(this.failures + 1, 16);
        return ceiling * (0.5 + 0.5 * this.random());
    }

    /** For refusals that only time can cure, such as a full room. */
    later(): number {
        return kLaterMilliseconds * (1 + 0.3 * this.random());
    }

    reset(): void {
        this.failures = 0;
    }
}
