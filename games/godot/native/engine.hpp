// SPDX-License-Identifier: MIT
// As much of Godot's C interface as the two classes need: values that release themselves, calls by name, and methods
// that are bound by their C++ signatures.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "gdextension_interface.h"

namespace fragmotion::godot {

/// Godot's functions that are called here, and the names that are asked for each frame; made by load_engine().
struct Engine {
  GDExtensionClassLibraryPtr library;
  GDExtensionInterfacePrintErrorWithMessage print_error;
  GDExtensionInterfaceVariantNewNil variant_new_nil;
  GDExtensionInterfaceVariantNewCopy variant_new_copy;
  GDExtensionInterfaceVariantDestroy variant_destroy;
  GDExtensionInterfaceVariantCall variant_call;
  GDExtensionInterfaceVariantGetKeyed variant_get_keyed;
  GDExtensionInterfaceVariantGetType variant_get_type;
  GDExtensionInterfaceVariantCanConvertStrict variant_can_convert;
  GDExtensionInterfaceGetVariantFromTypeConstructor from_type;
  GDExtensionInterfaceGetVariantToTypeConstructor to_type;
  GDExtensionInterfaceVariantGetPtrConstructor constructor;
  GDExtensionInterfaceVariantGetPtrDestructor destructor;
  GDExtensionInterfaceStringNewWithUtf8Chars string_new;
  GDExtensionInterfaceStringToUtf8Chars string_to_utf8;
  GDExtensionInterfaceStringNameNewWithUtf8Chars name_new;
  GDExtensionInterfacePackedByteArrayOperatorIndexConst bytes_at;
  GDExtensionInterfacePackedByteArrayOperatorIndex bytes_write_at;
  GDExtensionInterfacePackedFloat32ArrayOperatorIndex floats_at;
  GDExtensionInterfacePackedVector3ArrayOperatorIndexConst vectors_at;
  GDExtensionInterfaceClassdbConstructObject2 construct;
  GDExtensionInterfaceObjectSetInstance set_instance;
  GDExtensionInterfaceObjectGetInstanceBinding binding;
  GDExtensionInterfaceObjectSetInstanceBinding set_binding;
  GDExtensionInterfaceObjectGetInstanceFromId object_of_id;
  GDExtensionInterfaceObjectGetInstanceId id_of_object;
  GDExtensionInterfaceClassdbRegisterExtensionClass4 register_class;
  GDExtensionInterfaceClassdbRegisterExtensionClassMethod register_method;
  GDExtensionInterfaceClassdbRegisterExtensionClassProperty register_property;
  GDExtensionInterfaceClassdbUnregisterExtensionClass unregister_class;
  GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars load_help;
};
extern Engine engine;

/// Fills `engine`; false where this Godot lacks a function.
bool load_engine(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library);

/// Says what is wrong in Godot's debugger.
void complain(const char* what, const char* function);

/// A value of Godot's of a kind and a size in bytes, released with this.
template <GDExtensionVariantType Kind, std::size_t Size>
class Value {
 public:
  Value() { engine.constructor(Kind, 0)(this, nullptr); }
  Value(const Value& other) {
    const GDExtensionConstTypePtr from = &other;
    engine.constructor(Kind, 1)(this, &from);
  }
  Value& operator=(const Value& other) {
    Value copy(other);
    std::swap(bytes_, copy.bytes_);
    return *this;
  }
  ~Value() { engine.destructor(Kind)(this); }

 protected:
  struct Raw {};
  explicit Value(Raw /*not made yet*/) {}

 private:
  alignas(8) unsigned char bytes_[Size];
};

class Name : public Value<GDEXTENSION_VARIANT_TYPE_STRING_NAME, 8> {
 public:
  explicit Name(const char* text) : Value(Raw{}) { engine.name_new(this, text); }
};

class String : public Value<GDEXTENSION_VARIANT_TYPE_STRING, 8> {
 public:
  String() = default;
  explicit String(const char* text) : Value(Raw{}) { engine.string_new(this, text); }
};

using ByteArray = Value<GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY, 16>;
using FloatArray = Value<GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY, 16>;
using StringArray = Value<GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY, 16>;
using VectorArray = Value<GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, 16>;
using Object = GDExtensionObjectPtr;

struct Vector3 {
  float x, y, z;
};
struct Quaternion {
  float x, y, z, w;
};
/// Rows of the basis, and the origin.
struct Transform {
  float rows[3][3];
  Vector3 origin;
};

/// How Godot calls a type, and what it hands over for one.
template <typename T>
struct Kind;
template <>
struct Kind<bool> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_BOOL;
  using Passed = GDExtensionBool;
};
template <>
struct Kind<std::int64_t> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_INT;
  using Passed = std::int64_t;
};
template <>
struct Kind<double> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_FLOAT;
  using Passed = double;
};
template <>
struct Kind<Vector3> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_VECTOR3;
  using Passed = Vector3;
};
template <>
struct Kind<Quaternion> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_QUATERNION;
  using Passed = Quaternion;
};
template <>
struct Kind<Transform> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_TRANSFORM3D;
  using Passed = Transform;
};
template <>
struct Kind<Object> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_OBJECT;
  using Passed = Object;
};
template <>
struct Kind<String> {
  static constexpr auto type = GDEXTENSION_VARIANT_TYPE_STRING;
  using Passed = String;
};
template <GDExtensionVariantType Type, std::size_t Size>
struct Kind<Value<Type, Size>> {
  static constexpr auto type = Type;
  using Passed = Value<Type, Size>;
};

/// Anything of Godot's, released with this.
class Variant {
 public:
  Variant() { engine.variant_new_nil(this); }
  template <typename T>
  explicit Variant(const T& value) {
    typename Kind<T>::Passed passed = static_cast<typename Kind<T>::Passed>(value);
    static const auto make = engine.from_type(Kind<T>::type);
    make(this, &passed);
  }
  Variant(const Variant&) = delete;
  Variant& operator=(const Variant&) = delete;
  ~Variant() { engine.variant_destroy(this); }

  template <typename T>
  T as() const {
    static const auto make = engine.to_type(Kind<T>::type);
    typename Kind<T>::Passed passed{};
    make(&passed, const_cast<Variant*>(this));
    return static_cast<T>(passed);
  }

  /// Calls a method by its name.
  template <typename... Arguments>
  void call(const Name& method, Variant& result, const Arguments&... arguments) {
    const GDExtensionConstVariantPtr list[] = {&arguments..., nullptr};
    GDExtensionCallError error;
    engine.variant_destroy(&result);
    engine.variant_call(this, &method, list, sizeof...(arguments), &result, &error);
    if (error.error != GDEXTENSION_CALL_OK) complain("a call of Godot failed", __func__);
  }

  /// The value of a dictionary's key; `result` is nil where there is none.
  bool find(const Variant& key, Variant& result) const {
    GDExtensionBool valid = 0;
    engine.variant_destroy(&result);
    engine.variant_get_keyed(this, &key, &result, &valid);
    return valid != 0;
  }

 private:
  alignas(8) unsigned char bytes_[24];
};

/// A method of a class of ours as Godot calls it: by variants, and by pointers to what is passed.
template <auto Method>
struct Bound;
template <typename C, typename R, typename... A, R (C::*Method)(A...)>
struct Bound<Method> {
  static constexpr std::size_t count = sizeof...(A);
  static constexpr GDExtensionVariantType arguments[count + 1] = {Kind<std::decay_t<A>>::type...};

  static void call(void* /*data*/, GDExtensionClassInstancePtr self, const GDExtensionConstVariantPtr* given,
                   GDExtensionInt number, GDExtensionVariantPtr result, GDExtensionCallError* error) {
    *error = {GDEXTENSION_CALL_OK, 0, 0};
    if (number != static_cast<GDExtensionInt>(count)) {
      *error = {number < static_cast<GDExtensionInt>(count) ? GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS
                                                            : GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS,
                0, static_cast<std::int32_t>(count)};
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const GDExtensionVariantType type = engine.variant_get_type(given[i]);
      if (type != arguments[i] && engine.variant_can_convert(type, arguments[i]) == 0) {
        *error = {GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT, static_cast<std::int32_t>(i),
                  static_cast<std::int32_t>(arguments[i])};
        return;
      }
    }
    by_variants(static_cast<C*>(self), given, result, std::index_sequence_for<A...>());
  }

  static void pointer_call(void* /*data*/, GDExtensionClassInstancePtr self, const GDExtensionConstTypePtr* given,
                           GDExtensionTypePtr result) {
    by_pointers(static_cast<C*>(self), given, result, std::index_sequence_for<A...>());
  }

  /// Makes the method known under a name, and each of its arguments.
  template <typename... Names>
  static void add(const char* class_name, const char* method_name, Names... argument_names) {
    static_assert(sizeof...(Names) == count);
    const Name owner(class_name), name(method_name), none(""), called[] = {Name(argument_names)..., none};
    const String hint;
    const auto info = [&](GDExtensionVariantType type, const Name& own) {
      return GDExtensionPropertyInfo{type, const_cast<Name*>(&own),    const_cast<Name*>(&none),
                                     0,    const_cast<String*>(&hint), 6};
    };
    GDExtensionPropertyInfo list[count + 1];
    GDExtensionClassMethodArgumentMetadata metadata[count + 1];
    for (std::size_t i = 0; i < count; ++i) list[i] = info(arguments[i], called[i]);
    for (std::size_t i = 0; i < count; ++i) metadata[i] = GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE;
    GDExtensionClassMethodInfo method{};
    method.name = const_cast<Name*>(&name);
    method.call_func = &call;
    method.ptrcall_func = &pointer_call;
    method.method_flags = GDEXTENSION_METHOD_FLAGS_DEFAULT;
    method.argument_count = count;
    method.arguments_info = list;
    method.arguments_metadata = metadata;
    GDExtensionPropertyInfo returned{};
    if constexpr (!std::is_void_v<R>) {
      returned = info(Kind<R>::type, none);
      method.has_return_value = 1;
      method.return_value_info = &returned;
    }
    engine.register_method(engine.library, &owner, &method);
  }

 private:
  template <std::size_t... I>
  static void by_variants(C* self, const GDExtensionConstVariantPtr* given, GDExtensionVariantPtr result,
                          std::index_sequence<I...> /*which*/) {
    (void)given;
    if constexpr (std::is_void_v<R>) {
      (self->*Method)(static_cast<const Variant*>(given[I])->template as<std::decay_t<A>>()...);
    } else {
      const Variant made((self->*Method)(static_cast<const Variant*>(given[I])->template as<std::decay_t<A>>()...));
      engine.variant_destroy(result);
      engine.variant_new_copy(result, &made);
    }
  }

  template <std::size_t... I>
  static void by_pointers(C* self, const GDExtensionConstTypePtr* given, GDExtensionTypePtr result,
                          std::index_sequence<I...> /*which*/) {
    (void)given;
    const auto run = [&] {
      return (self->*Method)(
          static_cast<std::decay_t<A>>(*static_cast<const typename Kind<std::decay_t<A>>::Passed*>(given[I]))...);
    };
    if constexpr (std::is_void_v<R>) {
      run();
    } else {
      *static_cast<typename Kind<R>::Passed*>(result) = static_cast<typename Kind<R>::Passed>(run());
    }
  }
};

/// What of ours an object of Godot's is; null where it is none of our class library's.
template <typename C>
C* ours(Object object) {
  static const GDExtensionInstanceBindingCallbacks callbacks{
      [](void*, void*) -> void* { return nullptr; }, [](void*, void*, void*) {},
      [](void*, void*, GDExtensionBool) -> GDExtensionBool { return 1; }};
  return object == nullptr ? nullptr : static_cast<C*>(engine.binding(object, engine.library, &callbacks));
}

/// Makes a class known: C::kName, a C::kParent.
template <typename C>
void add_class() {
  struct Makes {
    static GDExtensionObjectPtr make(void* /*data*/, GDExtensionBool /*notify*/) {
      const Name own(C::kName), base(C::kParent);
      const GDExtensionObjectPtr object = engine.construct(&base);
      auto* made = new C();
      engine.set_instance(object, &own, made);
      const GDExtensionInstanceBindingCallbacks callbacks{nullptr, nullptr, nullptr};
      engine.set_binding(object, engine.library, made, &callbacks);
      return object;
    }
    static void free(void* /*data*/, GDExtensionClassInstancePtr made) { delete static_cast<C*>(made); }
  };
  const Name own(C::kName), base(C::kParent);
  GDExtensionClassCreationInfo4 info{};
  info.is_exposed = 1;
  info.create_instance_func = &Makes::make;
  info.free_instance_func = &Makes::free;
  engine.register_class(engine.library, &own, &base, &info);
}

}  // namespace fragmotion::godot
