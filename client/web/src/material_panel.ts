/** The scene's materials: which one is edited, its curve, and all that moves it. */
import { CurveEditor } from "./curve_editor";
import { make, setText } from "./dom";
import { EditActions } from "./edit_actions";
import { MaterialControls } from "./material_controls";
import { MaterialSphere } from "./material_sphere";
import type { Materials } from "./materials";
import { onceAFrame } from "./once_a_frame";
import type { RoomConnection } from "./room_connection";
import type { EditableMaterial } from "./wire/message";
import type { MaterialEdit } from "./wire/state";

/** Whether people edit materials in the connection's scene. */
export function editsMaterials(connection: RoomConnection): boolean {
    const scene = connection.snapshot?.scene;
    return scene?.edits?.includes("materials") === true && (scene.materials ?? []).length > 0;
}

const kRemarkOfFrozenLight =
    "Light, view and interreflection stay as they were baked: an edited material is not seen " +
    "in the light that it throws on others.";
const kRemarkOfLight =
    "Light that reaches a material by way of other surfaces meets it as it was baked, and an " +
    "edited material is not seen in the light that it throws on others.";

/** The curve is named where a material has several that people edit. */
export function titleOf(
    { name, curve }: EditableMaterial,
    all: readonly EditableMaterial[],
): string {
    const isOneOfSeveral = all.filter((other) => other.name === name).length > 1;
    return isOneOfSeveral ? `${name}: ${curve.replace("_", " ")}` : name;
}

const kMeasuredRemark =
    "None is shipped. A file in the layout of the MERL database becomes the curves of a material " +
    "when the scene is baked: ";
const kMeasuredOption = "relume-bake SCENE --edit MATERIAL --measured MATERIAL=FILE.binary";

export class MaterialPanel {
    readonly editor: CurveEditor;
    private readonly list = make("ul", "material-list", { "aria-label": "Materials" });
    private readonly presets = make("div", "material-presets", {
        role: "group",
        "aria-label": "Presets",
    });
    private readonly title = make("h3", "curve-title");
    private readonly remark = make("p", "material-remark");
    private readonly sphere = new MaterialSphere();
    private readonly actions: EditActions<MaterialEdit>;
    private readonly showSoon = onceAFrame(() => this.show());
    private drawn = "";

    constructor(
        root: HTMLElement,
        private readonly connection: RoomConnection,
        private readonly materials: Materials,
    ) {
        const { history } = materials;
        this.actions = new EditActions(history, "Take the edits of this material back", () =>
            materials.reset(),
        );
        const curve = make("div", "curve-editor");
        const controls = make("div", "material-controls");
        root.append(
            make(
                "div",
                "card-head",
                {},
                make("h2", "", {}, "Materials"),
                this.actions.element,
            ),
            make("div", "material-choice", {}, this.list, this.sphere.element),
            this.title,
            curve,
            this.presets,
            controls,
            this.remark,
            make(
                "details",
                "material-remark",
                {},
                make("summary", "", {}, "Measured materials"),
                kMeasuredRemark,
                make("code", "", {}, kMeasuredOption),
            ),
        );
        this.editor = new CurveEditor(curve, connection, materials);
        new MaterialControls(controls, connection, materials);
        connection.stateChanged.listen(() => this.showSoon());
        connection.statusChanged.listen(() => this.showSoon());
        materials.selectionChanged.listen(() => this.showSoon());
        history.changed.listen(() => this.showSoon());
    }

    private show(): void {
        const { selected, edit } = this.materials;
        if (selected === null || edit === null) return;
        const isOpen = this.connection.status.kind === "open";
        this.actions.show(isOpen, this.materials.isEdited(selected.id));
        setText(this.title, `${selected.name}: ${selected.curve.replace("_", " ")}`);
        setText(
            this.remark,
            this.connection.takes("environment") ? kRemarkOfLight : kRemarkOfFrozenLight,
        );
        this.drawLists();
        this.sphere.draw(selected, edit);
    }

    /** Rows stay under the pointer while somebody draws. */
    private drawLists(): void {
        const { all, selected } = this.materials;
        const key = JSON.stringify([
            all.map(({ id }) => [id, this.materials.isEdited(id)]),
            selected?.id,
            selected?.presets,
        ]);
        if (key === this.drawn) return;
        this.drawn = key;
        const hadFocus = this.list.contains(document.activeElement);
        this.list.replaceChildren(
            ...all.map((material) => {
                const { id } = material;
                const isEdited = this.materials.isEdited(id);
                const row = make(
                    "button",
                    "material-row",
                    {
                        type: "button",
                        "data-material": id,
                        "aria-pressed": String(id === selected?.id),
                    },
                    make("span", "material-name", {}, titleOf(material, all)),
                    make("span", "material-state", {}, isEdited ? "edited" : ""),
                );
                row.addEventListener("click", () => this.materials.select(id));
                return make("li", "", {}, row);
            }),
        );
        if (hadFocus && selected !== null) {
            this.list.querySelector<HTMLElement>('[aria-pressed="true"]')?.focus();
        }
        this.presets.replaceChildren(
            ...(selected?.presets ?? []).map((preset) => {
                const button = make(
                    "button",
                    "small-button",
                    { type: "button", "data-preset": preset },
                    preset,
                );
                button.addEventListener("click", () => this.materials.setPreset(preset));
                return button;
            }),
        );
    }
}
