# SPDX-License-Identifier: MIT
extends Node3D
## A character in the third person. Arrows or a stick: go; space: jump; 1 to 9: moves; Tab: the next style; the mouse or
## the right stick turns the camera.

const LOOK_SPEED := 2.5 # rad/s
const MOUSE_SPEED := 0.004 # rad a pixel
const DEAD := 0.15 # of the stick

@onready var hero: FragmotionCharacter = $Hero/Character
@onready var arm: SpringArm3D = $Arm
@onready var told: Label = $Told


func _ready() -> void:
	arm.add_excluded_object($Hero.get_rid())


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and event.button_mask != 0:
		_look(event.relative * MOUSE_SPEED)
	if event.is_action_pressed("ui_focus_next"):
		_next_style()
	if event is InputEventKey and not event.echo:
		_move(event.keycode - KEY_1, event.pressed)


func _physics_process(delta: float) -> void:
	hero.stick = Input.get_vector("ui_left", "ui_right", "ui_down", "ui_up", DEAD)
	hero.jump = Input.is_action_pressed("ui_accept")
	_look(LOOK_SPEED * delta * Vector2(Input.get_joy_axis(0, JOY_AXIS_RIGHT_X), Input.get_joy_axis(0, JOY_AXIS_RIGHT_Y)))
	arm.global_position = $Hero.global_position + Vector3(0, 1.4, 0)
	told.text = "%s\n%d frames/s" % [hero.get_doing(), Engine.get_frames_per_second()]


func _look(by: Vector2) -> void:
	arm.rotation.y -= by.x
	arm.rotation.x = clampf(arm.rotation.x - by.y, -1.2, 0.3)


func _move(number: int, pressed: bool) -> void:
	var moves := hero.policy.get_moves()
	if number < 0 or number >= moves.size():
		return
	if pressed:
		hero.start_move(moves[number])
	else:
		hero.release_move(moves[number])


func _next_style() -> void:
	var styles := hero.policy.get_styles()
	hero.change_style(styles[(styles.find(hero.get_style()) + 1) % styles.size()])
