/** The buttons over a list of what is edited: undo, redo, and back to the bake. */
import { make } from "./dom";
import type { EditHistory } from "./edit_history";

export class EditActions<Entry> {
    readonly element: HTMLElement;
    private readonly undo: HTMLButtonElement;
    private readonly redo: HTMLButtonElement;
    private readonly reset: HTMLButtonElement;

    /** `resetWords` say what going back to the bake takes away. */
    constructor(
        private readonly history: EditHistory<Entry>,
        resetWords: string,
        reset: () => void,
    ) {
        const action = (title: string, words: string, act: () => void): HTMLButtonElement => {
            const button = make("button", "small-button", { type: "button", title: words }, title);
            button.addEventListener("click", act);
            return button;
        };
        this.undo = action("Undo", "Undo the last edit (Ctrl Z)", () => history.undo());
        this.redo = action("Redo", "Redo (Ctrl Shift Z)", () => history.redo());
        this.reset = action("As baked", resetWords, reset);
        this.element = make("div", "material-actions", {}, this.undo, this.redo, this.reset);
    }

    show(isOpen: boolean, isEdited: boolean): void {
        this.undo.disabled = !isOpen || !this.history.canUndo;
        this.redo.disabled = !isOpen || !this.history.canRedo;
        this.reset.disabled = !isOpen || !isEdited;
    }
}
