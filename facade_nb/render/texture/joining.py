"""Several grammars as one, so that one texture and one image of tiles serve all that is in a scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .atlas import Tiles
from .grammar import Grammar, shipped
from .operators import Kind, Param
from .program import Rule, Source, Value

__all__ = ["joined"]


@lru_cache(maxsize=4)
def joined(*grammars: Grammar) -> tuple[Grammar, tuple[int, ...]]:
    """One grammar that holds the rules of all, those of each behind those of the one before; and where each begins.

    Names of rules may be there several times: ask for rules by their numbers.
    """
    if len(grammars) == 1:
        return grammars[0], (0,)
    sets = [own.tiles if own.tiles is not None or not own.named else shipped() for own in grammars]
    several = len({id(own) for own in sets if own is not None}) > 1
    rules: list[Rule] = []
    firsts = []
    for k, own in enumerate(grammars):
        firsts.append(len(rules))
        rules += [_moved(rule, len(rules), f"{k}:" if several else "") for rule in own.rules]
    tiles: Tiles | None = _Sets(sets) if several else next((own for own in sets if own is not None), None)
    return Grammar(tuple(rules), (), (), "", tiles), tuple(firsts)


def _moved(rule: Rule, by: int, prefix: str) -> Rule:
    """A rule whose neighbours stand so much further on, its tiles renamed."""

    def of(param: Param, value: Value) -> Value:
        if isinstance(value, Source):
            return replace(value, tile=prefix + value.tile) if value.tile else value
        return int(value) + by if param.kind is Kind.RULE else value

    fixed = tuple(of(param, value) for param, value in zip(rule.operator.fixed, rule.fixed, strict=True))
    parts = tuple(
        tuple(of(param, value) for param, value in zip(rule.operator.part, part, strict=True))
        for part in rule.parts
    )
    return replace(rule, fixed=fixed, parts=parts)


class _Sets:
    """Tiles of several sets: ``1:brick`` is that of the second one."""

    def __init__(self, sets: Sequence[Tiles | None]) -> None:
        self._sets = sets

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(
            f"{k}:{name}" for k, own in enumerate(self._sets) if own is not None for name in own.names
        )

    def mips(self, name: str) -> Sequence[NDArray[np.float32]]:
        own, tile = self._of(name)
        return own.mips(tile)

    def relief(self, name: str) -> Any:
        own, tile = self._of(name)
        return own.relief(tile) if hasattr(own, "relief") else None

    def _of(self, name: str) -> tuple[Any, str]:
        number, _, tile = name.partition(":")
        return self._sets[int(number)], tile
