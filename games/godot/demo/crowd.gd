# SPDX-License-Identifier: MIT
extends Node3D
## Others, who walk round and round, each along an ellipse of its own.

@export var policy: FragmotionPolicy
@export var mesh: PackedScene
@export_range(0, 300) var count := 40


func _ready() -> void:
	for number in count:
		var walker := FragmotionCharacter.new()
		walker.policy = policy
		walker.random_seed = 2 + number
		walker.ground_mask = 0
		walker.steer = FragmotionCharacter.Steer.PATH
		walker.add_child(mesh.instantiate())
		var way := _way(number)
		walker.position = way.get_point_position(0)
		add_child(walker)
		walker.follow(way, true)


func _way(number: int) -> Curve3D:
	var way := Curve3D.new()
	var size := Vector3(14 + number % 12, 0, 17 + 0.8 * (number % 12))
	var begin := TAU * number / count
	for corner in 24:
		var angle := begin + TAU * corner / 24
		way.add_point(Vector3(size.x * cos(angle), 0, size.z * sin(angle)))
	return way
