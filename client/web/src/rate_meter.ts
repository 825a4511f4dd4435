/** Events and their amounts per second over a sliding window. */
const kWindowMilliseconds = 1000;

export class RateMeter {
    private readonly events: { at: number; amount: number }[] = [];

    add(now: number, amount: number): void {
        this.events.push({ at: now, amount });
        this.trim(now);
    }

    /** Of the last second before `now`. */
    read(now: number): { count: number; amount: number } {
        this.trim(now);
        const amount = this.events.reduce((sum, event) => sum + event.amount, 0);
        return { count: this.events.length, amount };
    }

    private trim(now: number): void {
        while (this.events.length > 0 && this.events[0]!.at <= now - kWindowMilliseconds) {
            this.events.shift();
        }
    }
}
