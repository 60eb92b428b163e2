# SPDX-License-Identifier: MIT
"""Run by Windows' Pythons when they start: machine code for what Debian 12's Wine has by name only, where a call ends
the program. NumPy 2 calls the first two while it is imported, Python 3.13 the third to tell which Windows it is on."""

import ctypes

_CODE = {
    ("ucrtbase", "crealf"): "66 0f 6e c1 c3",  # movd xmm0, ecx; ret (a complex float comes in rcx)
    ("ucrtbase", "cimagf"): "48 c1 e9 20 66 0f 6e c1 c3",  # shr rcx, 32; movd xmm0, ecx; ret
    ("propsys", "VariantToString"): "b8 01 40 00 80 c3",  # mov eax, E_NOTIMPL; ret
}
_EXECUTE_AND_WRITE = 0x40


def _fill_in(library: str, name: str, code: bytes) -> None:
    address = ctypes.cast(getattr(ctypes.WinDLL(library), name), ctypes.c_void_p)
    before = ctypes.c_uint32()
    ctypes.windll.kernel32.VirtualProtect(address, ctypes.c_size_t(len(code)), _EXECUTE_AND_WRITE, ctypes.byref(before))
    ctypes.memmove(address, code, len(code))


for (_library, _name), _code in _CODE.items():
    _fill_in(_library, _name, bytes.fromhex(_code))
