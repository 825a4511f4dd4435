/** Parts of the scene and the materials that they are given. */
import { make, setText } from "./dom";
import { EditActions } from "./edit_actions";
import { FinishControls } from "./finish_controls";
import type { Finishes } from "./finishes";
import { onceAFrame } from "./once_a_frame";
import type { RoomConnection } from "./room_connection";
import type { ScenePart } from "./wire/message";
import type { Finish } from "./wire/state";

const kRemark =
    "A part that is given a material shows the light that reaches it straight, without textures " +
    "and without light by way of other surfaces. What it throws on others stays as it was baked.";
const kNothingOffered =
    "The server offers no materials for this scene. They are made for its resolution and put " +
    "into the folder that it was started with: ";

/** The ID, where the file has no name for the material or one name for several. */
export function titleOf({ id, name }: ScenePart, all: readonly ScenePart[]): string {
    return name === "" || all.filter((other) => other.name === name).length > 1 ? id : name;
}

export class FinishPanel {
    private readonly list = make("ul", "material-list", { "aria-label": "Parts" });
    private readonly actions: EditActions<Finish>;
    private readonly controls = make("div", "material-controls");
    private readonly remark = make("p", "material-remark", {}, kRemark);
    private readonly howTo = make("code", "");
    private readonly nothing = make("p", "material-remark", {}, kNothingOffered, this.howTo);
    private readonly showSoon = onceAFrame(() => this.show());
    private drawn = "";

    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
        private readonly finishes: Finishes,
    ) {
        const { history } = finishes;
        this.actions = new EditActions(history, "Take the finish of this part away", () =>
            finishes.give(null),
        );
        root.append(
            make(
                "div",
                "card-head",
                {},
                make("h2", "", {}, "Finishes"),
                this.actions.element,
            ),
            this.list,
            this.controls,
            this.nothing,
            this.remark,
        );
        new FinishControls(this.controls, connection, finishes);
        connection.stateChanged.listen(() => this.showSoon());
        connection.statusChanged.listen(() => this.showSoon());
        finishes.selectionChanged.listen(() => this.showSoon());
        finishes.offerChanged.listen(() => this.showSoon());
        history.changed.listen(() => this.showSoon());
    }

    private show(): void {
        const { selected, finish, offered } = this.finishes;
        if (selected === null) return;
        this.actions.show(this.connection.status.kind === "open", finish !== null);
        const offersSome = offered.length > 0 || finish !== null;
        this.controls.hidden = !offersSome;
        this.remark.hidden = !offersSome;
        this.nothing.hidden = offersSome;
        const n = this.connection.snapshot?.scene.visibility_resolution ?? 64;
        setText(this.howTo, `relume-bake material white --model lambert -n ${n}`);
        this.drawList();
    }

    /** Rows stay under the pointer while somebody drags. */
    private drawList(): void {
        const { parts, selected } = this.finishes;
        const materialOf = (id: string): string => this.finishes.finishOf(id)?.material ?? "";
        const key = JSON.stringify([parts.map(({ id }) => [id, materialOf(id)]), selected?.id]);
        if (key === this.drawn) return;
        this.drawn = key;
        const hadFocus = this.list.contains(document.activeElement);
        this.list.replaceChildren(
            ...parts.map((part) => {
                const { id } = part;
                const row = make(
                    "button",
                    "material-row",
                    {
                        type: "button",
                        "data-part": id,
                        "aria-pressed": String(id === selected?.id),
                    },
                    make("span", "material-name", {}, titleOf(part, parts)),
                    make("span", "material-state", {}, materialOf(id)),
                );
                row.addEventListener("click", () => this.finishes.select(id));
                return make("li", "", {}, row);
            }),
        );
        if (hadFocus) this.list.querySelector<HTMLElement>('[aria-pressed="true"]')?.focus();
    }
}
