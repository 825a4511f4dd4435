/** Makes a function that may be called at any rate and runs `work` once in the next frame. */
export function onceAFrame(work: () => void): () => void {
    let isDue = false;
    return () => {
        if (isDue) return;
        isDue = true;
        requestAnimationFrame(() => {
            isDue = false;
            work();
        });
    };
}
