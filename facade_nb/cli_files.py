"""The files of a command: what it reads and what it writes, so that nothing is overwritten unasked.

A command says which of its arguments are paths by their types: `Source`, `Output` and `Folder`. `check` then looks at
every pair of them before anything is read or computed, and `write` writes what was computed, together.
"""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import combinations
from pathlib import Path
from stat import S_ISCHR

from .design.errors import DesignError, Fault
from .design.files import write_together
from .design.targets import Target, locate, one_file, try_out

__all__ = ["STANDARD_OUTPUT", "Folder", "Output", "Source", "check", "obj_outputs", "write"]


class Source(str):
    """The path of a file that a command reads, or of a folder of which it reads some files."""

    __slots__ = ()

    def files(self) -> Iterator[Path]:
        """The files that are read; of a folder, those whose suffix is among `suffixes`."""
        path = Path(self)
        if not path.is_dir():
            yield path
            return
        for file in path.iterdir():
            if file.suffix.lower() in self.suffixes():
                yield file

    @staticmethod
    def suffixes() -> Sequence[str]:
        """Of the files that are read in a folder."""
        return ()


class Output(str):
    """The path of a file that a command writes, or ``-`` for standard output."""

    __slots__ = ()

    @property
    def is_standard(self) -> bool:
        """Whether it is standard output."""
        return self == "-"


class Folder(str):
    """The path of a folder that a command writes files into, under names of its own. It is made where there is none."""

    __slots__ = ()


STANDARD_OUTPUT = Output("-")


def check(options: Namespace) -> None:
    """Refuse outputs that cannot be written, and those that are the same file as an input or another output.

    A command's `beside` lists files that come along with its outputs, unasked.

    Files are compared, not names. Two outputs may both go to the null device, and a terminal may be read and written.

    Raises
    ------
    DesignError
        With the argument as its place. No file has been touched.
    """
    sources = [(name, value) for name, value in vars(options).items() if isinstance(value, Source)]
    outputs = [(_option(name), value) for name, value in vars(options).items() if isinstance(value, Output)]
    outputs += options.beside(options) if "beside" in options else []
    targets = [(name, value, _target(name, value)) for name, value in outputs]
    for kind, source in sources:
        for file, read in _read(source):
            for name, value, target in targets:
                if target and one_file(target, read) and not _is_device(read):
                    what = f"the {kind}" if Path(file) == Path(source) else f"one of the {kind}"
                    message = f"expected a file other than {what}, {str(file)!r}, which would be lost"
                    raise DesignError(Fault(name, f"{message}; found {_told(value)}"))
    for (a, first, one), (b, second, two) in combinations(targets, 2):
        same = one_file(one, two) and not one.is_null if one and two else first == second
        if same:
            of_first = f" ({_told(first)})" if first != second else ""
            raise DesignError(
                Fault(b, f"expected a file other than that of {a}{of_first}; found {_told(second)}")
            )
    for _, _, target in targets:
        if target:
            try_out(target)
    folders = [(_option(name), value) for name, value in vars(options).items() if isinstance(value, Folder)]
    files = [(_option(name), Path(value)) for name, value in sources]
    files += [(name, Path(value)) for name, value in outputs if not value.is_standard]
    for name, folder in folders:
        _check_folder(name, folder, files + [(b, Path(other) / "a") for b, other in folders if b < name])


def obj_outputs(
    options: Namespace, made: Callable[[Path | None], Mapping[Path, str | bytes]]
) -> list[tuple[Output, str | bytes]]:
    """The OBJ that is asked for, with all that is written beside it.

    How many pictures it has is known only now, so they are compared with the other files of the command here.

    Parameters
    ----------
    made
        The contents by path, the OBJ first; None stands for standard output.

    Raises
    ------
    DesignError
        Where one of them is a file that the command reads, or another that it writes.
    """
    asked: Output = options.obj
    files = made(None if asked.is_standard else Path(asked))
    first, *rest = [(Output(path), content) for path, content in files.items()]
    beside = [("--obj (what is written beside it)", path) for path, _ in rest]
    check(Namespace(**{**vars(options), "beside": lambda _: beside}))
    return [(asked, first[1]), *rest]


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _check_folder(name: str, folder: Folder, files: Sequence[tuple[str, Path]]) -> None:
    """Refuse a folder that cannot be made, and one with other files of the command, which could be overwritten."""
    path = Path(folder)
    if not folder:
        raise DesignError(Fault(name, "expected the name of a folder; found none"))
    try:
        there = next(own for own in (path.absolute(), *path.absolute().parents) if own.exists())
        if not there.is_dir():
            raise DesignError(Fault(name, f"expected a folder; found the file {str(there)!r}"))
        if not os.access(there, os.W_OK | os.X_OK):
            raise DesignError(Fault(name, f"no files can be made in {str(there)!r}"))
        for other, file in files:
            if file.resolve().parent == path.resolve():
                message = (
                    f"expected a folder without that of {other} ({str(file)!r}) in it; found {str(folder)!r}"
                )
                raise DesignError(Fault(name, message.replace(f" ({str(Path(folder) / 'a')!r})", "")))
    except (OSError, RuntimeError, ValueError) as error:
        if isinstance(error, DesignError):
            raise
        told = getattr(error, "strerror", None) or str(error)
        raise DesignError(Fault(name, f"cannot be a folder: {told}; found {str(folder)!r}")) from None


def write(files: Sequence[tuple[Output, str | bytes]]) -> None:
    """Write what was computed, together (see `write_together`)."""
    number = _standard_number()
    standard = [data for path, data in files if path.is_standard and number is None]
    write_together(
        [(path, data) for path, data in files if not path.is_standard]
        + [(number, data) for path, data in files if path.is_standard and number is not None]
    )
    for data in standard:
        raw = data.encode() if isinstance(data, str) else data
        buffer = getattr(sys.stdout, "buffer", None)
        if buffer is None:
            sys.stdout.write(raw.decode(errors="replace"))
        else:
            buffer.write(raw)  # a document is UTF-8, whatever the terminal's encoding
        sys.stdout.flush()


def _standard_number() -> int | None:
    """The descriptor of standard output; None where a notebook or a test has put something else in its place."""
    if sys.stdout is None or sys.stdout is sys.__stdout__:
        return 1  # closed or not: writing will tell
    return None


def _target(name: str, path: Output) -> Target | None:
    """Where an output goes; None: to something that stands for standard output and has no descriptor."""
    number = _standard_number() if path.is_standard else None
    if path.is_standard and number is None:
        return None
    try:
        return locate(str(path) if number is None else number)
    except DesignError as error:
        raise DesignError(Fault(name, str(error))) from error


def _read(source: Source) -> Iterator[tuple[Path, Target]]:
    """The files of a source that are there; reading tells what is wrong with the others."""
    with suppress(OSError, ValueError):
        for file in source.files():
            with suppress(OSError, ValueError):
                yield file, Target(str(file), file, file.stat())


def _is_device(target: Target) -> bool:
    return target.state is not None and S_ISCHR(target.state.st_mode)


def _told(path: Output) -> str:
    return "standard output" if path.is_standard else repr(str(path))
