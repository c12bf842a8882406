"""The town's grammar in parts, as people edit it: a text for each style, and what they share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from ... import gallery
from ...design.errors import Fault
from ...render.town.solved import solved_text
from ...render.town.styles import STYLES, style_text, town_text

__all__ = ["joined", "located", "section_of", "sections"]

SHARED, SOLVED, WHOLE = "shared", "solved", "grammar"


def sections(text: str) -> dict[str, str]:
    """The parts of a town's grammar by name, in order; one part where it is not the town's own."""
    if text != town_text():
        return {WHOLE: text}
    written = {one.name: style_text(one.name) for one in STYLES if one.widths is None}
    return {SHARED: gallery.town(SHARED), **written, SOLVED: solved_text()}


def joined(parts: Mapping[str, str]) -> str:
    """The text of all."""
    return "\n".join(parts.values())


def section_of(style: str, parts: Mapping[str, str]) -> str:
    """The part in which a style stands."""
    return style if style in parts else SOLVED if SOLVED in parts else next(iter(parts))


def located(faults: tuple[Fault, ...], parts: Mapping[str, str], edited: str) -> Iterator[Fault]:
    """Faults of the whole text, their lines counted in the part that is edited; others say in which part they are."""
    for fault in faults:
        if fault.line is None:
            yield fault
            continue
        first, before = 0, ""
        for name, text in parts.items():
            lines = text.count("\n") + 1
            if fault.line <= first + lines:
                break
            first, before = first + lines, name
        line = fault.line - first
        if name == edited:
            yield replace(fault, line=line)
        elif before == edited and not any(map(_says, parts[name].split("\n")[: line - 1])):
            yield _at_the_end(
                fault, parts[edited]
            )  # what is missing there is noticed where the next part begins
        else:
            yield Fault(f"{name}, line {line}", fault.message, None, None, fault.excerpt)


def _says(line: str) -> bool:
    """Whether there is more in a line than a remark."""
    return bool(line.split("#", maxsplit=1)[0].strip())


def _at_the_end(fault: Fault, text: str) -> Fault:
    lines = text.rstrip().split("\n")
    excerpt = f"{lines[-1]}\n{' ' * len(lines[-1])}^"
    message = fault.message.split(";")[0] + "; the text ends here"
    return Fault(fault.place, message, len(lines), max(1, len(lines[-1])), excerpt)
