/** Which names someone may have meant. */

/** Insertions, deletions, replacements and swaps of neighbours between the two [Damerau64]. */
export function editDistance(a: string, b: string): number {
    const rows: number[][] = [Array.from({ length: b.length + 1 }, (_, j) => j)];
    for (let i = 1; i <= a.length; ++i) {
        const row = [i];
        for (let j = 1; j <= b.length; ++j) {
            const replaced = rows[i - 1]![j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1);
            let least = Math.min(replaced, rows[i - 1]![j]! + 1, row[j - 1]! + 1);
            const isSwap = i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1];
            if (isSwap) least = Math.min(least, rows[i - 2]![j - 2]! + 1);
            row.push(least);
        }
        rows.push(row);
    }
    return rows[a.length]![b.length]!;
}

/** Those of `names` that are near `name`, nearest first: few slips away, or one in the other. */
export function nearNames(name: string, names: string[]): string[] {
    const wanted = name.toLowerCase();
    const most = Math.max(1, Math.floor(wanted.length / 3));
    return names
        .map((candidate) => {
            const other = candidate.toLowerCase();
            const isPart = other.includes(wanted) || wanted.includes(other);
            const distance = editDistance(wanted, other);
            return { candidate, distance: isPart ? Math.min(distance, most) : distance };
        })
        .filter(({ distance }) => distance <= most)
        .sort((a, b) => a.distance - b.distance)
        .map(({ candidate }) => candidate);
}
