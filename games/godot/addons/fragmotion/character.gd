# SPDX-License-Identifier: MIT
@icon("icons/character.svg")
class_name FragmotionCharacter
extends Node3D
## Plays a character that was made of motion capture in Blender: it follows a stick, on slopes and stairs.
##
## Put the imported mesh (the [code].glb[/code]) below this node and set [member policy]. Bones are found by their names;
## those that the policy lacks, such as fingers, are left to you. Then set [member stick] and [member jump] each frame.[br]
## [br]
## Below a [CharacterBody3D] its motion moves that body, so that walls stop it; else it moves this node. Give the body a
## capsule that begins a step's height above the ground, and the motion mode [i]Floating[/i]: the feet find the ground by
## [member ground_mask].

## A foot comes down: 0 left, 1 right. [param where]: the middle of its sole.
signal foot_down(side: int, where: Vector3)
## A foot leaves the ground.
signal foot_up(side: int, where: Vector3)
## The last foot leaves the ground for a jump.
signal took_off(where: Vector3)
## The first foot is back on the ground after a jump.
signal landed(where: Vector3)
## A move begins, at the moment that joins best.
signal move_began(move: String)
## A move ends.
signal move_ended(move: String)
## Another style plays from now on.
signal style_changed(style: String)
## It stands at the end of its path.
signal path_arrived
## A marker that an animator set in the take or the move that plays is passed.
signal marker_passed(marker: String)

## What [member stick], [member velocity] and [member facing] mean.
enum Steer {
	CHARACTER, ## [member velocity] as the character sees it: x to its right, z behind it.
	WORLD, ## [member velocity] in the world; [member facing]: where to face.
	CAMERA, ## [member stick] as the camera sees it.
	PATH, ## Along the path of [method follow].
}

## Where head and chest look, as far and as fast as in its takes.
enum Look {
	AS_CAPTURED, ## As its takes have it.
	AHEAD, ## Where it goes.
	AT, ## At [member look_target].
}

## When it plays on.
enum Callback {
	PHYSICS, ## Each physics frame: the only one for bodies and ground.
	IDLE, ## Each frame that is drawn.
	MANUAL, ## By [method advance] alone.
}

## The character: an imported [code].policy[/code] file.
@export var policy: FragmotionPolicy:
	set(value):
		policy = value
		if is_node_ready():
			_begin()

## The skeleton that it drives; none: the first below this node.
@export var skeleton: Skeleton3D

## The camera that [constant Steer.CAMERA] is seen by; none: the viewport's own.
@export var camera: Camera3D

@export var steer := Steer.CAMERA
@export var callback := Callback.PHYSICS

## It stands and walks on what is on these layers, down to 100 m below; none: on level ground at the height of its place.
@export_flags_3d_physics var ground_mask := 1

## Where head and chest look.
@export var look := Look.AS_CAPTURED

## What [constant Look.AT] looks at; none: as captured.
@export var look_target: Node3D

@export_group("Playing")

## How soon what is asked for is done; 0.5 is what a body does.
@export_range(0, 1, 0.01) var responsiveness := 0.5:
	set(value):
		responsiveness = value
		_set_option("responsiveness", value)

## 0 pauses.
@export_range(0, 4, 0.01, "or_greater") var time_scale := 1.0:
	set(value):
		time_scale = value
		_set_option("time_scale", value)

## It plays on in every n-th frame: for those far away.
@export_range(1, 64) var step_interval := 1:
	set(value):
		step_interval = value
		_set_option("step_interval", value)

## Seconds of a fixed step, between which poses are interpolated, for lockstep and rollback; 0: as long as the frame.
@export_range(0, 0.1, 0.001, "suffix:s") var fixed_step := 0.0:
	set(value):
		fixed_step = value
		_set_option("fixed_step", value)

## Of what it chooses: give each of a crowd another.
@export var random_seed := 1

## A stick to the right and up, within the unit circle: half is a walk, fully a run. As
## [code]Input.get_vector("left", "right", "down", "up")[/code].
var stick := Vector2.ZERO
## m/s, for [constant Steer.WORLD] and [constant Steer.CHARACTER].
var velocity := Vector3.ZERO
## Where to face in the world, for [constant Steer.WORLD]; zero: it does not turn.
var facing := Vector3.ZERO
## -1 right to 1 left, times its turn rate; with facing and by the camera, 0 turns it by itself.
var turn := 0.0
## Whether the button is pressed; one jump, however long.
var jump := false

## What plays: for all that has no name here.
var player := FragmotionPlayer.new()

var _plays := false
var _players: FragmotionPlayers # of the crowd that it joined
var _index := 0 # among them
var _query: PhysicsRayQueryParameters3D


func _ready() -> void:
	_begin()


func _physics_process(delta: float) -> void:
	if callback == Callback.PHYSICS:
		advance(delta)


func _process(delta: float) -> void:
	if callback == Callback.IDLE:
		advance(delta)


## Plays on for some seconds and shows the pose.
func advance(seconds: float) -> void:
	if not _plays:
		return
	_look()
	player.step(steer, _asked(), _faced(), turn, jump, seconds)
	_carry(seconds)
	player.show()
	_tell()


## Starts a move by its name, until [method release_move]; it begins at the moment that joins best.
func start_move(move: String) -> bool:
	return player.start_move(_number(move, policy.get_moves(), "move"))


## Ends a move by its name: what loops, after this round.
func release_move(move: String) -> bool:
	return player.release_move(_number(move, policy.get_moves(), "move"))


## Goes on in another style, by its name.
func change_style(style: String) -> bool:
	return player.change_style(_number(style, policy.get_styles(), "style"))


## The name of the style that it plays.
func get_style() -> String:
	return policy.get_styles()[player.get_style()]


## What it does, as "walk forward left".
func get_doing() -> String:
	return policy.get_class_name(player.get_style(), player.get_class_index())


## Walks along a curve in the world, with [member steer] at [constant Steer.PATH]. [param speed]: m/s, 0: as it walks.
func follow(curve: Curve3D, closed := false, speed := 0.0) -> bool:
	return player.set_path(curve.get_baked_points(), closed, 1 if closed else 0, speed)


## Plays from now on as one of those who make way for each other; [FragmotionCrowd] does that for its children.
func join(players: FragmotionPlayers, index: int) -> void:
	_players = players
	_index = index
	_begin()


## Puts it somewhere else at once: all goes along that it does.
func teleport(to: Transform3D) -> void:
	_carried().global_transform = to
	player.move_to(to)
	player.show()


## Stands where its node is, and forgets what it did.
func reset() -> void:
	player.reset(_carried().global_transform, 0)
	player.show()


## All that its next poses depend on, but for policy, ground and path.
func save_state() -> PackedByteArray:
	return player.save_state()


## Goes on from there, to the bit.
func restore_state(state: PackedByteArray) -> bool:
	if not player.restore_state(state):
		return false
	_carried().global_transform = player.get_place()
	player.show()
	return true


func _begin() -> void:
	_plays = policy != null and policy.is_valid() and _play()
	if not _plays:
		return
	for option in ["responsiveness", "time_scale", "step_interval", "fixed_step"]:
		player.set_option(option, get(option))
	_bind()
	_find_ground()
	reset()


func _play() -> bool:
	return player.play(policy, random_seed) if _players == null else player.play_one_of(_players, _index)


func _look() -> void:
	if look == Look.AT and look_target != null:
		player.look(look, look_target.global_position)
	else:
		player.look(Look.AS_CAPTURED if look == Look.AT else look, Vector3.ZERO)


func _bind() -> void:
	var driven := skeleton
	if driven == null:
		for found in find_children("*", "Skeleton3D", true, false):
			driven = found
			break
	if driven == null:
		push_warning("%s: there is no Skeleton3D below it" % get_path())
		return
	var from_model := driven.global_transform.affine_inverse() * global_transform
	if player.bind(policy, driven, from_model, from_model.basis.get_rotation_quaternion()) == 0:
		push_warning("%s: %s has no bone that is named as one of the policy's" % [get_path(), driven.get_path()])


func _find_ground() -> void:
	if ground_mask == 0:
		player.set_ground(null, null)
		return
	_query = PhysicsRayQueryParameters3D.new()
	_query.collision_mask = ground_mask
	if _body() != null:
		_query.exclude = [_body().get_rid()]
	player.set_ground(get_world_3d().direct_space_state, _query)


func _set_option(option: String, value: float) -> void:
	if _plays:
		player.set_option(option, value)


func _asked() -> Vector3:
	if steer == Steer.CAMERA:
		return Vector3(stick.x, stick.y, 0)
	if steer == Steer.CHARACTER:
		return Vector3(velocity.x, -velocity.z, 0)
	return velocity


func _faced() -> Vector3:
	if steer != Steer.CAMERA:
		return facing
	var seen_by := camera if camera != null else get_viewport().get_camera_3d()
	return -seen_by.global_basis.z if seen_by != null else Vector3.FORWARD


func _body() -> CharacterBody3D:
	return get_parent() as CharacterBody3D


func _carried() -> Node3D:
	return _body() if _body() != null else self


func _carry(seconds: float) -> void:
	var place := player.get_place()
	var body := _body()
	if body == null:
		global_transform = place
		return
	if seconds <= 0:
		return
	body.velocity = (place.origin - body.global_position) / seconds
	body.move_and_slide()
	if not body.global_position.is_equal_approx(place.origin):
		player.move_to(Transform3D(place.basis, body.global_position))
	body.global_basis = place.basis


func _tell() -> void:
	var events := player.get_events()
	for at in range(0, events.size(), 6):
		var index := int(events[at + 1])
		var where := Vector3(events[at + 2], events[at + 3], events[at + 4])
		match int(events[at]):
			0: foot_down.emit(index, where)
			1: foot_up.emit(index, where)
			2: took_off.emit(where)
			3: landed.emit(where)
			4: move_began.emit(policy.get_moves()[index])
			5: move_ended.emit(policy.get_moves()[index])
			6: style_changed.emit(policy.get_styles()[index])
			7: path_arrived.emit()
			8: marker_passed.emit(policy.get_markers()[index])


func _number(sought: String, names: PackedStringArray, kind: String) -> int:
	var number := names.find(sought)
	if number < 0:
		push_error("%s: there is no %s '%s'; there are %s" % [get_path(), kind, sought, ", ".join(names)])
	return number
