# SPDX-License-Identifier: MIT
@tool
extends StaticBody3D
## What there is to walk on: a floor, a ramp, stairs up and down, and walls; each a box that is seen and stood on.

const GREY := Color(0.62, 0.65, 0.7)
const STEP := Vector3(3, 0.17, 0.3)


func _ready() -> void:
	_add_box(Vector3(0, -0.5, 0), Vector3(60, 1, 60), Color(0.42, 0.47, 0.42))
	_add_box(Vector3(-6, 0.38, -8), Vector3(4, 0.3, 8), GREY, Vector3(deg_to_rad(8), 0, 0))
	_add_box(Vector3(-6, 0.43, -14), Vector3(4, 1.06, 4.4), GREY)
	for step in 8:
		_add_step(step, Vector3(5, 0, -5 - step * STEP.z))
		_add_step(step, Vector3(5, 0, -11.1 + step * STEP.z))
	_add_box(Vector3(5, 0.68, -8.05), Vector3(3, 1.36, 1.6), GREY)
	_add_box(Vector3(0, 1.25, 9), Vector3(12, 2.5, 0.4), Color(0.7, 0.55, 0.45))


func _add_step(step: int, at: Vector3) -> void:
	var height := (step + 1) * STEP.y
	_add_box(at + Vector3(0, height / 2, 0), Vector3(STEP.x, height, STEP.z), GREY.darkened(0.1 * (step % 2)))


func _add_box(at: Vector3, size: Vector3, color: Color, turned := Vector3.ZERO) -> void:
	var shape := CollisionShape3D.new()
	shape.shape = BoxShape3D.new()
	shape.shape.size = size
	shape.position = at
	shape.rotation = turned
	var seen := MeshInstance3D.new()
	seen.mesh = BoxMesh.new()
	seen.mesh.size = size
	seen.mesh.material = StandardMaterial3D.new()
	seen.mesh.material.albedo_color = color
	shape.add_child(seen)
	add_child(shape)
