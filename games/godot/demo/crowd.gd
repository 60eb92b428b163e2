# SPDX-License-Identifier: MIT
extends FragmotionCrowd
## Others, who walk round and round, each along an ellipse of its own, make way, and look at who comes near.

const NEAR := 5.0 # m

@export var mesh: PackedScene
@export var hero: Node3D
@export_range(0, 300) var count := 40


func _ready() -> void:
	others = [hero]
	for number in count:
		var walker := FragmotionCharacter.new()
		walker.policy = policy
		walker.ground_mask = 0
		walker.steer = FragmotionCharacter.Steer.PATH
		walker.look_target = hero
		walker.add_child(mesh.instantiate())
		walker.position = _way(number).get_point_position(0)
		add_child(walker)
	gather()
	for number in count:
		get_child(number).follow(_way(number), true)


func _physics_process(delta: float) -> void:
	super(delta)
	for walker: FragmotionCharacter in get_children():
		var is_near := walker.position.distance_to(hero.position) < NEAR
		walker.look = FragmotionCharacter.Look.AT if is_near else FragmotionCharacter.Look.AS_CAPTURED


func _way(number: int) -> Curve3D:
	var way := Curve3D.new()
	var size := Vector3(14 + number % 12, 0, 17 + 0.8 * (number % 12))
	var begin := TAU * number / count
	for corner in 24:
		var angle := begin + TAU * corner / 24
		way.add_point(Vector3(size.x * cos(angle), 0, size.z * sin(angle)))
	return way
