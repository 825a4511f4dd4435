/** tweakpane draws its labels beside the controls without tying the two together. */

/** Gives every field under `root` the name that stands beside it. */
export function labelFields(root: HTMLElement): void {
    for (const row of root.querySelectorAll(".tp-lblv")) {
        const label = row.querySelector(".tp-lblv_l")?.textContent?.trim() ?? "";
        if (label === "") continue;
        for (const field of row.querySelectorAll("input, select, .tp-colswv_b")) {
            field.setAttribute("aria-label", label);
        }
    }
    // A slider's text field takes arrow keys as well: one stop for the keyboard is enough.
    for (const slider of root.querySelectorAll(".tp-sldv_t")) {
        slider.setAttribute("aria-hidden", "true");
        slider.setAttribute("tabindex", "-1");
    }
}
