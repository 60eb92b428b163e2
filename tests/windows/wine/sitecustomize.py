# SPDX-License-Identifier: MIT
"""Run by Windows' Pythons when they start: machine code for what Wine has by name only, or answers wrongly."""

import ctypes

# By name only in Debian 12's Wine, where a call ends the program: NumPy 2 calls the first two while it is imported,
# Python 3.13 the third to tell which Windows it is on.
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


def _processors() -> int:
    kernel, mask, system = ctypes.windll.kernel32, ctypes.c_size_t(), ctypes.c_size_t()
    kernel.GetProcessAffinityMask(ctypes.c_void_p(-1), ctypes.byref(mask), ctypes.byref(system))
    return bin(mask.value).count("1")


# Where /sys is not mounted, Debian 13's Wine knows of no group of processors. Blender's task pool (oneTBB) then reads
# the number of processors from before its list of groups, and starts threads until no file can be opened.
if not ctypes.windll.kernel32.GetActiveProcessorGroupCount():
    for _name, _answer in {"GetActiveProcessorGroupCount": 1, "GetActiveProcessorCount": _processors()}.items():
        _fill_in("kernel32", _name, b"\xb8" + _answer.to_bytes(4, "little") + b"\xc3")  # mov eax, answer; ret
