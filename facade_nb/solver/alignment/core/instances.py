"""Instances of the compiled search in WebAssembly, and whose they are.

The headers beside this file are built into `core.wasm` by `make core` and run by wasmtime.

A `session` has an instance to itself, got when it is first needed and given back when the session ends, whatever still
refers to it then: nothing waits for the garbage collector. `solve` and `align` are sessions.
"""

from __future__ import annotations

import atexit
import gc
import threading
from array import array
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from math import inf
from pathlib import Path as File
from struct import Struct, unpack, unpack_from
from typing import Any
from weakref import WeakKeyDictionary, WeakSet, finalize, ref

from ... import tuning
from ...budget import Stopped
from ...effort import Effort, spend
from ..group import Group
from .signals import Deferred

__all__ = [
    "DIVES",
    "ENDED",
    "LEFT",
    "PAUSED",
    "PRICE",
    "SEARCH",
    "UNLIMITED",
    "Core",
    "NoRoom",
    "Session",
    "available",
    "instance",
    "may_be_compiled",
    "session",
    "start_afresh",
    "without",
]

_MODULE = File(__file__).parent / "core.wasm"
UNLIMITED = float(2**53)
"""Where there is no limit: the largest whole number up to which a double holds every one."""

_BAD_FILE = 8
ENDED, PAUSED, LEFT, PRICE = range(4)
"""How a call of the compiled search came back; `core.cpp` has the same in its `answer`."""

SEARCH, DIVES, _GROUP = range(3)
"""What an instance holds for its owners."""

_BOX = [Struct(f"<{n}d") for n in range(9)]


@cache
def available() -> bool:
    """Whether the compiled search can be used."""
    try:
        import wasmtime  # noqa: F401
    except (ImportError, OSError, RuntimeError):  # not installed, or not made for this machine
        return False
    return _MODULE.is_file()


@cache
def _module() -> tuple[Any, Any]:
    """The engine and the module: made into machine code once, which wasmtime keeps in the user's cache if it can."""
    import wasmtime

    config = wasmtime.Config()
    # By default gigabytes are reserved for each instance, so that no access need be checked. Each is, with less; which
    # costs nothing that can be measured as long as what a processor reads ahead in vain may be anything: here it may,
    # for all code and data are our own.
    config.memory_reservation = tuning.INSTANCE_BYTES
    config.memory_reservation_for_growth = 0
    config.memory_guard_size = tuning.GUARD_BYTES
    config.memory_may_move = False
    config.cranelift_flag_set("enable_heap_access_spectre_mitigation", "false")
    with suppress(
        wasmtime.WasmtimeError
    ):  # no place for a cache: then it takes a fifth of a second in each process
        config.cache = True
    engine = wasmtime.Engine(config)
    return engine, wasmtime.Module.from_file(engine, str(_MODULE))


class NoRoom(Exception):
    """There is no memory for an instance."""


class _Instance:
    """An instance of the module: its functions and its memory. One `Core` at a time has it.

    Raises what wasmtime raises where there is no memory for it.

    Attributes
    ----------
    owner
        Who is asked whether to go on.
    """

    def __init__(self) -> None:
        import wasmtime

        engine, module = _module()
        self.owner: ref[Core] | None = None
        self.store: Any = wasmtime.Store(engine)
        try:
            self.store.set_limits(memory_size=tuning.INSTANCE_BYTES)
            linker = wasmtime.Linker(engine)
            me = ref(self)  # wasmtime keeps what it may call until the store is gone

            def check() -> int:
                own = me()
                core = None if own is None or own.owner is None else own.owner()
                return 1 if core is None else core.asked()

            linker.define_func("host", "check", wasmtime.FuncType([], [wasmtime.ValType.i32()]), check)
            for wanted in module.imports:  # the C++ library could write a message; it has nowhere to write to
                if wanted.module != "host":
                    linker.define_func(wanted.module, str(wanted.name), wanted.type, lambda *_: _BAD_FILE)
            exports: Any = linker.instantiate(self.store, module).exports(self.store)
            self.functions: dict[str, Any] = {
                str(own.name): exports[str(own.name)] for own in module.exports if str(own.name) != "memory"
            }
            self.memory: Any = exports["memory"]
            self.functions["_initialize"](self.store)
            self.box = int(self.functions["box_at"](self.store))
        except BaseException:
            self.store.close()
            raise

    @property
    def size(self) -> int:
        """Its memory, in bytes."""
        return int(self.memory.data_len(self.store))

    def close(self) -> None:
        """Give its memory back."""
        self.store.close()


_idle: list[_Instance] = []
"""At most one, empty and small: the next session has its pages already, where those of a new one must be got."""


class Core:
    """An instance as a session has it, used by one thread.

    Raises
    ------
    NoRoom
        Where no memory can be had.
    """

    def __init__(self) -> None:
        import wasmtime

        self.busy = self.broken = self.closed = False
        try:
            own = self._instance = _idle.pop()
        except IndexError:
            try:
                own = self._instance = _Instance()
            except (wasmtime.WasmtimeError, MemoryError, OSError) as error:
                self.closed = self.broken = True
                raise NoRoom from error
        own.owner = ref(self)
        self._store, self._functions, self._memory, self._box = own.store, own.functions, own.memory, own.box
        self._check: Callable[[], None] | None = None
        self._raised: BaseException | None = None
        self._symbols: dict[str, int] = {}
        self._groups: WeakKeyDictionary[Group, float] = WeakKeyDictionary()
        self._alive: set[tuple[int, float]] = set()
        self._dead: list[tuple[int, float]] = []
        self.told: tuple[float, ...] = ()
        self._deferred = Deferred()
        self._room = self._at = 0
        self._functions["begin"](self._store)
        _cores.add(self)

    def close(self) -> None:
        """Let go of everything at once; what still refers to it comes to an end where it is gone on with."""
        if self.closed:
            return
        own = self._instance
        kept = not (self.busy or self.broken or _idle) and self.size <= tuning.IDLE_INSTANCE
        if kept:
            self._dead = list(self._alive)
            self._bury()
        self.closed = self.broken = True
        if kept and not _idle:
            own.owner = None
            _idle.append(own)
        else:
            own.close()

    @property
    def size(self) -> int:
        """Its memory, in bytes."""
        return self._instance.size

    @property
    def empty(self) -> bool:
        """Nothing is left in it."""
        self._bury()
        return not self._alive

    @property
    def large(self) -> bool:
        """It takes much memory, and nothing is left in it."""
        return self.empty and self.size > tuning.LARGE_INSTANCE

    def _call(self, name: str, *arguments: float) -> None:
        """Call a function, its arguments in the box: to wasmtime each parameter and result takes microseconds."""
        if arguments:
            box = self._memory.get_buffer_ptr(self._store, 64, self._box)
            _BOX[len(arguments)].pack_into(box, 0, *arguments)
        self._functions[name](self._store)

    def _answer(self) -> tuple[float, ...]:
        return _BOX[6].unpack_from(self._memory.get_buffer_ptr(self._store, 48, self._box))

    def _starved(self) -> bool:
        """Whether it has come to an end as there was no memory left."""
        return bool(_BOX[8].unpack_from(self._memory.get_buffer_ptr(self._store, 64, self._box))[7])

    def ask(self, check: Callable[[], None] | None, name: str, *arguments: float) -> tuple[float, ...]:
        """Call what may take long, and read its answer; what `check` raises meanwhile is raised afterwards."""
        import wasmtime

        if self.closed:
            self.told = ()
            raise Stopped(full=True)
        effort = check if isinstance(check, Effort) else None
        if effort is not None and effort.left < inf:
            self._call("allow", max(0.0, effort.left) * tuning.WORK_PER_SECOND)
        self._raised, self.busy, self.told = None, True, ()
        self._check = check if effort is None else effort.look
        try:
            with self._deferred:
                self._call(name, *arguments)
        except wasmtime.Trap:
            self.broken = True
            if not self._starved():
                raise
            raise Stopped(full=True) from None  # out of memory before anybody looked
        finally:
            self._check, self.busy = None, False
        raised, self._raised = self._raised, None
        *told, work = self._answer()
        self.told = tuple(told)
        spend(check, work / tuning.WORK_PER_SECOND)
        if raised is not None:
            raise raised
        if effort is not None and effort.left < 0:
            raise Stopped
        return self.told

    def asked(self) -> int:
        """Whether the search has to end: what the instance asks now and then."""
        if self._deferred.came:
            return 1
        if self._check is None:
            return 0
        try:
            self._check()
        except BaseException as stop:
            self._raised = stop
            return 1
        return 0

    def groups(self, groups: Sequence[Group]) -> float:
        """Pass some groups as arguments of the next call; how many."""
        numbers = array("d")
        for group in groups:
            number = self._groups.get(group)
            if number is None:
                self._put(_told(group, self._symbols))
                self._call("group_new")
                number = self._groups[group] = self._answer()[0]
                self.owned(group, _GROUP, number)
            numbers.append(number)
        self._put(numbers)
        return len(numbers)

    def owned(self, owner: object, kind: int, number: float) -> None:
        """Let go of something when its owner is no more."""
        if len(self._dead) >= tuning.LET_GO or self.size > tuning.LARGE_INSTANCE // 4:
            self._bury()
        self._alive.add((kind, number))
        finalize(owner, self._dead.append, (kind, number)).atexit = False

    def _bury(self) -> None:
        """Let go of what has no owner any more: not at once, as that may happen in any thread, at any time."""
        if not self._dead or self.busy or self.broken:
            return
        count = len(self._dead)  # more may come meanwhile
        dead = sorted(self._dead[:count])  # searches before the groups that they refer to
        del self._dead[:count]
        self._alive.difference_update(dead)
        self._put(array("d", [number for own in dead for number in own]))
        self._call("free_all", len(dead))

    def integers(self, at: float) -> tuple[int, ...]:
        """Numbers in its memory, before which stands how many they are."""
        begin = int(at)
        (count,) = unpack("<i", self._memory.read(self._store, begin, begin + 4))
        return unpack_from(f"<{count}i", self._memory.read(self._store, begin + 4, begin + 4 + 4 * count))

    def _put(self, numbers: array[float]) -> None:
        if len(numbers) > self._room:
            self._room = 2 * len(numbers)
            self._call("numbers_at", self._room)
            self._at = int(self._answer()[0])
        self._memory.write(self._store, numbers.tobytes(), self._at)


def _told(group: Group, symbols: dict[str, int]) -> array[float]:
    """A group as numbers, in the order in which `Group::read` takes them."""
    objective = group.objective
    out = array(
        "d",
        (
            len(group.bands), group.canvas, group.tolerance, group.share, group.under,
            objective.empty, objective.loose, objective.fit, objective.plain,
            group.waived, group.stiff, group.tied, group.tall,
            -1 if group.reference is None else group.reference,
        ),
    )  # fmt: skip
    for band, weight, guards in zip(group.bands, group.weights, group.guards, strict=True):
        out.extend((weight, len(guards), *guards, band.cuts, len(band.letters)))
        for letter in band.letters:
            size = letter.size
            out.extend(
                (
                    0.0 if size is None else size,
                    symbols.setdefault(letter.symbol, len(symbols)),
                    (size is not None)
                    + 2 * letter.transparent
                    + 4 * letter.opaque
                    + 8 * letter.attached
                    + 16 * letter.unoccludable
                    + 32 * band.is_free(letter),
                )
            )
        out.extend(band.soft_rest)
        out.extend(band.gap_rest)
    return out


class Session:
    """What one call of the solver has of the compiled search.

    Attributes
    ----------
    without
        There was no room for an instance at some time, and the search in Python took its place.
    """

    def __init__(self) -> None:
        self.core: Core | None = None
        self.without = False

    def get(self) -> Core:
        """Its instance, which has room."""
        core = self.core
        if core is not None and core.busy:
            return _made()  # `check` searches something itself
        if core is None or core.broken or core.large:
            self.core = None
            if core is not None:
                core.close()
            core = self.core = _made()
        return core

    def close(self) -> None:
        """Let go of its instance."""
        core, self.core = self.core, None
        if core is not None and not core.busy:
            core.close()


class _Local(threading.local):
    """What a thread has: its sessions, the last one first; below them one that ends with the thread."""

    def __init__(self) -> None:
        self.sessions = [Session()]


_local = _Local()
_cores: WeakSet[Core] = WeakSet()


@contextmanager
def session() -> Iterator[Session]:
    """Let go of all that is compiled when the block ends."""
    own = Session()
    _local.sessions.append(own)
    try:
        yield own
    finally:
        _local.sessions.remove(own)
        own.close()


def _made() -> Core:
    """A new instance. Where there is no room, what nobody needs any more is let go of first."""
    try:
        return Core()
    except NoRoom:
        gc.collect()
        idle = _local.sessions[0].core
        if idle is not None and not idle.busy and idle.empty:
            _local.sessions[0].close()
        return Core()


@atexit.register
def _close() -> None:
    for core in list(_cores):
        core.close()
    while _idle:
        _idle.pop().close()
    if _module.cache_info().currsize:
        engine, module = _module()
        module.close()
        engine.close()


def instance() -> Core:
    """The instance of this thread's session."""
    return _local.sessions[-1].get()


def start_afresh() -> bool:
    """Have the next searches begin with little memory, if those until now have taken much; whether so.

    That of the searches until now is given back at once: they cannot be gone on with.
    """
    own = _local.sessions[-1]
    core = own.core
    if core is None or core.busy or (not core.broken and core.size <= tuning.LARGE_INSTANCE):
        return False
    own.close()
    return True


def may_be_compiled() -> bool:
    """Where there was no room for an instance there will be none until the session ends."""
    return available() and not _local.sessions[-1].without


def without() -> None:
    """Go on without the compiled search until the session ends: there was no room for an instance."""
    _local.sessions[-1].without = True
