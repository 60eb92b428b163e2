// SPDX-License-Identifier: MIT
// The tag by which exceptions are told apart in WebAssembly: Godot's own templates are built without exceptions and
// have none, so that a library that asks for it would not load.
__asm__(".tagtype __cpp_exception i32\n.globl __cpp_exception\n__cpp_exception:\n");
