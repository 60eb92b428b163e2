// SPDX-License-Identifier: MIT
// Where Godot enters.
#include "help.hpp"
#include "player.hpp"

#ifdef _WIN32
#define FRAGMOTION_ENTRY __declspec(dllexport)
#else
#define FRAGMOTION_ENTRY __attribute__((visibility("default")))
#endif

namespace fragmotion::godot {

namespace {

void begin(void* /*data*/, GDExtensionInitializationLevel level) {
  if (level == GDEXTENSION_INITIALIZATION_SCENE) {
    Policy::add();
    Players::add();
    Player::add();
  }
  if (level == GDEXTENSION_INITIALIZATION_EDITOR) {
    for (const char* page : kHelp) engine.load_help(page);
  }
}

void end(void* /*data*/, GDExtensionInitializationLevel level) {
  if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
  for (const char* name : {Player::kName, Players::kName, Policy::kName}) {
    const Name own(name);
    engine.unregister_class(engine.library, &own);
  }
}

}  // namespace

}  // namespace fragmotion::godot

extern "C" FRAGMOTION_ENTRY GDExtensionBool fragmotion_godot(GDExtensionInterfaceGetProcAddress get,
                                                             GDExtensionClassLibraryPtr library,
                                                             GDExtensionInitialization* initialization) {
  if (!fragmotion::godot::load_engine(get, library)) return 0;
  initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
  initialization->userdata = nullptr;
  initialization->initialize = &fragmotion::godot::begin;
  initialization->deinitialize = &fragmotion::godot::end;
  return 1;
}
