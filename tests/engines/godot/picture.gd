# SPDX-License-Identifier: MIT
# Plays the demo from a place by a stick that is held, saves a picture of it, and prints what it shows. Arguments:
# FILE SECONDS PLACE_X PLACE_Z STICK_X STICK_Y.
extends SceneTree

const FOOT := Color(1, 0.6, 0) # the right one, of the sample


func _initialize() -> void:
	_run.call_deferred()


func _run() -> void:
	var given := OS.get_cmdline_user_args()
	var demo: Node = load("res://demo/demo.tscn").instantiate()
	root.add_child(demo)
	var hero: FragmotionCharacter = demo.get_node("Hero/Character")
	hero.teleport(Transform3D(Basis.IDENTITY, Vector3(float(given[2]), 0, float(given[3]))))
	for frame in roundi(60 * float(given[1])):
		_push("ui_right", "ui_left", float(given[4]))
		_push("ui_up", "ui_down", float(given[5]))
		await physics_frame
	await process_frame
	await RenderingServer.frame_post_draw
	var image := root.get_texture().get_image()
	image.save_png(given[0])
	print("hero at %s" % demo.get_node("Hero").position)
	print("orange in the middle: %d" % _orange(image))
	quit()


func _push(positive: String, negative: String, value: float) -> void:
	if value > 0:
		Input.action_press(positive, value)
	if value < 0:
		Input.action_press(negative, -value)


func _orange(image: Image) -> int:
	var found := 0
	for y in range(image.get_height() / 3, image.get_height()):
		for x in range(image.get_width() / 3, 2 * image.get_width() / 3):
			var color := image.get_pixel(x, y)
			found += int(absf(color.h - FOOT.h) < 0.04 and color.s > 0.6 and color.v > 0.4)
	return found
