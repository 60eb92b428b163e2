# SPDX-License-Identifier: MIT
@icon("icons/character.svg")
class_name FragmotionCrowd
extends Node3D
## Characters who make way for each other and for you: the [FragmotionCharacter] nodes that are its children.
##
## All of them play [member policy]. What they are asked for, by a path, a velocity or a stick, is what they do wherever
## nobody is in the way. Characters that are added later join in by [method gather].

## The character that all of them are: an imported [code].policy[/code] file.
@export var policy: FragmotionPolicy
## How wide each of them is; they keep twice that from each other's middle.
@export_range(0.1, 2, 0.01, "or_greater", "suffix:m") var radius := 0.35
## Who makes no way, so that they go all of it: you. The velocity of a [CharacterBody3D] counts, others stand.
@export var others: Array[Node3D] = []
## Of the first one's choices; each has another.
@export var random_seed := 1

## All of them, for what has no name here.
var players := FragmotionPlayers.new()

var _is_ready := false


func _ready() -> void:
	gather()


func _physics_process(delta: float) -> void:
	if _is_ready:
		players.make_way(radius, delta, _bodies())


## Takes in all that are its children now; each begins where its node is.
func gather() -> bool:
	var members := get_children().filter(func(child): return child is FragmotionCharacter)
	_is_ready = policy != null and not members.is_empty() and players.make(policy, members.size(), random_seed)
	if _is_ready:
		for index in members.size():
			members[index].join(players, index)
	return _is_ready


func _bodies() -> PackedVector3Array:
	var bodies := PackedVector3Array()
	for other in others:
		bodies.append(other.global_position)
		bodies.append(other.velocity if other is CharacterBody3D else Vector3.ZERO)
	return bodies
