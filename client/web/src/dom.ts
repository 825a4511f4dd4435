/** Small helpers around the document. */

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
    const element = document.getElementById(id);
    if (element === null) throw new Error(`the page has no element #${id}`);
    return element as T;
}

type Attributes = { [name: string]: string | undefined };

/** An element with class, attributes and children. */
export function make<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    className: string,
    attributes: Attributes = {},
    ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    if (className !== "") element.className = className;
    for (const [name, value] of Object.entries(attributes)) {
        if (value !== undefined) element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
}

/** An icon of the page's sprite (index.html). */
export function icon(name: string): SVGSVGElement {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("class", "icon");
    svg.setAttribute("aria-hidden", "true");
    const use = document.createElementNS("http://www.w3.org/2000/svg", "use");
    use.setAttribute("href", `#icon-${name}`);
    svg.append(use);
    return svg;
}

export function setText(element: Element, text: string): void {
    if (element.textContent !== text) element.textContent = text;
}

/** Whether a key press belongs to a field being typed in. */
export function isTyping(target: EventTarget | null): boolean {
    return (
        target instanceof HTMLElement &&
        (target.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(target.tagName))
    );
}
