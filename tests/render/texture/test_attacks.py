"""Texts, numbers and arguments from hostile hands: they work, or are refused with a place and in a few lines."""

from __future__ import annotations

import unicodedata
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.cli import main
from facade_nb.design.errors import DesignError, GrammarError
from facade_nb.render import Grammar
from facade_nb.render.texture import checks, findings, syntax
from facade_nb.render.texture.picture import rules_seen
from facade_nb.render.texture.view import Sight

from .figure_12 import FIGURE_12

Said = pytest.CaptureFixture[str]
A = "\nA -> Mat(Color, 0, 1, 1, 1, 1)"
NUMBERS = ["1e400", "-1e400", "-0", "nan", "inf", "Infinity", "1e-400", "9" * 5000, "0." + "0" * 400 + "1"]
NUMBERS += [
    "1e999999999999",
    "1e-999999999999",
    "16777216",
    "2.5",
    "1e308*10",
    "1e308*10-1e308*10",
    "1e300/1e-300",
]
NUMBERS += ["0/0", "5e-324", "1_000", "0x10", "1e", "²", "65520", "- - -1", "1/3"]
PLACES = [
    "S -> Layer(A, Skip2)\nSkip2 -> Skip({0})",
    "S -> RepeatX({0}, A)",
    "S -> SplitX(Rel, {0}, A, Abs, {0}, A)",
    "S -> Rand({0}, {0}, A, 1, A)",
    "S -> RandUni({0}, A)",
    "S -> Mat(Color, {0}, {0}, {0}, {0}, {0})",
    "S -> Mat(Color, Rep:wall1, {0}, {0}, {0}, {0})",
    "S -> MatAlpha(Color, Fit:wall1, 0, 0, 1, 1, Fit:wall1, {0}, {0}, 1, {0})",
    "S -> Intrusion({0}, A, A, A, A, A)",
    "S -> Layer(A, B)\nB -> SkipMask(Fit:mask-arch, {0}, {0})",
    "x = {0}\nS -> RepeatX(x, A)",
    "P(x) -> RepeatX(x, A)\nS -> Layer(P({0}))",
    "namespace n {{ x = 1\nS -> RepeatX(x, A) }}\nnamespace m = n(x = {0})",
]


@pytest.fixture(autouse=True)
def _quiet() -> Iterator[None]:
    with warnings.catch_warnings(), np.errstate(over="raise", invalid="raise", divide="raise"):
        warnings.simplefilter("error")
        yield


def tried(text: str) -> Grammar | GrammarError:
    """The grammar, which then draws, or why not: every fault with its place, all of them in a few lines."""
    try:
        grammar = Grammar.parse(text)
        grammar.evaluate([(0.5, 0.5), (1.5, 0.1)], (2, 1))
    except GrammarError as error:
        assert all(fault.line and fault.column for fault in error.faults)
        assert len(str(error)) < 10_000
        return error
    return grammar


@pytest.mark.parametrize("place", PLACES)
def test_numbers_out_of_all_bounds(place: str) -> None:
    for number in NUMBERS:
        found = tried(place.format(number) + A)
        if number in ("1e400", "-1e400", "nan", "inf", "1_000", "0/0", "1e308*10", "0x10", "1e300/1e-300"):
            assert isinstance(found, GrammarError), number


class TestChains:
    @pytest.mark.parametrize("backwards", [False, True])
    def test_settings(self, backwards: bool) -> None:
        lines = [f"a{k} = a{k + 1}" for k in range(9000)]
        lines = ["a9000 = 1", *reversed(lines)] if backwards else [*lines, "a9000 = 1"]
        found = tried("\n".join(["S -> RepeatX(a0, A)", *lines]) + A)
        assert isinstance(found, Grammar) and found.rules[0].value("v") == 1

    def test_settings_in_a_circle_or_at_fault(self) -> None:
        lines = "\n".join(f"a{k} = a{k + 1} + a{k + 1}" for k in range(400))
        for last, message in (("a0", "needs itself for its own value"), ("zzz", "there is no rule 'zzz'")):
            found = tried(f"S -> RepeatX(a0, A)\n{lines}\na400 = {last}{A}")
            assert isinstance(found, GrammarError) and message in str(found) and len(found.faults) == 1

    def test_sums(self) -> None:
        found = tried(f"S -> RepeatX({'0.01 + ' * 50_000} 1, A)" + A)
        assert isinstance(found, Grammar) and found.rules[0].value("v") == pytest.approx(501)

    def test_defaults(self) -> None:
        """Each stands twice in the one before: there are few of them all the same."""
        twice = "\n".join(f"R{k}(p = R{k + 1}, q = R{k + 1}) -> Layer(p)" for k in range(80))
        assert isinstance(tried(f"S -> Layer(R0)\n{twice}\nR80 -> Layer(A){A}"), Grammar)
        long = "\n".join(f"R{k}(p = R{k + 1}) -> Layer(p)" for k in range(2000))
        assert "is needed by more than" in str(tried(f"S -> Layer(R0)\n{long}\nR2000 -> Layer(A){A}"))
        assert "this default needs itself" in str(tried("S -> Layer(R)\nR(p = R) -> Layer(p)" + A))

    def test_arguments_that_double(self) -> None:
        lines = "\n".join(f"r{k} = P(r{k + 1}, r{k + 1})" for k in range(9))
        found = tried(f"S -> Layer(r0)\nP(x, y) -> RandUni(0, x, y)\n{lines}\nr9 = A{A}")
        assert isinstance(found, Grammar) and max(len(rule.name) for rule in found.rules) < 200

    def test_copies_of_namespaces(self) -> None:
        rules = "\n".join(f"A{k} -> Skip(0)" for k in range(3000))
        copies = "\n".join(f"namespace m{k} = n" for k in range(3000))
        assert "more than 20000 rules" in str(tried(f"namespace n {{\n{rules}\n}}\n{copies}"))

    def test_parentheses(self) -> None:
        assert isinstance(tried("S -> Skip(" + "(" * 40 + "1" + ")" * 40 + ")"), Grammar)
        assert "more than 50 parentheses" in str(tried("S -> Skip(" + "(" * 9000 + "1" + ")" * 9000 + ")"))
        assert isinstance(tried("S -> Skip(" + "-" * 9000 + "1)"), Grammar)

    def test_parts(self) -> None:
        found = tried(f"S -> RandUni(0{', A' * 9000})" + A)
        assert "expected at most 8000 parts; found 9000" in str(found)


class TestMany:
    """Work grows as the text does: what is counted here grew with its square."""

    def test_unknown_rules(self, monkeypatch: pytest.MonkeyPatch) -> None:
        asked: list[str] = []
        nearest = findings.nearest
        monkeypatch.setattr(
            findings, "nearest", lambda name, valid: (asked.append(name), nearest(name, valid))[1]
        )
        found = tried("\n".join(f"R{k} -> Layer(Y{k})" for k in range(3000)))
        assert isinstance(found, GrammarError) and len(found.faults) == 1000 and len(asked) == 50
        assert "… and 980 more faults" in str(found)

    def test_unknown_tiles(self, monkeypatch: pytest.MonkeyPatch) -> None:
        asked: list[str] = []
        monkeypatch.setattr(checks, "nearest", lambda name, valid: (asked.append(name), "")[1])
        found = tried("\n".join(f"R{k} -> Mat(Color, Fit:q{k}, 0, 0, 1, 1)" for k in range(3000)))
        assert isinstance(found, GrammarError) and len(asked) == 50

    @pytest.mark.parametrize("around", ["{}", "namespace n {{\n{}\n}}"])
    def test_statements_that_cannot_be_read(self, around: str, monkeypatch: pytest.MonkeyPatch) -> None:
        read: list[int] = []
        parsed = syntax._parsed
        monkeypatch.setattr(syntax, "_LONG", 60_000)
        monkeypatch.setattr(
            syntax, "_parsed", lambda text: (read.append(len(text.lstrip())), parsed(text))[1]
        )
        good = "\n".join(f"R{k} -> Skip(0)" for k in range(2000))
        bad = "\n".join(f"X{k} -> Skip(0 0)" for k in range(30))
        found = tried(around.format(f"{good}\n{bad}"))
        assert isinstance(found, GrammarError) and 5 < len(found.faults) <= 30
        assert sum(read) < 15 * 60_000

    def test_names_are_cut(self) -> None:
        name = "n" * 190_000
        for text in (
            f"S -> Layer({name})",
            f"S -> {name}(1)",
            f"{name} -> Skip(0)\n{name} -> Skip(1)",
            f"{name} -> Layer({name})",
            f"S -> Layer({name}.{name})",
            f"S -> Mat(Color, Fit:{name}, 0, 0, 1, 1)",
            f"S -> Mat({name}, 0, 0, 0, 1, 1)",
            f"namespace {name} {{}}\nnamespace {name} {{}}",
            f"S -> Skip({'1' * 190_000})",
            f"S -> Layer(P({name} = 1))\nP(a) -> Layer(a)",
        ):
            found = tried(text)
            assert isinstance(found, GrammarError) and len(str(found)) < 1000


SCRIPTS = ["Mu\u0308nster", "दीवार", "ผนังบ้าน", "בָּית", "سَقف", "ජනේලය", "Fenêtre", "窓", "étage_2", "x²"]


@pytest.mark.parametrize("name", SCRIPTS)
def test_names_of_any_script(name: str) -> None:
    """As they are typed or as a file system has them: composed or not, a name is the same."""
    apart, whole = unicodedata.normalize("NFD", name), unicodedata.normalize("NFC", name)
    text = f"{apart} -> RepeatX({apart}_w, p.{whole})\n{whole}_w = 1\n"
    text += f"namespace p {{ {apart} -> Mat(Color, 0, 1, 1, 1, 1) }}"
    found = tried(text)
    assert isinstance(found, Grammar), found
    assert [rule.name for rule in found.rules] == [whole, f"p.{whole}"]
    assert found.index(apart) == 0
    assert isinstance(tried(f"{apart} -> Skip(0)\n{whole} -> Skip(0)"), GrammarError) or apart == whole


def test_what_is_no_name() -> None:
    for text in ("\u0308a -> Skip(0)", "1a -> Skip(0)", "a-b -> Skip(0)", "a\u200db -> Skip(0)"):
        assert isinstance(tried(text), GrammarError)


@pytest.mark.parametrize(
    "text", ["\ufeffS -> Skip(0)", "S -> Skip(0)\r\nA -> Skip(1)\r", "S\u00a0->\u3000Skip(0)"]
)
def test_what_editors_leave(text: str) -> None:
    assert isinstance(tried(text), Grammar)


@given(st.data())
@settings(max_examples=60, deadline=None)
def test_mangled_grammars(data: st.DataObject) -> None:
    text = list(FIGURE_12 + "\nnamespace n {\nw = 1\nP(a = w) -> Layer(a)\n}\nnamespace m = n(w = 2)")
    odd = [
        "\0",
        "\ufeff",
        "\u0301",
        "\r",
        "\u2028",
        "(",
        ")",
        "{",
        "}",
        "1e999",
        "->",
        "=",
        "−",
        "\ud800",
        "namespace ",
    ]
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(text)))
        cut = data.draw(st.sampled_from([0, 0, 1, 3, 40]))
        text[at : at + cut] = data.draw(st.one_of(st.sampled_from(odd), st.text(max_size=4)))
    tried("".join(text))


class TestArguments:
    GRAMMAR = Grammar.parse("S -> RepeatX(1, A)" + A)

    @pytest.mark.parametrize(
        ("given", "named"),
        [
            ({"points": [(np.nan, 0)]}, "points"),
            ({"points": [(np.inf, 0)]}, "points"),
            ({"points": [(1e300, 0)]}, "points"),
            ({"points": []}, "points"),
            ({"points": [(1, 2, 3)]}, "points"),
            ({"points": [(1, 2), (3,)]}, "points"),
            ({"points": "ab"}, "points"),
            ({"points": None}, "points"),
            ({"points": [[None, 1]]}, "points"),
            ({"size": (np.nan, 1)}, "size"),
            ({"size": (1e-300, 1)}, "size"),
            ({"size": (0, 1)}, "size"),
            ({"size": (1e400, 1)}, "size"),
            ({"size": 3}, "size"),
            ({"size": (1, 2, 3)}, "size"),
            ({"size": ("a", 1)}, "size"),
            ({"size": (10**400, 1)}, "size"),
            ({"seed": (np.nan, 0)}, "seed"),
            ({"seed": (np.inf, 0)}, "seed"),
            ({"seed": (1e300, 0)}, "seed"),
            ({"seed": 1}, "seed"),
            ({"seed": (1,)}, "seed"),
            ({"rays": [(0, 0, 0)]}, "rays"),
            ({"rays": [(0, 0, np.nan)]}, "rays"),
            ({"rays": [(0, 0, 1e300)]}, "rays"),
            ({"rays": [(0, 0, -1)] * 2}, "rays"),
            ({"rays": [0, 0, -1]}, "rays"),
            ({"start": 3}, "start"),
            ({"start": "B" * 10**6}, "start"),
        ],
    )
    def test_are_named(self, given: dict[str, object], named: str) -> None:
        whole = {"points": [(0.5, 0.5)], "size": (2, 1)} | given
        with pytest.raises(ValueError, match=f"^{named}: ") as caught:
            self.GRAMMAR.evaluate(**whole)  # type: ignore[arg-type]  # that is what is tried
        assert len(str(caught.value)) < 500

    def test_what_is_not_empty_but_small(self) -> None:
        assert self.GRAMMAR.evaluate(np.zeros((0, 2)), (2, 1)).rule.shape == (0,)
        assert self.GRAMMAR.evaluate([(0.0005, 0.0005)], (0.001, 0.001)).rule.tolist() == [1]
        assert self.GRAMMAR.evaluate([(-1e9, 1e9)], (99999, 1), rays=[(1e9, -1e9, 1e-9)]).rule.tolist() == [1]

    @pytest.mark.parametrize(
        ("eye", "target", "angle", "named"),
        [
            ((np.nan, 1, 3), (1, 1), 50, "eye"),
            ((1, 1, np.inf), (1, 1), 50, "eye"),
            ((1, 1, 1e-300), (1, 1), 50, "eye"),
            ((1, 1, 3), (np.nan, 1), 50, "eye, target"),
            ((1, 1, 3), (1e300, 1), 50, "eye, target"),
            ((1, 1, 3), (1, 1), np.nan, "angle"),
            ((1, 1, 3), (1, 1), 180, "angle"),
        ],
    )
    def test_eyes(
        self, eye: tuple[float, float, float], target: tuple[float, float], angle: float, named: str
    ) -> None:
        with pytest.raises(ValueError, match=f"^{named}"):
            Sight.from_eye(eye, target, (2, 1), (8, 4), angle)

    def test_pixels(self) -> None:
        for pixels in ((1, 1 << 26), (1 << 17, 1), (0, 1)):
            with pytest.raises(ValueError, match=r"^pixels: "):
                rules_seen(self.GRAMMAR, size=(2, 1), pixels=pixels)


ODD = ["nan", "inf", "1e400", "-1e400", "9" * 5000, "", "1_0", "0x1", "\u0663\u0660", "1e-400", "-0", "x"]


class TestCommandLine:
    @pytest.fixture
    def grammar(self, tmp_path: Path) -> Path:
        path = tmp_path / "g.txt"
        path.write_text("S -> RepeatX(1, A)" + A, "utf-8")
        return path

    def run(self, *words: str | Path) -> int:
        try:
            return main(["render", *map(str, words), "--backend", "cpu"])
        except SystemExit as ended:
            return int(ended.code or 0)

    @pytest.mark.parametrize(
        ("option", "pattern"),
        [("--size", "{}x2"), ("--size", "2x{}"), ("--pixels", "{}x2"), ("--pixels", "2x{}"), ("--seed", "{},0"),
         ("--eye", "{},1,3"), ("--eye", "1,1,{}"), ("--target", "1,{}"), ("--angle", "{}"), ("--hour", "{}")],
    )  # fmt: skip
    def test_numbers(self, option: str, pattern: str, grammar: Path, tmp_path: Path, capsys: Said) -> None:
        """Refused with the option's name, or, a zero where it may stand, drawn without a word."""
        for number in ODD:
            given = {"--size": "2x1", "--pixels": "4x2", "--eye": "1,1,3"} | {option: pattern.format(number)}
            out = tmp_path / "a.png"
            status = self.run(grammar, "--out", out, *(f"{name}={value}" for name, value in given.items()))
            error = capsys.readouterr().err
            if number in ("-0", "1e-400") and status == 0:
                assert error == "" and out.exists()
            else:
                assert status == 2 and f"argument {option}: " in error and len(error) < 3000, (number, error)

    @pytest.mark.parametrize("eye", ["1e300,1,3", "1,1,1e300", "1e7,1,1", "1,1,1e-300", "1,1,0", "1,1,-3"])
    def test_an_eye_out_of_bounds(self, eye: str, grammar: Path, tmp_path: Path, capsys: Said) -> None:
        assert self.run(grammar, "--size", "2x1", "--out", tmp_path / "a.png", f"--eye={eye}") == 2
        assert "argument --eye: " in capsys.readouterr().err

    @pytest.mark.parametrize(
        "given", [("1e6,1,0.001", "1,1"), ("-1e6,-1e6,1e6", "1e6,1e6"), ("1,1,0.001", "-1e6,0")]
    )
    def test_the_farthest_eye(
        self, given: tuple[str, str], grammar: Path, tmp_path: Path, capsys: Said
    ) -> None:
        words = [
            "--size",
            "2x1",
            "--pixels",
            "9x7",
            f"--eye={given[0]}",
            f"--target={given[1]}",
            "--angle=170",
            "--hour=12",
        ]
        assert self.run(grammar, "--out", tmp_path / "a.png", "--rules", tmp_path / "a.npy", *words) == 0
        assert capsys.readouterr().err == ""

    @pytest.mark.parametrize("pixels", ["1x67108864", "67108864x1", "65537x1", "8193x8193"])
    def test_too_large_a_picture(self, pixels: str, grammar: Path, tmp_path: Path, capsys: Said) -> None:
        assert self.run(grammar, "--size", "2x1", "--out", tmp_path / "a.png", "--pixels", pixels) == 2
        assert "each at most 65536, and at most 67108864 in all" in capsys.readouterr().err

    def test_a_bad_file_among_the_tiles(self, grammar: Path, tmp_path: Path, capsys: Said) -> None:
        folder = tmp_path / "tiles"
        folder.mkdir()
        from PIL import Image

        Image.new("RGB", (8, 8)).save(folder / "good.png")
        for k in range(20):
            (folder / f"bad {k}.png").write_bytes(b"")
        words = ["--size", "2x1", "--pixels", "4x2", "--tiles", folder, "--out", tmp_path / "a.png"]
        assert self.run(grammar, *words) == 0
        error = capsys.readouterr().err
        assert error.count("Note: ") == 6 and "… and 15 more files of that folder" in error

    def test_bytes_that_are_no_grammar(self, tmp_path: Path, capsys: Said) -> None:
        path = tmp_path / "g.txt"
        for content in (
            b"\0",
            b"\xff\xfeS\0",
            b"\x89PNG\r\n",
            b"S -> Skip(1e400)",
            bytes(range(256)),
            b"(" * 10**6,
        ):
            path.write_bytes(content)
            assert self.run(path, "--size", "2x1", "--out", tmp_path / "a.png") == 2
            error = capsys.readouterr().err
            assert error.startswith(str(path)) and "Traceback" not in error and len(error) < 5000


def test_a_start_rule_that_is_not_there() -> None:
    with pytest.raises(DesignError, match="start: there is no rule"):
        TestArguments.GRAMMAR.index("Z")
