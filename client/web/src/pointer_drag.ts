/** Dragging with mouse, pen or finger: movement in CSS pixels, captured until release. */

export interface DragMove {
    dx: number;
    dy: number;
    event: PointerEvent;
}

export interface DragHandlers {
    /** Return false to leave the pointer alone. */
    start?: (event: PointerEvent) => boolean;
    move: (move: DragMove) => void;
    end?: () => void;
}

export function listenForDrag(target: HTMLElement | SVGElement, handlers: DragHandlers): void {
    const element = target as HTMLElement; // the two share no typed addEventListener
    let pointer: number | null = null;
    let x = 0;
    let y = 0;
    element.addEventListener("pointerdown", (event: PointerEvent) => {
        if (pointer !== null || event.button !== 0) return;
        if (handlers.start !== undefined && !handlers.start(event)) return;
        pointer = event.pointerId;
        x = event.clientX;
        y = event.clientY;
        element.setPointerCapture(event.pointerId);
        element.classList.add("dragging");
    });
    element.addEventListener("pointermove", (event: PointerEvent) => {
        if (event.pointerId !== pointer) return;
        handlers.move({ dx: event.clientX - x, dy: event.clientY - y, event });
        x = event.clientX;
        y = event.clientY;
    });
    const end = (event: PointerEvent): void => {
        if (event.pointerId !== pointer) return;
        pointer = null;
        element.classList.remove("dragging");
        handlers.end?.();
    };
    element.addEventListener("pointerup", end);
    element.addEventListener("pointercancel", end);
}
