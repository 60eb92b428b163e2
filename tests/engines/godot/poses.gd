# SPDX-License-Identifier: MIT
# Plays what tests/engines/native.py plays, on the skeleton of an imported mesh, and prints for each frame and each bone
# of the policy "frame bone x y z qx qy qz qw": in its parent, and without one, in the model.
extends SceneTree

const FRAMES := 600

var _character := FragmotionCharacter.new()
var _skeleton: Skeleton3D
var _to_model: Transform3D


func _initialize() -> void:
	_play.call_deferred()


func _play() -> void:
	_character.policy = load("res://demo/sample.policy")
	_character.callback = FragmotionCharacter.Callback.MANUAL
	_character.ground_mask = 0
	_character.add_child(load("res://demo/sample.glb").instantiate())
	root.add_child(_character)
	_skeleton = _character.find_children("*", "Skeleton3D", true, false)[0]
	_to_model = _character.global_transform.affine_inverse() * _skeleton.global_transform
	for frame in FRAMES:
		if frame == 300:
			_character.start_move(_character.policy.get_moves()[0])
		var part := frame / 45
		_character.stick = Vector2((part * 7 % 5 - 2) / 2.0, (part * 11 % 7 - 2) / 4.0)
		_character.jump = part % 6 == 5
		_character.advance(1.0 / 60)
		for bone in _character.policy.get_bones():
			_print_bone(frame, bone)
	quit()


func _print_bone(frame: int, name: String) -> void:
	var bone := _skeleton.find_bone(name)
	var at := _skeleton.get_bone_pose(bone)
	if _skeleton.get_bone_parent(bone) < 0:
		at = _to_model * at
	var turned := at.basis.get_rotation_quaternion()
	var numbers := [at.origin.x, at.origin.y, at.origin.z, turned.x, turned.y, turned.z, turned.w]
	print("%d %s %s" % [frame, name, " ".join(numbers.map(func(number): return "%.9f" % number))])
