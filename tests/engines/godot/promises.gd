# SPDX-License-Identifier: MIT
# What the node promises, in a world with physics: prints "passed NAME" or "failed NAME: why" for each.
extends SceneTree

const FRAME := 1.0 / 60

var _wrong := ""


func _initialize() -> void:
	_run.call_deferred()


func _run() -> void:
	await _physics(2)
	for method in get_method_list():
		if method.name.begins_with("test_"):
			_wrong = ""
			await call(method.name)
			print("passed " + method.name if _wrong.is_empty() else "failed %s: %s" % [method.name, _wrong])
			for child in root.get_children():
				child.queue_free()
			await _physics(2)
	quit()


func _physics(frames: int) -> void:
	for frame in frames:
		await physics_frame


func _expect(holds: bool, what: String) -> void:
	if not holds and _wrong.is_empty():
		_wrong = what


func _made(parent: Node = root, ground := 0) -> FragmotionCharacter:
	var character := FragmotionCharacter.new()
	character.policy = load("res://demo/sample.policy")
	character.callback = FragmotionCharacter.Callback.MANUAL
	character.ground_mask = ground
	character.add_child(load("res://demo/sample.glb").instantiate())
	parent.add_child(character)
	return character


func _play(character: FragmotionCharacter, seconds: float, stick: Vector2) -> void:
	character.stick = stick
	for frame in roundi(seconds / FRAME):
		character.advance(FRAME)


func _box(at: Vector3, size: Vector3, turned := Vector3.ZERO) -> void:
	var body := StaticBody3D.new()
	var shape := CollisionShape3D.new()
	shape.shape = BoxShape3D.new()
	shape.shape.size = size
	body.add_child(shape)
	body.position = at
	body.rotation = turned
	root.add_child(body)


func test_the_policy_tells_what_it_holds() -> void:
	var policy: FragmotionPolicy = load("res://demo/sample.policy")
	_expect(policy.is_valid() and policy.get_bones().size() > 15, "bones")
	_expect(policy.get_moves().has("wave") and policy.get_styles().has("proud"), "moves and styles")
	_expect(policy.get_speeds(0).size() >= 1 and policy.get_speeds(0)[0] > 0.3, "speeds")
	_expect(policy.get_class_name(0, 0).length() > 2, "a class's name")


func test_it_goes_where_the_camera_looks() -> void:
	var camera := Camera3D.new()
	root.add_child(camera)
	camera.look_at(Vector3.RIGHT)
	var character := _made()
	_play(character, 3, Vector2(0, 0.5))
	_expect(character.position.x > 1.5 and absf(character.position.z) < 0.7, "at %s" % character.position)


func test_it_goes_and_faces_as_the_world_is() -> void:
	var character := _made()
	character.steer = FragmotionCharacter.Steer.WORLD
	character.velocity = Vector3(0, 0, 1.2)
	character.facing = Vector3.BACK
	_play(character, 4, Vector2.ZERO)
	_expect(character.position.z > 2, "at %s" % character.position)
	_expect(-character.basis.z.z > 0.9, "it faces back")


func test_signals_tell_of_steps_moves_styles_and_landings() -> void:
	var character := _made()
	var heard := []
	character.foot_down.connect(func(side, _where): heard.append("foot %d" % side))
	character.landed.connect(func(_where): heard.append("landed"))
	character.move_began.connect(func(move): heard.append(move))
	character.style_changed.connect(func(style): heard.append(style))
	_play(character, 2, Vector2(0, 0.5))
	character.start_move("wave")
	character.change_style("tired")
	_play(character, 2, Vector2(0, 0.5))
	character.release_move("wave")
	_play(character, 2, Vector2.ZERO)
	character.jump = true
	_play(character, 2, Vector2.ZERO)
	for what in ["foot 0", "foot 1", "wave", "tired", "landed"]:
		_expect(heard.has(what), "%s is not in %s" % [what, heard])
	_expect(character.get_style() == "tired", "the style")


func test_stairs_and_slopes_are_walked_on() -> void:
	_box(Vector3(0, -0.5, 0), Vector3(40, 1, 6))
	for step in 6:
		_box(Vector3(0, 0.085 * (step + 1), -4 - 0.3 * step), Vector3(4, 0.17 * (step + 1), 0.3))
	_box(Vector3(0, 0.51, -9.65), Vector3(4, 1.02, 8))
	_box(Vector3(0, -0.5, -2), Vector3(40, 1, 4))
	await _physics(2)
	var character := _made(root, 1)
	_play(character, 6, Vector2(0, 0.5))
	_expect(character.position.z < -6 and absf(character.position.y - 1.02) < 0.03, "at %s" % character.position)


func test_walls_stop_its_body() -> void:
	_box(Vector3(0, 1, -3), Vector3(10, 2, 0.5))
	await _physics(2)
	var body := CharacterBody3D.new()
	body.motion_mode = CharacterBody3D.MOTION_MODE_FLOATING
	var shape := CollisionShape3D.new()
	shape.shape = CapsuleShape3D.new()
	shape.shape.radius = 0.3
	shape.shape.height = 1.3
	shape.position.y = 1.1
	body.add_child(shape)
	root.add_child(body)
	var character := _made(body)
	character.callback = FragmotionCharacter.Callback.PHYSICS
	character.stick = Vector2(0, 0.5)
	await _physics(300)
	_expect(body.position.z < -1.5 and body.position.z > -2.5, "at %s" % body.position)
	_expect(character.player.get_place().origin.distance_to(body.position) < 1e-4, "the player is with it")


func test_paths_are_followed_to_their_end() -> void:
	var character := _made()
	var way := Curve3D.new()
	for point in [Vector3.ZERO, Vector3(0, 0, -3), Vector3(2, 0, -5)]:
		way.add_point(point)
	var arrived := [false]
	character.path_arrived.connect(func(): arrived[0] = true)
	character.steer = FragmotionCharacter.Steer.PATH
	character.follow(way)
	_play(character, 12, Vector2.ZERO)
	_expect(arrived[0] and character.position.distance_to(Vector3(2, 0, -5)) < 0.5, "at %s" % character.position)


func test_a_saved_state_goes_on_to_the_bit() -> void:
	var character := _made()
	_play(character, 1.5, Vector2(0.3, 0.5))
	var state := character.save_state()
	_play(character, 1, Vector2(-0.5, 0.5))
	var sum := character.player.get_checksum()
	_expect(character.restore_state(state), "restored")
	_play(character, 1, Vector2(-0.5, 0.5))
	_expect(character.player.get_checksum() == sum, "the same")
	_play(character, FRAME, Vector2(-0.5, 0.5))
	_expect(character.player.get_checksum() != sum, "and no longer")


func test_a_teleport_takes_it_along() -> void:
	var character := _made()
	_play(character, 1, Vector2(0, 0.5))
	character.teleport(Transform3D(Basis(Vector3.UP, PI / 2), Vector3(7, 1, 3)))
	_play(character, FRAME, Vector2(0, 0.5))
	_expect(character.position.distance_to(Vector3(7, 1, 3)) < 0.1, "at %s" % character.position)


func test_what_is_wrong_is_said_and_harms_nothing() -> void:
	var policy := FragmotionPolicy.new()
	policy.data = "no policy".to_utf8_buffer()
	_expect(not policy.is_valid(), "no policy")
	var player := FragmotionPlayer.new()
	_expect(not player.play(policy, 1) and not player.play(null, 1), "no policy plays")
	_expect(not player.play(Resource.new(), 1), "another resource plays")
	_expect(not player.step(0, Vector3.ZERO, Vector3.ZERO, 0, false, FRAME), "it steps without one")
	_expect(player.save_state().is_empty() and player.get_events().is_empty(), "a state without one")
	player.show()
	var character := _made()
	_expect(not character.start_move("fly"), "no such move")
	_expect(not character.restore_state("no state".to_utf8_buffer()), "no state")
	character.get_child(0).free()
	_play(character, 0.1, Vector2(0, 1))


func test_its_head_turns_to_what_it_looks_at() -> void:
	var character := _made()
	var target := Node3D.new()
	root.add_child(target)
	character.look_target = target
	character.look = FragmotionCharacter.Look.AT
	var turned := []
	for side in [-5, 5]:
		target.position = Vector3(side, 1.6, -1)
		_play(character, 2, Vector2.ZERO)
		var skeleton: Skeleton3D = character.find_children("*", "Skeleton3D", true, false)[0]
		var head := skeleton.global_transform * skeleton.get_bone_global_pose(skeleton.find_bone("head"))
		turned.append(head.basis.z)
	_expect(turned[0].signed_angle_to(turned[1], Vector3.UP) < -0.8, "its head: %s" % [turned])


func test_a_crowd_makes_way() -> void:
	var crowd := FragmotionCrowd.new()
	crowd.policy = load("res://demo/sample.policy")
	for number in 12:
		var walker := FragmotionCharacter.new()
		walker.policy = crowd.policy
		walker.callback = FragmotionCharacter.Callback.MANUAL
		walker.ground_mask = 0
		walker.steer = FragmotionCharacter.Steer.WORLD
		walker.position = Vector3(4, 0, 0).rotated(Vector3.UP, TAU * number / 12)
		walker.velocity = -walker.position / 4
		walker.rotation.y = atan2(walker.position.x, walker.position.z)
		crowd.add_child(walker)
	root.add_child(crowd)
	var nearest := INF
	for frame in 1200: # they wait for each other in the middle
		crowd.players.make_way(crowd.radius, FRAME, PackedVector3Array())
		for one in crowd.get_children():
			one.advance(FRAME)
			for other in crowd.get_children():
				if one != other:
					nearest = minf(nearest, one.position.distance_to(other.position))
	_expect(nearest > 0.4, "they come to %.2f m of each other" % nearest)
	for one in crowd.get_children():
		var far: float = one.position.dot(one.velocity)
		_expect(far > 1, "and pass: at %s" % one.position)
	_expect(not FragmotionPlayers.new().make(null, 3, 1), "a crowd of nothing")
	_expect(not FragmotionPlayers.new().make_way(0.3, FRAME, PackedVector3Array()), "nobody makes way")
	_expect(not FragmotionPlayer.new().play_one_of(crowd.players, 99), "one that is none of them")


func test_a_hundred_play_at_sixty_frames_a_second() -> void:
	var all := []
	for number in 100:
		all.append(_made())
	var begin := Time.get_ticks_usec()
	for character in all:
		_play(character, 1, Vector2(0, 0.5))
	var milliseconds := (Time.get_ticks_usec() - begin) / 1000.0 / 60
	print("a hundred characters: %.2f ms a frame" % milliseconds)
	_expect(milliseconds < 1000.0 / 60, "%.1f ms a frame" % milliseconds)


func test_one_on_ground_costs_little() -> void:
	_box(Vector3(0, -0.5, 0), Vector3(40, 1, 40))
	await _physics(2)
	var character := _made(root, 1)
	var begin := Time.get_ticks_usec()
	_play(character, 5, Vector2(0, 0.5))
	print("one on ground: %.3f ms a frame" % ((Time.get_ticks_usec() - begin) / 1000.0 / 300))
	_expect(absf(character.position.y) < 0.01, "at %s" % character.position)
