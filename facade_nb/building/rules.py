"""The texture grammars of a building's designs as one, so that the rules of all façades are drawn in one picture."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from ..render.materials import RULE
from ..render.ruled import grammar_faults, is_rule, material_of, rule_fault
from ..render.texture.renaming import renamed, renamed_rule

__all__ = ["Rules"]


@dataclass(frozen=True, slots=True)
class Rules:
    """Grammars in one text. The names of the first one stay; those of others have an ending.

    Attributes
    ----------
    text
        All that can be drawn.
    endings
        By grammar: what its names end with there.
    """

    text: str = ""
    endings: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, grammars: Iterable[str]) -> Rules:
        """Of some grammars; one with a fault in it is left out, and so is an empty one."""
        sound = [own for own in dict.fromkeys(grammars) if own.strip() and not grammar_faults(own)]
        ending = next(word for word in _endings() if not any(word in own for own in sound))
        endings = {own: f"{ending}{k}" if k > 1 else "" for k, own in enumerate(sound, 1)}
        text = "\n".join(renamed(own, end) if end else own for own, end in endings.items())
        return cls(text, endings)

    def material(self, grammar: str, name: str) -> str:
        """What a material of a design with that grammar is called; a rule that cannot be drawn is a colour."""
        if not is_rule(name):
            return name
        if grammar not in self.endings or rule_fault(grammar, name, "") is not None:
            return material_of(grammar, name).fill
        ending = self.endings[grammar]
        return RULE + renamed_rule(grammar, name.removeprefix(RULE), ending) if ending else name


def _endings() -> Iterable[str]:
    """What no grammar is likely to have in it."""
    return ("_of_wall_", *(f"_of_wall_{k}_" for k in range(2, 1000)))
