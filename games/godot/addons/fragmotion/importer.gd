# SPDX-License-Identifier: MIT
@tool
extends EditorImportPlugin
## Makes a FragmotionPolicy of a .policy file.


func _get_importer_name() -> String:
	return "fragmotion.policy"


func _get_visible_name() -> String:
	return "Fragmotion Policy"


func _get_recognized_extensions() -> PackedStringArray:
	return ["policy"]


func _get_save_extension() -> String:
	return "res"


func _get_resource_type() -> String:
	return "FragmotionPolicy"


func _get_priority() -> float:
	return 1.0


func _get_import_order() -> int:
	return 0


func _get_preset_count() -> int:
	return 0


func _get_import_options(_path: String, _preset: int) -> Array[Dictionary]:
	return []


func _import(source: String, target: String, _options: Dictionary, _variants: Array[String], _files: Array[String]) -> Error:
	var policy := FragmotionPolicy.new()
	policy.data = FileAccess.get_file_as_bytes(source)
	if not policy.is_valid():
		push_error("%s: no policy that this version of Fragmotion reads" % source)
		return ERR_FILE_UNRECOGNIZED
	return ResourceSaver.save(policy, "%s.%s" % [target, _get_save_extension()], ResourceSaver.FLAG_COMPRESS)
