"""An OpenGL context in memory, without a screen or a driver: OSMesa, as moderngl asks for one."""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import Any

__all__ = ["OSMesaContext", "find_osmesa"]

_FORMAT, _RGBA, _DEPTH, _STENCIL = 0x22, 0x1908, 0x30, 0x31
_PROFILE, _CORE, _MAJOR, _MINOR = 0x33, 0x34, 0x36, 0x37
_UNSIGNED_BYTE = 0x1401
_SIDE = 16


@lru_cache(maxsize=1)
def find_osmesa() -> ctypes.CDLL | None:
    """The library, or None if there is none here that makes core contexts."""
    for name in ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"):
        try:
            library = ctypes.CDLL(name, mode=ctypes.RTLD_GLOBAL)
            make = library.OSMesaCreateContextAttribs
        except (OSError, AttributeError):
            continue
        pointer = ctypes.c_void_p
        make.restype, make.argtypes = pointer, [ctypes.POINTER(ctypes.c_int), pointer]
        library.OSMesaMakeCurrent.restype = ctypes.c_ubyte
        library.OSMesaMakeCurrent.argtypes = [pointer, pointer, ctypes.c_uint, ctypes.c_int, ctypes.c_int]
        library.OSMesaDestroyContext.restype, library.OSMesaDestroyContext.argtypes = None, [pointer]
        library.OSMesaGetCurrentContext.restype, library.OSMesaGetCurrentContext.argtypes = pointer, []
        library.OSMesaGetProcAddress.restype = pointer
        library.OSMesaGetProcAddress.argtypes = [ctypes.c_char_p]
        return library
    return None


class OSMesaContext:
    """A core context of OpenGL 3.3. Its own buffer is tiny: pictures are drawn into framebuffers.

    moderngl enters it before each use, which makes it current in this thread.
    """

    def __init__(self) -> None:
        library = find_osmesa()
        if library is None:
            raise RuntimeError("no libOSMesa")
        self._library = library
        wanted = [_FORMAT, _RGBA, _DEPTH, 0, _STENCIL, 0, _PROFILE, _CORE, _MAJOR, 3, _MINOR, 3, 0]
        self._context = library.OSMesaCreateContextAttribs((ctypes.c_int * len(wanted))(*wanted), None)
        if not self._context:
            raise RuntimeError("OSMesa makes no OpenGL 3.3 core context")
        self._buffer = ctypes.create_string_buffer(4 * _SIDE * _SIDE)
        self._bind()

    def _bind(self) -> None:
        if not self._library.OSMesaMakeCurrent(self._context, self._buffer, _UNSIGNED_BYTE, _SIDE, _SIDE):
            raise RuntimeError("OSMesaMakeCurrent failed")

    def load_opengl_function(self, name: str) -> int:
        """The address of a function of OpenGL, 0 if there is none."""
        return int(self._library.OSMesaGetProcAddress(name.encode()) or 0)

    load = load_opengl_function

    def __enter__(self) -> OSMesaContext:
        self._bind()
        return self

    def __exit__(self, *_: Any) -> None:
        pass

    def release(self) -> None:
        """Destroy the context."""
        if self._context:
            if self._library.OSMesaGetCurrentContext() == self._context:
                self._library.OSMesaMakeCurrent(None, None, 0, 0, 0)
            self._library.OSMesaDestroyContext(self._context)
            self._context = None
