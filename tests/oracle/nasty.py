"""Designs that no solver can finish: many unbounded counters, alternatives, layers, tiny letters on a huge canvas."""

from __future__ import annotations

import random
from typing import Any

from facade_nb.design import Design

from .designs import design

__all__ = ["NASTY", "nasty"]

_SIX = "A^a B^b C^c D^d E^e F^f"
_SIZES = {name: 0.3 + 0.07 * n for n, name in enumerate("ABCDEF")}
_CLEAR: dict[str, Any] = {name: {"size": size, "opaque": False} for name, size in _SIZES.items()}
_TURNS = [" ".join(f"{'ABCDEF'[(i + j) % 6]}^{'abcdef'[j]}" for j in range(6)) for i in range(6)]
_FLOORS = ["A(BA)^k", "C^m", "A B D A^l", "(CB)^n", "D^o A", "B(CB)^p"]

NASTY: dict[str, Design] = {
    "six patterns of six counters": design(
        _SIZES, {f"p{i}": text for i, text in enumerate(_TURNS)}, [f"p{i}" for i in range(6)], 6.0
    ),
    "six counters, no layout": design(_CLEAR | {"Z": 0.01}, {"a": _SIX, "z": f"{_SIX} Z"}, ["a", "z"], 6.0),
    "40 layers": design(
        {"A": 1.0, "B": 0.8, "C": 0.3, "D": 1.1},
        {f"p{i}": text for i, text in enumerate(_FLOORS * 7)},
        [f"p{i}" for i in range(40)],
        6.0,
    ),
    "1000 m": design({"A": 1.0, "B": 0.9}, {"a": "A^k", "b": "(AB)^l"}, ["a", "b"], 1000.0),
    "1000 m, three counters": design(
        {"A": 1.0, "B": 0.9, "C": 1.1}, {"a": "A^k B^l C^m", "b": "(AB)^l C^n"}, ["a", "b"], 1000.0
    ),
    "millimetres": design({"A": 0.001}, {"a": "A^k"}, ["a"], 1000.0),
    "words of thousands of letters": design(
        {"A": 0.1, "B": 0.11}, {"a": "(AB)^4000", "b": "A^k"}, ["a", "b"], 900.0
    ),
    "alternatives": design({"A": 1.0, "B": 0.9}, {"a": "(A|B)" * 14}, ["a"], 14.0),
    "alternatives and a counter": design(
        {"A": 1.0, "B": 0.9}, {"a": "(A|B)" * 12 + "A^k"}, ["a"], 1000.0
    ),
    "counters on both axes": design(
        {"A": 1.0, "P": 1.0, "B": 0.9}, {"a": "A^k B^l", "p": "P^k B^l"}, [("a", "g", "p")], 100.0, 50.0
    ),
    "20 groups": design(
        {"A": 1.0, "B": 0.7},
        {f"p{i}": f"A^k B^{{l{i}}}" for i in range(20)},
        [(f"p{i}", f"g{i}") for i in range(20)],
        50.0,
    ),
    "a million cells": design({"A": 0.1, "P": 0.1}, {"a": "A^k", "p": "P^k"}, [("a", "g", "p")], 100.0, 100.0),
    "unsized letters": design(
        {"A": 1.0, "B": 0.7, "C": 0.3},
        {
            "a": "e a f; a := A^k",
            "b": "e c f c g; c := (BC)^l",
            "c": "(AB)^m",
            "d": "f m g m h m e; m := B^n A",
        },
        ["a", "b", "d", "c"],
        30.0,
    ),
}  # fmt: skip

_PARTS = [
    "{s}^{c}",
    "({s}{t})^{c}",
    "({s}|{t})",
    "({s}{t})^~{c}",
    "{s}({t}{s})^{c}",
    "({s}{t}{s})^.{c}",
    "{s}",
]


def nasty(seed: int) -> Design:
    """A random one."""
    draw = random.Random(seed)
    symbols: dict[str, Any] = {}
    for name in "ABCDEF":
        symbols[name] = {"size": round(draw.choice([0.01, 0.1, 1.0]) * draw.uniform(0.5, 2.0), 3)}
        if draw.random() < 0.3:
            symbols[name]["opaque"] = False
        if draw.random() < 0.15:
            symbols[name]["attached"] = True
    layers = draw.choice([1, 2, 4, 8, 40])
    patterns: dict[str, str] = {}
    for n in range(layers):
        parts = [
            draw.choice(_PARTS).format(
                s=draw.choice("ABCDEF"),
                t=draw.choice("ABCDEF"),
                c=f"{{{draw.choice('klmnop')}{draw.choice(['', n])}}}",
            )
            for _ in range(draw.randint(1, 6))
        ]
        text = "".join(parts)
        patterns[f"p{n}"] = (
            draw.choice([text, f"u x v; x := {text}", f"u x u x u; x := {text}"]) if n else text
        )
    groups = draw.choice(["g", "gh"])
    return design(
        symbols,
        patterns,
        [(f"p{n}", draw.choice(groups)) for n in range(layers)],
        draw.choice([1.0, 10.0, 100.0, 1000.0]),
    )
