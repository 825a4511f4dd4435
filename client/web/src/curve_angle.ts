/** The angles over which curves run, as people read them [protocol/curves.md §1]. */

const kRightAngleDegrees = 90;

/** Where u is √(θ/90°), so that narrow highlights get most of the axis. */
const kRootAngles = new Set(["half", "reflection", "along_u", "along_v"]);

const kAngleWords: { [angle: string]: string } = {
    half: "half angle",
    difference: "difference angle",
    incidence: "angle of the light",
    viewing: "angle of the viewer",
    reflection: "angle from the mirror's direction",
    along_u: "half angle along u",
    along_v: "half angle along v",
};

export function degreesFromU(angle: string, u: number): number {
    return kRightAngleDegrees * (kRootAngles.has(angle) ? u * u : u);
}

export function uFromDegrees(angle: string, degrees: number): number {
    const part = degrees / kRightAngleDegrees;
    return kRootAngles.has(angle) ? Math.sqrt(part) : part;
}

/** Degrees that an axis is marked at, from 0 to 90. */
export function degreeTicks(angle: string): number[] {
    return kRootAngles.has(angle) ? [0, 1, 5, 10, 20, 30, 45, 60, 90] : [0, 15, 30, 45, 60, 75, 90];
}

export function wordsOfAngle(angle: string): string {
    return kAngleWords[angle] ?? angle;
}
