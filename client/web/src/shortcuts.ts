/** Keys and what they do; the help overlay is made from the same list. */
import { isTyping, make } from "./dom";

export interface Shortcut {
    /** As KeyboardEvent.key has them; all do the same. */
    keys: string[];
    /** With Ctrl or, on a Mac, Command. */
    withControl?: boolean;
    words: string;
    run: (event: KeyboardEvent) => void;
}

export interface Gesture {
    hand: string;
    words: string;
}

const kKeyWords = new Map([
    ["ArrowLeft", "←"],
    ["ArrowRight", "→"],
    ["ArrowUp", "↑"],
    ["ArrowDown", "↓"],
    ["Delete", "Del"],
]);

export function listenForShortcuts(shortcuts: Shortcut[]): void {
    window.addEventListener("keydown", (event) => {
        if (event.altKey || isTyping(event.target)) return;
        if (document.querySelector("dialog[open]") !== null) return;
        // Arrows inside a list or a panel move the focus there, not the light.
        const inPanel =
            event.target instanceof Element && event.target.closest(".panel") !== null;
        if (inPanel && event.key.startsWith("Arrow")) return;
        const isWithControl = event.ctrlKey || event.metaKey;
        const shortcut = shortcuts.find(
            ({ keys, withControl = false }) =>
                keys.includes(event.key) && withControl === isWithControl,
        );
        if (shortcut === undefined) return;
        event.preventDefault();
        shortcut.run(event);
    });
}

export function fillHelp(root: HTMLElement, gestures: Gesture[], shortcuts: Shortcut[]): void {
    const list = (title: string, rows: [Node[], string][]): HTMLElement =>
        make(
            "section",
            "help-section",
            {},
            make("h3", "", {}, title),
            make(
                "dl",
                "help-list",
                {},
                ...rows.flatMap(([term, words]) => [
                    make("dt", "", {}, ...term),
                    make("dd", "", {}, words),
                ]),
            ),
        );
    const key = (name: string, withControl = false): Node => {
        const words = /^[A-Z]$/.test(name) ? `Shift ${name}` : name.toUpperCase();
        const prefix = withControl ? "Ctrl " : "";
        return make("kbd", "", {}, prefix + (kKeyWords.get(name) ?? words));
    };
    root.replaceChildren(
        list(
            "Hand",
            gestures.map(({ hand, words }) => [[document.createTextNode(hand)], words]),
        ),
        list(
            "Keys",
            shortcuts.map(({ keys, withControl, words }) => [
                keys
                    .filter((name) => !/^[A-Z]$/.test(name) || keys.length === 1)
                    .map((name) => key(name, withControl)),
                words,
            ]),
        ),
    );
}
