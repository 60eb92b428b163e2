// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace fragmotion::godot {

Engine engine;

namespace {

template <typename Function>
bool find(GDExtensionInterfaceGetProcAddress get, const char* name, Function& function) {
  function = reinterpret_cast<Function>(get(name));
  return function != nullptr;
}

}  // namespace

bool load_engine(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library) {
  engine.library = library;
  return find(get, "print_error_with_message", engine.print_error) &&
         find(get, "variant_new_nil", engine.variant_new_nil) &&
         find(get, "variant_new_copy", engine.variant_new_copy) &&
         find(get, "variant_destroy", engine.variant_destroy) && find(get, "variant_call", engine.variant_call) &&
         find(get, "variant_get_keyed", engine.variant_get_keyed) &&
         find(get, "variant_get_type", engine.variant_get_type) &&
         find(get, "variant_can_convert_strict", engine.variant_can_convert) &&
         find(get, "get_variant_from_type_constructor", engine.from_type) &&
         find(get, "get_variant_to_type_constructor", engine.to_type) &&
         find(get, "variant_get_ptr_constructor", engine.constructor) &&
         find(get, "variant_get_ptr_destructor", engine.destructor) &&
         find(get, "string_new_with_utf8_chars", engine.string_new) &&
         find(get, "string_to_utf8_chars", engine.string_to_utf8) &&
         find(get, "string_name_new_with_utf8_chars", engine.name_new) &&
         find(get, "packed_byte_array_operator_index_const", engine.bytes_at) &&
         find(get, "packed_byte_array_operator_index", engine.bytes_write_at) &&
         find(get, "packed_float32_array_operator_index", engine.floats_at) &&
         find(get, "packed_vector3_array_operator_index_const", engine.vectors_at) &&
         find(get, "classdb_construct_object2", engine.construct) &&
         find(get, "object_set_instance", engine.set_instance) &&
         find(get, "object_get_instance_binding", engine.binding) &&
         find(get, "object_set_instance_binding", engine.set_binding) &&
         find(get, "object_get_instance_from_id", engine.object_of_id) &&
         find(get, "object_get_instance_id", engine.id_of_object) &&
         find(get, "classdb_register_extension_class4", engine.register_class) &&
         find(get, "classdb_register_extension_class_method", engine.register_method) &&
         find(get, "classdb_register_extension_class_property", engine.register_property) &&
         find(get, "classdb_unregister_extension_class", engine.unregister_class) &&
         find(get, "editor_help_load_xml_from_utf8_chars", engine.load_help);
}

void complain(const char* what, const char* function) { engine.print_error(what, what, function, "fragmotion", 0, 1); }

}  // namespace fragmotion::godot
