# SPDX-License-Identifier: MIT
"""What a user has in sight in the sidebar."""

from __future__ import annotations

from types import ModuleType, SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

_SEEDED = {name: {"seed"} for name in ("Path", "Populate", "Trace")}
"""What an animator tries other numbers of: another walk along the path, another crowd."""


class Layout:
    """Notes what a panel draws: fields by their names, buttons by their operators."""

    def __init__(self, noted: dict[str, list[str]] | None = None) -> None:
        kinds = ("fields", "buttons", "button icons", "texts", "icons")
        self.__dict__["noted"] = {kind: [] for kind in kinds} if noted is None else noted

    def __setattr__(self, name: str, value: object) -> None:
        """Any layout's settings are welcome."""

    def _part(self, *_arguments: Any, **_options: Any) -> Layout:
        return Layout(self.noted)

    row = column = box = split = grid_flow = column_flow = menu_pie = _part

    def prop(self, _data: Any, name: str, **options: Any) -> None:
        if not name.startswith("show_") or options.get("emboss", True):
            self.noted["fields"].append(name)

    def prop_search(self, _data: Any, name: str, *_others: Any, **_options: Any) -> None:
        self.noted["fields"].append(name)

    def operator(self, name: str, icon: str = "NONE", **_options: Any) -> SimpleNamespace:
        self.noted["buttons"].append(name)
        self.noted["button icons"].append(icon)
        return SimpleNamespace()

    def label(self, text: str = "", icon: str = "NONE", **_options: Any) -> None:
        self.noted["texts"].append(text)
        self.noted["icons"].append(icon)

    def separator(self, factor: float = 1.0, **_options: Any) -> None:
        self.noted["icons"].append(f"{factor:g}")

    def template_list(self, *_arguments: Any, **_options: Any) -> None:
        """A list is no field."""

    progress = template_ID = template_icon = menu = template_list


def drawn(panel: Any) -> dict[str, list[str]]:
    """What the panel draws."""
    layout, context = Layout(), bpy.context.copy()
    preferences = SimpleNamespace(addons=bpy.context.preferences.addons, system=SimpleNamespace(ui_scale=1.0))
    context.update(region=SimpleNamespace(width=300), preferences=preferences)
    panel.draw(SimpleNamespace(layout=layout), SimpleNamespace(**context))
    return layout.noted


def shown(addon: ModuleType, is_open: Any) -> list[Any]:
    """The panels that are there now, below none that is closed."""
    panels = {cls.bl_idname: cls for cls in addon.panels.panel.CLASSES if issubclass(cls, bpy.types.Panel)}

    def is_shown(panel: Any) -> bool:
        parent = panels.get(getattr(panel, "bl_parent_id", ""))
        is_there = getattr(panel, "poll", bool)(bpy.context)
        return is_there and (parent is None or (is_open(parent) and is_shown(parent)))

    return [panel for panel in panels.values() if is_shown(panel)]


def is_open_at_first(panel: Any) -> bool:
    return "DEFAULT_CLOSED" not in getattr(panel, "bl_options", ())


def in_sight(addon: ModuleType) -> dict[str, list[str]]:
    """What a user sees who has opened and closed nothing; "panels" are the headers."""
    panels = shown(addon, is_open_at_first)
    noted = [drawn(panel) for panel in panels if is_open_at_first(panel)]
    seen = {kind: [name for each in noted for name in each[kind]] for kind in ("fields", "buttons")}
    return {"panels": [panel.bl_label for panel in panels], **seen}


def test_a_new_user_has_few_fields_in_sight(addon: ModuleType) -> None:
    stages = {"empty": in_sight(addon)}
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    stages["sample"] = in_sight(addon)
    obj = bpy.context.active_object
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, synthesize=False) == {"FINISHED"}
    stages["built"] = in_sight(addon)
    addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (20, 1)).astype(float))
    stages["recorded"] = in_sight(addon)
    assert max(len(seen["fields"]) for seen in stages.values()) <= 12
    assert stages["sample"]["fields"] == ["take_search", "take_order", "relative"]
    assert stages["recorded"]["fields"] == ["relative"]
    for stage, needed in (("sample", "build"), ("built", "drive"), ("recorded", "bake")):
        assert f"fragmotion.{needed}" in stages[stage]["buttons"]


def test_bake_says_what_it_bakes_and_whether_that_is_still_so(addon: ModuleType, obj: bpy.types.Object) -> None:
    panel, recordings = addon.panels.panel.FRAGMOTION_PT_bake, addon.recordings.recordings
    settings = obj.fragmotion.bake
    settings.seconds = 20
    assert drawn(panel)["texts"] == ["20 s of a simulated walker"]
    recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (20, 1)).astype(float)).name = "To the Door"
    assert drawn(panel)["texts"] == ["To the Door"] and drawn(panel)["buttons"] == ["fragmotion.bake"]
    assert not drawn(addon.panels.recordings.FRAGMOTION_PT_bake_options)["texts"], "the name is said once"
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT") == {"FINISHED"}
    action = recordings.active_recording(obj).baked.name
    assert drawn(panel)["texts"] == ["To the Door", f"As in '{action}'"]
    assert drawn(panel)["buttons"] == ["fragmotion.bake", "fragmotion.bake"], "and Update Bake"
    assert bpy.ops.fragmotion.look_recording("EXEC_DEFAULT") == {"FINISHED"}
    assert drawn(panel)["texts"] == ["To the Door", f"Changed since '{action}'"]
    settings.trace_source, settings.trace_file = "FILE", ""
    assert drawn(panel)["texts"] == ["Choose a CSV file"]


def test_build_says_that_nothing_is_ticked(addon: ModuleType) -> None:
    panel = addon.panels.panel.FRAGMOTION_PT_build
    assert not drawn(panel)["texts"]
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert not drawn(panel)["texts"]
    assert bpy.ops.fragmotion.tick_actions(use=False) == {"FINISHED"}
    assert " ".join(drawn(panel)["texts"]) == "Tick what it is to learn from, under Mocap"


def test_a_built_panel_is_short_and_a_crowds_asks_for_what_it_needs(addon: ModuleType) -> None:
    panels, manager = addon.panels, bpy.context.window_manager.fragmotion
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, synthesize=False) == {"FINISHED"}
    build, settings = panels.panel.FRAGMOTION_PT_build, bpy.context.object.fragmotion
    for is_shown in (False, True):
        manager.show_build = is_shown
        assert any("controls" in text for text in drawn(build)["texts"]) is is_shown
    manager.show_build = False
    settings.populate.layout = "AREA"
    fields = drawn(panels.recordings.FRAGMOTION_PT_populate)["fields"]
    assert fields[:3] == ["count", "layout", "area"] and "mix_styles" not in fields


def test_who_is_new_sees_three_clicks_until_he_waves_them_away(addon: ModuleType, session: ModuleType) -> None:
    preferences, panel = addon.settings.preferences, addon.panels.first_steps.FRAGMOTION_PT_first_steps
    assert in_sight(addon)["panels"][0] == "First Steps"
    assert drawn(panel)["buttons"] == ["fragmotion.add_sample", "fragmotion.build", "fragmotion.drive"]
    assert in_sight(addon)["buttons"].count("fragmotion.add_sample") == 1
    for done, button in enumerate(drawn(panel)["buttons"][:2], 1):
        assert getattr(bpy.ops.fragmotion, button.partition(".")[2])("EXEC_DEFAULT") == {"FINISHED"}
        assert drawn(panel)["button icons"].count("CHECKMARK") == done
    bpy.context.view_layer.objects.active = None  # what is done stays ticked
    assert drawn(panel)["button icons"].count("CHECKMARK") == 2
    bpy.context.view_layer.objects.active = next(obj for obj in bpy.data.objects if obj.type == "ARMATURE")
    session.start(bpy.context, bpy.context.object)
    assert drawn(panel)["button icons"].count("CHECKMARK") == 3
    session.stop()
    preferences.end_first_steps(bpy.context)
    assert "First Steps" not in in_sight(addon)["panels"]
    bpy.context.view_layer.objects.active = None
    assert in_sight(addon)["buttons"].count("fragmotion.add_sample") == 1
    preferences.get(bpy.context).first_steps = True


def test_terms_of_the_method_are_under_advanced(addon: ModuleType) -> None:
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, synthesize=False) == {"FINISHED"}
    manager = bpy.context.window_manager.fragmotion
    manager.show_mocap = manager.show_build = True
    for panel in shown(addon, lambda panel: panel.bl_label != "Advanced"):
        if panel.bl_label in {"Advanced", "Coverage"}:  # which draws pictures, for which there is no window here
            continue
        noted, seeded = drawn(panel), _SEEDED.get(panel.bl_label, set())
        assert not {"policy", "cut", "seed"} & set(noted["fields"]) - seeded, panel.bl_label
        assert not any(word in text for text in noted["texts"] for word in ("Optimal", "Paper")), panel.bl_label


def test_every_panel_can_be_drawn(addon: ModuleType) -> None:
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    obj = bpy.context.active_object
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, synthesize=False) == {"FINISHED"}
    addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (20, 1)).astype(float))
    manager = bpy.context.window_manager.fragmotion
    manager.show_mocap = manager.show_build = True
    panels = shown(addon, lambda _panel: True)
    assert len(panels) > 20
    assert all(any(drawn(panel).values()) for panel in panels if panel.bl_label != "Coverage"), "but for pictures"


@pytest.mark.skipif(bpy.app.version < (4, 3, 0), reason="this Blender draws all icons as wide as high")
def test_wide_icons_of_keys_get_room_in_the_status_bar(addon: ModuleType) -> None:
    status, shown, layout = addon.operators.base.status, [], Layout()
    workspace = SimpleNamespace(status_text_set=shown.append)
    status.show(workspace, [status.Hint(("ESC", "W"), "End"), status.Hint(("SPACE",), "Jump")])
    shown[0](SimpleNamespace(layout=layout), None)
    assert layout.noted["icons"] == [
        *("EVENT_ESC", "1.5", "EVENT_W", "NONE", "2"),
        *("EVENT_SPACEKEY", "3", "NONE", "2"),
    ]


def test_a_doubtful_bone_is_named_with_its_takes_and_among_the_bones(addon: ModuleType) -> None:
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert bpy.ops.fragmotion.find_bones() == {"FINISHED"}
    settings = bpy.context.active_object.fragmotion
    bone = settings.roles["left_hand"].bone
    mocap, bones = addon.panels.panel.FRAGMOTION_PT_mocap, addon.panels.bones.FRAGMOTION_PT_bones
    assert not any("See Bones" in text for text in drawn(mocap)["texts"])
    doubt = settings.doubts.add()
    doubt.name, doubt.bone, doubt.text = "left_hand", bone, "ends aside of the arm"
    for _ in range(2):  # among the roles, and where none is chosen
        assert f"See Bones for '{bone}'" in drawn(mocap)["texts"]
        assert doubt.text in drawn(bones)["texts"] and "fragmotion.confirm_bone" in drawn(bones)["buttons"]
        settings.roles.clear()
    doubt.right = True
    assert not any("See Bones" in text for text in drawn(mocap)["texts"])
    assert doubt.text not in drawn(bones)["texts"]


def test_findings_that_differ_by_their_frames_are_one_line(addon: ModuleType) -> None:
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    doctor = addon.panels.doctor.FRAGMOTION_PT_doctor
    findings = addon.mocap.actions.chosen(bpy.context, bpy.context.active_object).fragmotion.findings
    findings.clear()
    for number, (code, mended) in enumerate([("dropped", False), ("ground", False), *[("dropped", False)] * 22]):
        row = findings.add()
        row.code, row.severity, row.text, row.mendable, row.mended = code, "warning", f"{code} {number}", True, mended
    findings[-1].mended = True
    noted = drawn(doctor)
    text = " ".join(noted["texts"])
    assert "dropped 0 (and 21 more like it)" in text and "ground 1" in text and "dropped 23 (mended)" in text
    assert noted["buttons"] == ["fragmotion.mend_finding"] * 2


@pytest.mark.parametrize(
    ("names", "beginning"),
    [
        (["dataset-1_walk_001", "dataset-1_walk_002"], "dataset-1_walk_"),
        (["dataset-1_walk_001", "dataset-1_run_001"], "dataset-1_"),
        (["walk forward", "walking", "walk back"], ""),
        (["walk ", "walk back"], ""),
        (["walk"], ""),
        ([], ""),
    ],
)
def test_names_of_takes_are_listed_without_what_all_begin_with(
    addon: ModuleType, names: list[str], beginning: str
) -> None:
    assert addon.mocap.actions.common_beginning(names) == beginning


def test_a_take_can_be_renamed_in_the_list_where_its_whole_name_is_seen(
    addon: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By a double click, which Blender lets change a name that is drawn as a field."""
    takes = addon.panels.panel.FRAGMOTION_UL_actions
    actions = [bpy.data.actions.new(name) for name in ("walk left", "walk right")]
    chosen = SimpleNamespace(index=bpy.data.actions.find("walk left"))

    def row(action: bpy.types.Action) -> dict[str, list[str]]:
        layout = Layout()
        item = SimpleNamespace(beginning=takes.beginning)
        takes.draw_item(item, bpy.context, layout, bpy.data, action, 0, chosen, "index")
        return layout.noted

    monkeypatch.setattr(takes, "beginning", "")
    assert all(row(action)["fields"] == ["use", "name"] for action in actions)
    monkeypatch.setattr(takes, "beginning", "walk ")
    assert row(actions[0])["fields"] == ["use", "name"], "the selected one is said whole"
    assert row(actions[1])["fields"] == ["use"] and row(actions[1])["texts"][0] == "right"


def test_the_pie_offers_what_can_be_done_now(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    pie = addon.panels.menus.FRAGMOTION_MT_pie
    assert drawn(pie)["buttons"] == ["fragmotion.bake", "fragmotion.record", "fragmotion.drive"]
    addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (20, 1)).astype(float))
    assert drawn(pie)["buttons"] == ["fragmotion.bake", "fragmotion.record", *["fragmotion.drive"] * 2]
