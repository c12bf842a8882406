"""The exercises of the tutorials: they pass with their solutions and fail without, hints come before answers."""

from __future__ import annotations

import ast
import contextlib
import doctest
import io
import re
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import nbformat
import pytest

from facade_nb import solve
from facade_nb.course import Chapter, Exercise, chapter
from facade_nb.course.chapters import CHAPTERS
from facade_nb.course.deepening import CENTRED
from facade_nb.course.exercises import Open, solution_of
from facade_nb.course.flattened import colonnade, flattened, porch, telling
from facade_nb.course.own_code import TRIPLET
from facade_nb.render.parts import Block
from facade_nb.solver.experiments import Case, Node, checking, experiment
from facade_nb.solver.experiments.cases import small_cases

TUTORIALS = Path(__file__).resolve().parents[2] / "tutorials"
CHECKED = re.compile(r'^check\("([^"]+)", (\w+)\)$', re.MULTILINE)


MADE = ("chapter", "Case.of", "experiment", "Grammar.parse", "TextureModel", "dict")


def run(source: str, names: dict[str, Any]) -> str:
    """What a cell prints. Of cells without an exercise only definitions are run, and what waited for one."""
    tree = ast.parse(source)
    if not CHECKED.search(source):
        tree.body = [own for own in tree.body if defines(own)]
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        exec(compile(tree, "cell", "exec"), names)
    return told.getvalue()


def defines(own: ast.stmt) -> bool:
    if isinstance(own, ast.Assign) and isinstance(own.value, ast.Call):
        return ast.unparse(own.value.func) in MADE
    waits = isinstance(own, ast.If) and "check.after" in ast.unparse(own.test)
    return waits or isinstance(own, (ast.Import, ast.ImportFrom, ast.FunctionDef))


def cells(name: str) -> list[nbformat.NotebookNode]:
    return [
        own
        for own in nbformat.read(TUTORIALS / f"{name}.ipynb", as_version=4).cells
        if own.cell_type == "code"
    ]


@pytest.fixture
def few_cases(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a cell shows of sixty cases is seen in three as well."""
    monkeypatch.setattr(checking, "small_cases", lambda count, seed: islice(small_cases(count, seed), 3))


@pytest.mark.usefixtures("few_cases")
@pytest.mark.parametrize("name", CHAPTERS)
def test_exercises_pass_with_their_solutions(name: str) -> None:
    found: dict[str, Any] = {"display": print}
    asked = []
    for cell in cells(name):
        exercise = CHECKED.search(cell.source)
        if not exercise:
            assert "waits for" not in run(cell.source, found)
            continue
        asked.append(exercise[1])
        told = run(f"{solution_of(name, exercise[1])}\n{exercise[0]}", found)
        assert told.startswith("✓"), (exercise[1], told)
    assert asked == list(chapter(name).exercises)


@pytest.mark.parametrize("name", CHAPTERS)
def test_exercises_fail_without_solutions_and_give_nothing_away(name: str) -> None:
    """As they are saved; that they run like that from a fresh kernel is tested with all notebooks."""
    exercises = chapter(name).exercises
    found: dict[str, Any] = {"display": print}
    for cell in cells(name):
        exercise = CHECKED.search(cell.source)
        told = run(cell.source, found)
        saved = "".join(output.get("text", "") for output in cell.outputs)
        assert "✓" not in told + saved
        if exercise:
            assert cell.source.rstrip().endswith(exercise[0])
            assert "Not yet" in told and "Not yet" in saved, (exercise[1], told, saved)
            assert exercises[exercise[1]].hints[-1] not in saved + told


def test_hints_come_before_the_solution(capsys: pytest.CaptureFixture[str]) -> None:
    check = chapter("06-a-shortest-path")
    hints = check.exercises["edges"].hints

    def ask(answer: object) -> str:
        check("edges", answer)
        return capsys.readouterr().out

    check.solution("edges")
    assert "Try it first" in capsys.readouterr().out
    assert ask(...) == "Not yet: put your answer in the place of the dots.\n"
    assert "returns nothing" in ask(lambda rests: None)
    first = ask(lambda rests: rests[0] * rests[1])
    assert "With (3, 5) letters still to come you say 15." in first and hints[0] in first
    assert hints[1] not in first
    assert hints[1] in ask(lambda rests: rests[0] / 0)
    assert "check.solution('edges')" in ask(lambda rests: 3)
    check.solution("edges")
    assert "return product - 1" in capsys.readouterr().out
    with pytest.raises(ValueError, match="did you mean 'edges'"):
        check("edge", 3)


@pytest.mark.parametrize(
    ("name", "exercise", "answer", "told"),
    [
        ("01-a-stack-of-layers", "behind", "a hole", "It is not 'a hole'."),
        ("01-a-stack-of-layers", "windows", [3, 5, 7], "Look again at 4.3 m."),
        (
            "01-a-stack-of-layers",
            "product",
            lambda across, up: [f"{x} {y}" for x in across for y in up],
            "For 'ABA' across",
        ),
        ("01-a-stack-of-layers", "drawn", ["C P", "e P"], "'e P' is not drawn by this layer."),
        ("01-a-stack-of-layers", "lamp", ("xl; l := L", ["P", "Q"]), "are on: P, Q."),
        ("01-a-stack-of-layers", "lamp", ("lx; l := L", ["Q"]), "from the left end."),
        ("01-a-stack-of-layers", "lamp", ("xL", ["Q"]), "as 'cec; c := C' is written"),
        ("01-a-stack-of-layers", "storey", {"By": "PQ", "Ry": "PQQR"}, "There is a hole in it now."),
        ("02-patterns-and-words", "pairs", "A(BA)^k", "It makes ABA, which is not wanted."),
        ("02-patterns-and-words", "pairs", "A(BBA", "A(BBA"),
        ("02-patterns-and-words", "choice", "A B A", "It does not make ACA."),
        ("02-patterns-and-words", "centred", "y A(BA)^k y", "y"),
        ("02-patterns-and-words", "mirrors", ["ABCC'B'A'", "ABCC'B'A'"], "is not the word there"),
        ("02-patterns-and-words", "row", "A(BA)^|k", "is opposite"),
        ("02-patterns-and-words", "row", "A(BA)^k", "is no mirrored A"),
        (
            "02-patterns-and-words",
            "lower",
            lambda canvas, mu, front: canvas - mu,
            "[0.6, 0.6] m of opaque letters",
        ),
        ("02-patterns-and-words", "fits", [[3], [3]], "Look again at the wall behind the posts."),
        (
            "03-what-is-known-beforehand",
            "left over",
            ["C C^m C", "A^k"],
            "'A^k' is not what is left of the second.",
        ),
        ("03-what-is-known-beforehand", "equation", lambda m: m + 1, "For 0 you say 1."),
        ("03-what-is-known-beforehand", "trim", lambda one, other: (one, other), "Of ['A^k', 'C', 'C^m'"),
        ("03-what-is-known-beforehand", "middle", lambda k: 1.7 * k, "For 1 you say 1.7."),
        ("03-what-is-known-beforehand", "possible", [True, True, True, False], "Look again at pair 2."),
        ("03-what-is-known-beforehand", "mend", "A A A A^m A^m", "needs 2m + 3 = 2l"),
        ("03-what-is-known-beforehand", "mend", "A^m A^m", "put walls A before it or after it."),
        ("04-what-goes-wrong", "kinds", ["misalignment", "hole", "placement", "hole"], "Look again at 2."),
        ("04-what-goes-wrong", "other kinds", ["sizing", "hole"], "Look again at 5."),
        ("04-what-goes-wrong", "starts", lambda sizes: [0.0 for _ in sizes], "you say [0.0, 0.0, 0.0]"),
        ("04-what-goes-wrong", "common", lambda a, b: min(a[1], b[1]) - max(a[0], b[0]), "Of (0.0, 0.5)"),
        ("04-what-goes-wrong", "d", "between B and D", "Expected one of"),
        ("04-what-goes-wrong", "free", porch(attached="B"), "before the window at 0.00 to 1.20 m."),
        ("05-columns-and-constraints", "terms", [1.5, 1.05, 0.3], "Look again at Λ of C/AB."),
        ("05-columns-and-constraints", "C1", lambda column: True, "Of [['soft'], []] you say True."),
        (
            "05-columns-and-constraints",
            "windows",
            "C/ε | e/BABAB | C/ε",
            "Column 1 has nothing in it that is opaque",
        ),
        ("05-columns-and-constraints", "slender", "C/A | e/BAB | C/A", "There is a cheaper one."),
        (
            "05-columns-and-constraints",
            "attached",
            "e/F | e/D | C/ε | e/D | f/F",
            "these columns take eeCef from it.",
        ),
        ("05-columns-and-constraints", "which", "C3", "It is not 'C3'."),
        ("06-a-shortest-path", "by hand", "C/A | e/BAB", "Word 1 is CeC; these columns take Ce from it."),
        ("06-a-shortest-path", "by hand", "C/ε | e/ABABA | C/ε", "J is 1.005 m. There is a cheaper one."),
        ("06-a-shortest-path", "omega", lambda column: 3.0, "Of the column [[2], [2]] you say 3 m."),
        ("06-a-shortest-path", "by eye", [6, 4, 1], "Look again at the third."),
        ("06-a-shortest-path", "path", [(0, 0), (1, 0), (1, 5), (3, 5)], "Node 3 is not (1, 5)."),
        (
            "07-iterative-deepening",
            "rests",
            lambda node: abs(node.sizes[0] - node.sizes[1]),
            "It says too much.",
        ),
        ("07-iterative-deepening", "rests", lambda node: 0, "It could say more."),
        ("07-iterative-deepening", "rests", lambda node: node.size, "A node has canvas"),
        ("07-iterative-deepening", "next limit", lambda own: own.limit + 0.1, "pass 2 has the limit 0.1 m"),
        ("07-iterative-deepening", "ends", [10**8, 10**4], "Look again at from both ends."),
        ("07-iterative-deepening", "tie", lambda column: -column.letters, "It takes up 65 nodes"),
        ("08-candidates-and-proof", "bounds", [0.9, 0.375, 0.2], "Look again at k = 3."),
        ("08-candidates-and-proof", "bound", lambda choice: 0.0, "candidates are aligned; 7 will do"),
        ("08-candidates-and-proof", "bound", lambda choice: 3 * choice.least, "It says too much."),
        (
            "09-sizes",
            "grow",
            lambda counts, missing: [missing / sum(counts)] * len(counts),
            "there are smaller ones",
        ),
        ("09-sizes", "grow", lambda counts, missing: [0.1, 0.1, 0.1], "your letters grow by 0.7 m together"),
        ("09-sizes", "sized", lambda p, B, d: p, "do not keep B x = d"),
        ("09-sizes", "limited", [0.92, 1.26, 0.67], "Look again at C."),
        (
            "10-a-pixel-by-grammar",
            "repeat",
            lambda size, v: [v] * int(size / v),
            "[2.5, 2.5, 2.5, 2.5, 2.5]: expected 6",
        ),
        (
            "10-a-pixel-by-grammar",
            "split",
            lambda size, parts: [size / len(parts)] * len(parts),
            "[2.0, 2.0, 2.0]",
        ),
        ("10-a-pixel-by-grammar", "part", lambda sizes, at: 0, "Of [1, 2, 3], 1.5 you say 0."),
        ("10-a-pixel-by-grammar", "composed", lambda layers: layers[0], "you say C = 0.2, A = 0.5."),
        (
            "10-a-pixel-by-grammar",
            "turned",
            "Hole -> SkipMask(Fit:mask-arch, 0, 1)",
            "In the arch one sees Inside",
        ),
        ("10-a-pixel-by-grammar", "turned", "Hole -> SkipMusk(Fit:mask-arch, 1, 0)", "SkipMask"),
        ("11-rooms-behind-windows", "hit", lambda point, ray, size, depth: "back", "along (1.0, 0.0, -1.0)"),
        ("11-rooms-behind-windows", "parallax", lambda step, far, deep: step, "0 m deep, you say 1 m."),
        (
            "11-rooms-behind-windows",
            "sofa",
            "Furniture -> SplitY(Abs, 0.9, SofaTile, Rel, 1, Skip)",
            "Your sofa is 4.00 m wide and 0.90 m high.",
        ),
        (
            "12-the-pipeline-and-a-town",
            "order",
            ["grammar", "G-buffer", "occlusion", "light"],
            "grammar reads place, which no pass before it has written.",
        ),
        (
            "12-the-pipeline-and-a-town",
            "order",
            ["G-buffer", "grammar", "light", "occlusion"],
            "light reads softened",
        ),
        ("12-the-pipeline-and-a-town", "hides", lambda above, far, reach: above / far, "you say 1."),
        ("13-change-the-solver", "windows", lambda column: 0, "A post still stands before a window"),
        ("13-change-the-solver", "constraint", lambda column: True, "A post still stands before a window"),
        ("13-change-the-solver", "constraint", lambda column: False, "Nothing is found any more"),
        ("13-change-the-solver", "constraint", lambda column: 1, "neither True nor False"),
        ("13-change-the-solver", "teeth", [5, 0.8], "Look again at the width of each."),
        (
            "13-change-the-solver",
            "battlement",
            lambda w, h, d: (Block(0, 0, w, h, -d, 0),),
            "there is stone 0.68 m from the left and 1.12 m up, where nothing should be.",
        ),
        (
            "13-change-the-solver",
            "battlement",
            lambda w, h, d: (Block(0, h, w, 0, -d, 0),),
            "has no room in it",
        ),
        (
            "13-change-the-solver",
            "mirror",
            lambda batch, v: replace(batch, x=-batch.x),
            "you make -2.25, -2.5.",
        ),
        (
            "13-change-the-solver",
            "mirror",
            lambda batch, v: replace(batch, x=batch.left + batch.right - batch.x),
            "Of the ray (0.5, 0.25, -1) you make (0.5, 0.25, -1).",
        ),
        ("13-change-the-solver", "shader", "now.at.x = now.scope.left;", "The GLSL compiler says: "),
        (
            "13-change-the-solver",
            "shader",
            "now.at.x = now.scope.x + now.scope.z - now.at.x;",
            "pixels differ from NumPy's.",
        ),
        (
            "13-change-the-solver",
            "pairs",
            lambda column: column.omega,
            "Of elements of 1, 2, 4 m you say 3.0.",
        ),
        ("13-change-the-solver", "order", lambda choice: 0, "has k = 1"),
        ("13-change-the-solver", "loose", 0.25, "has 4 columns"),
        ("13-change-the-solver", "middle", lambda letters, k: letters * k, "Of 1 × WP you make WP."),
    ],
)
def test_what_is_said_of_a_wrong_answer(
    name: str, exercise: str, answer: object, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    chapter(name)(exercise, answer)
    said = capsys.readouterr().out
    assert said.startswith("Not yet. ") and told in said


def test_a_judge_may_say_that_there_is_no_answer_yet(capsys: pytest.CaptureFixture[str]) -> None:
    def judge(answer: object) -> str:
        raise Open("nothing there.")

    check = Chapter("x", {"a": Exercise(judge, ("hint",), "why")})
    check("a", 1)
    assert capsys.readouterr().out == "Not yet: nothing there.\n"


def test_an_unknown_chapter_is_told_with_those_that_are() -> None:
    with pytest.raises(ValueError, match="07-iterative-deepening"):
        chapter("7")


def test_numbers_in_the_text_are_those_of_the_solver() -> None:
    def nothing(node: Node) -> float:
        return 0.0

    told = experiment(CENTRED, heuristic=nothing)
    assert (told.ours[0].nodes, told.nodes) == (6, 21)
    assert "one looked at 6 nodes, the other at 21" in text("07-iterative-deepening")
    figure = Case.of("CeC", "ABABA", A=2, B=3, C=2, e=8, transparent="e", cuts=False, canvas=12, tolerance=1)
    assert experiment(figure).nodes == 3
    assert "Three nodes, of 24!" in text("06-a-shortest-path")
    assert "four columns" in text("13-change-the-solver")
    assert experiment(TRIPLET).yours[0].answer.count("|") == 3


def test_a_flattened_facade_has_what_the_text_says_and_a_mark_for_each_flaw() -> None:
    wide, narrow = solve(colonnade()), solve(colonnade(7.0))
    assert [own.kind for own in telling(wide)] == ["misalignment", "occlusion", "placement", "hole"]
    assert [own.kind for own in telling(narrow)][3:] == ["sizing", "beyond"]
    offsets = next(own.text for own in telling(wide) if own.kind == "placement")
    assert "+0.75 m" in offsets and "the first one +0.40 m" in offsets
    assert "begins 0.75 m to the right of its column" in text("04-what-goes-wrong")
    drawn = flattened(wide).svg
    assert (
        drawn.endswith("</svg>")
        and all(f">{n}</text>" in drawn for n in range(1, 5))
        and ">5</text>" not in drawn
    )
    scale, left = 840 / 7.6, float(drawn.partition('data-origin="')[2].split()[0])
    assert f"<rect x='{left + scale * 7.2:.1f}'" in drawn  # the hole begins where the wall ends


def test_the_town_costs_what_was_measured() -> None:
    measured = (TUTORIALS.parent / "docs" / "measured.md").read_text("utf-8")
    rows = re.findall(r"^\| ([\w-]+), OSMesa \| (\d+) \(.*?\| (\d+) \(.*?\| (\d+) \(", measured, re.MULTILINE)
    assert len(rows) == 3
    for view, simple, chance, full in rows:
        row = f"| {view} | {simple} | {chance} | {full} | {int(full) / int(simple):.1f} |"
        assert row in text("12-the-pipeline-and-a-town")
    assert "street 407 (767)" in measured and "grammar 248" in measured


def text(name: str) -> str:
    return (TUTORIALS / f"{name}.ipynb").read_text("utf-8")


def test_each_chapter_names_the_one_that_is_printed_after_it() -> None:
    read = [nbformat.read(TUTORIALS / f"{name}.ipynb", as_version=4).cells for name in CHAPTERS]
    titles = [pages[0].source.partition("\n")[0].removeprefix("# ") for pages in read]
    assert [int(title.split()[0]) for title in titles] == list(range(1, 14))
    for pages, after in zip(read, titles[1:], strict=False):
        assert f"*{after}*" in pages[-1].source


def test_the_page_about_them() -> None:
    page = TUTORIALS.parent / "docs" / "tutorials.md"
    outcome = doctest.testfile(str(page), module_relative=False, encoding="utf-8")
    assert outcome.attempted == 4 and outcome.failed == 0
    named = set(re.findall(r"^\| `([\w-]+)` \|", page.read_text("utf-8"), re.MULTILINE))
    assert named == {path.stem for path in TUTORIALS.glob("*.ipynb")}
