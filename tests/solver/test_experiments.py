"""A learner's own functions in the search: what they change, whether that is found out, how their faults are told."""

from __future__ import annotations

import doctest
import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from facade_nb.design import Design
from facade_nb.solver import Objective, align, solve
from facade_nb.solver.experiments import Case, Column, ExperimentError, Node, Pass, check, experiment, weigh
from facade_nb.solver.experiments.cases import houses, small_cases

HOUSE = houses()[2]


def nothing(node: Node) -> float:
    return 0.0


def triple(node: Node) -> float:
    return 3 * node.least


def test_the_page_about_it() -> None:
    page = Path(__file__).parents[2] / "docs" / "experiments.md"
    outcome = doctest.testfile(
        str(page), module_relative=False, encoding="utf-8", optionflags=doctest.REPORT_NDIFF
    )
    assert outcome.attempted > 9 and outcome.failed == 0


def test_without_a_heuristic_more_nodes_are_taken_up_and_the_answer_is_the_same() -> None:
    told = experiment(HOUSE, heuristic=nothing)
    (ours, _), (yours, _) = told.ours, told.yours
    assert yours.nodes > 5 * ours.nodes
    assert yours.passes > ours.passes
    layout = solve(HOUSE)
    assert told.exact and told.counterexample is None
    assert yours.cost == pytest.approx(layout.x.cost) == pytest.approx(ours.cost)
    assert told.layout is not None and told.layout.counters == layout.counters
    assert told.layout.x.cost == pytest.approx(layout.x.cost)
    assert all(visit.f <= max(yours.limits) + 1e-6 for visit in yours.visits)


def test_a_heuristic_that_says_too_much_has_a_counterexample_that_is_one() -> None:
    case = Case.of("AB", "BC", "AA", A=1, B=3, C=0.5, canvas=4.5)
    told = experiment(case, heuristic=triple)
    best = align(case.words, case.canvas, case.tolerance, Objective(), search="best")
    assert best is not None and told.exact is False
    counter = told.counterexample
    assert counter is not None
    assert counter.found == pytest.approx(told.cost) and counter.found > best.cost + 0.1
    assert counter.best == pytest.approx(best.cost) and counter.better == str(best)
    assert "your heuristic says h = 3.550 m" in counter.reason
    assert "<td" in told._repr_html_() and "Not exact" in told._repr_html_()
    verdict = check(heuristic=triple, cases=8)
    assert verdict.wrong > 1 and not verdict.exact and verdict.worse is not None


def test_right_by_luck_is_told() -> None:
    case = Case.of("CeC", "ABABA", A=2, B=3, C=2, e=8, transparent="e", canvas=12, tolerance=1, cuts=False)
    told = experiment(case, heuristic=triple)
    assert told.exact and "by luck" in told.verdict
    assert told.counterexample is not None and "f = 1.500 m" in told.counterexample.reason


@pytest.mark.parametrize(
    "own",
    [
        {"heuristic": nothing, "next_limit": lambda own: own.beyond},
        {"heuristic": nothing, "next_limit": lambda own: own.limit + 5.0},
        {"heuristic": nothing, "table": False},
        {"candidate_order": lambda choice: -choice.least},
        {"bound": lambda choice: 0},
    ],
)
def test_what_only_changes_the_order_stays_exact(own: dict[str, Any]) -> None:
    words = "heuristic" in own
    verdict = check(**own, cases=8) if words else check(**own)
    assert verdict.exact and verdict.wrong == 0
    assert verdict.nodes != (check(heuristic=nothing, cases=8).nodes if words else verdict.usual)


def test_the_papers_tie_break_saves_nodes_where_much_is_equal() -> None:
    case = Case.of("CeC", "ABABA", A=2, B=3, C=2, canvas=12, tolerance=1)
    told = experiment(case, objective=Objective.paper(), tie_break=lambda column: -column.letters)
    assert told.exact and told.yours[0].nodes > told.ours[0].nodes
    same = experiment(case, objective=Objective.paper(), tie_break=lambda column: column.letters)
    assert same.yours == same.ours


def brute(
    case: Case, error: Callable[[list[float]], float], allowed: Callable[[int], bool] = lambda letters: True
) -> float:
    """Least J of two solid words with another column error, or fewer columns, by trying everything."""
    sizes = [[a.size or 0.0 for a in word] for word in case.words]

    def go(i: int, j: int, width: float) -> Iterator[float]:
        if i == len(sizes[0]) and j == len(sizes[1]):
            off = abs(width - case.canvas)
            yield 0.25 * off if off <= case.tolerance + 1e-9 else math.inf
        for up in range(i, len(sizes[0]) + 1):
            for low in range(j, len(sizes[1]) + 1):
                own = [row for row in (sizes[0][i:up], sizes[1][j:low]) if row]
                totals = [sum(row) for row in own]
                if not own or max(totals) - min(totals) > case.tolerance + 1e-9:
                    continue
                if not allowed(sum(map(len, own))):
                    continue
                cost = error(totals) + 0.4 * (2 - len(own)) * max(totals)
                cost += 0.125 * sum(min(a, b) for row in own for a, b in pairwise(row))
                yield cost + min(go(up, low, width + max(totals)), default=math.inf)

    return min(go(0, 0, 0.0), default=math.inf)


def test_another_column_error_is_minimised_and_the_products_heuristic_may_be_too_large_for_it() -> None:
    def half(column: Column) -> float:
        return 0.5 * (max(column.sizes) - min(column.sizes))

    case = Case.of("ABC", "AA", A=0.5, B=1.5, C=1.5, canvas=4.5)
    told = experiment(case, column_error=half)
    counter = told.counterexample
    assert told.exact is False and counter is not None
    assert counter.best == pytest.approx(brute(case, lambda own: 0.5 * (max(own) - min(own))))
    assert counter.best < told.cost
    assert "the product's heuristic, made for Eq. 9" in counter.reason
    safe = experiment(case, column_error=half, heuristic=nothing)
    assert safe.exact and safe.cost == pytest.approx(counter.best) and safe.counterexample is None
    plain = [own for own in small_cases(12, 3) if len(own.words) == 2 and own.words[0][0].size]
    plain = [own for own in plain if all(a.size for word in own.words for a in word)]
    for own in plain[:4]:
        mine = experiment(own, column_error=lambda column: max(column.sizes) - min(column.sizes))
        assert mine.cost == pytest.approx(brute(own, lambda sizes: max(sizes) - min(sizes)))


def test_a_constraint_takes_columns_away_and_what_is_left_is_minimised() -> None:
    plain = [own for own in small_cases(24, 3) if len(own.words) == 2]
    plain = [own for own in plain if all(a.size for word in own.words for a in word)]
    fewer = 0
    for own in plain[:6]:
        mine = experiment(own, constraint=lambda column: column.letters <= 2)
        assert mine.exact and mine.counterexample is None
        right = brute(own, lambda sizes: max(sizes) - min(sizes), lambda letters: letters <= 2)
        assert mine.cost == pytest.approx(right)
        fewer += mine.cost > mine.ours[0].cost + 1e-6
    assert fewer


def free(column: Column) -> bool:
    upper, lower = ({letter.symbol for letter in own} for own in column.elements)
    return not ("C" in upper and "B" in lower)


def test_a_price_is_paid_where_there_is_no_other_way_and_a_constraint_is_not() -> None:
    def priced(column: Column) -> float:
        return column.omega + (0 if free(column) else 1000)

    arcade = Case.of("CeCeC", "BABAB", A=0.9, B=1.2, C=0.6, canvas=5.4)
    forbidden, dear = experiment(arcade, constraint=free), experiment(arcade, column_error=priced)
    assert forbidden.exact and forbidden.cost == pytest.approx(dear.cost) == pytest.approx(1.47)
    assert forbidden.yours[0].answer == dear.yours[0].answer
    porch = Case.of("CeC", "BAB", A=0.3, B=1.2, C=0.6, soft="C", canvas=2.7)
    assert experiment(porch, column_error=priced).cost == pytest.approx(2000.15)
    nowhere = experiment(porch, constraint=free)
    assert nowhere.cost == math.inf and nowhere.verdict == "Exact: there is no answer at all."


def test_a_constraint_on_a_design_is_compared_with_a_search_that_has_it_too() -> None:
    told = experiment(HOUSE, constraint=lambda column: column.empty == 0)
    assert told.exact and told.yours[0].cost > told.ours[0].cost
    assert check(constraint=lambda column: column.letters <= 2, cases=12).wrong == 0


def test_another_weight_of_looseness_changes_the_answer() -> None:
    case = Case.of("ABA", "CBA", "ACC", A=1.5, B=1, C=2, canvas=6.5)
    told = experiment(case, objective=Objective(loose=0.0))
    assert told.exact
    assert told.ours[0].answer == "A/ε/A | ε/C/C | B/B/ε | A/A/C"
    assert told.yours[0].answer == "ε/ε/A | A B A/C B A/C C"
    assert told.yours[0].cost < told.ours[0].cost


def test_a_bound_that_says_too_much_loses_the_best_candidate() -> None:
    told = experiment(HOUSE, bound=lambda choice: 3 * choice.least)
    assert told.exact is False and told.counterexample is not None
    assert "(C e C, A B A B A) costs 1.125 m at least; but it costs 0.555 m" in told.counterexample.reason
    assert told.layout is not None and told.layout.counters == {"k": 3}


def test_under_the_papers_objective_the_order_of_candidates_decides() -> None:
    given: dict[str, Any] = {"objective": Objective.paper(), "tolerances": (0.5,)}
    told = experiment(HOUSE, candidate_order=lambda choice: -choice.counters["k"], **given)
    assert told.layout is not None
    first = solve(HOUSE, objective=Objective.paper(), tolerances=(0.5,))
    assert told.layout.counters["k"] > first.counters["k"]
    assert told.ours[0].cost == pytest.approx(first.x.cost)


def test_a_search_that_gives_up_says_so() -> None:
    told = experiment(HOUSE, heuristic=nothing, nodes=20)
    assert told.exact is None and "gave up" in str(told) and "not known" in told.verdict


def test_where_nothing_fits_there_is_no_answer() -> None:
    told = experiment(Case.of("AA", "B", A=5, B=1, canvas=4, tolerance=1), heuristic=nothing)
    assert told.exact and math.isinf(told.cost) and "no answer at all" in told.verdict


def two_arguments(node: Node, more: int) -> float:
    return 0.0


def divides(node: Node) -> float:
    left = sum(node.sizes)

    return left / node.cost


def no_return(node: Node) -> None:
    node.least  # noqa: B018


def misspelt(node: Node) -> float:
    return node.rest  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("own", "told"),
    [
        ({"heuristic": two_arguments}, ["heuristic 'two_arguments'", "one argument", "def two_arguments(node)"]),
        ({"heuristic": divides}, ["heuristic 'divides'", "(return left / node.cost)", "ZeroDivisionError", "(C, A B)"]),
        ({"heuristic": no_return}, ["heuristic 'no_return'", "returned None", "Is a return missing?"]),
        ({"heuristic": misspelt}, ["'misspelt'", "AttributeError", "A node has canvas,", "rests"]),
        ({"heuristic": 3}, ["heuristic: expected a function of a node", "found 3"]),
        ({"heuristic": lambda node: math.nan}, ["returned nan", "not a number"]),
        ({"heuristic": lambda node: "3"}, ["returned '3' (str)", "Expected: metres"]),
        ({"heuristic": lambda node: True}, ["returned True (bool)"]),
        ({"heuristic": lambda node: -0.5}, ["returned -0.5", "negative"]),
        ({"column_error": lambda column: math.inf}, ["column_error", "not finite", "the column C / A"]),
        ({"constraint": lambda column: 1}, ["returned 1 (int)", "neither True nor False", "Expected: True where"]),
        ({"tie_break": lambda column: (1, "a")}, ["tie_break", "a tuple of numbers"]),
        ({"heuristic": nothing, "next_limit": lambda own: None}, ["next_limit", "the pass 1 (limit 0 m"]),
        ({"bound": lambda choice: 0}, ["bound is asked about the candidates of a design"]),
    ],
)  # fmt: skip
def test_a_fault_is_told_with_its_function_and_its_line(own: dict[str, Any], told: list[str]) -> None:
    case = Case.of("C", "AB", A=1, B=2, C=1, canvas=3.2)
    with pytest.raises(ExperimentError) as fault:
        experiment(case, **own)
    for part in told:
        assert part in str(fault.value)
    assert len(fault.value._render_traceback_()) == 1 and str(fault.value).count("\n") <= 1
    if "heuristic" in own and own["heuristic"] is divides:
        line = divides.__code__.co_firstlineno + 3
        assert f"line {line} " in str(fault.value)


@pytest.mark.parametrize(
    ("words", "given", "told"),
    [
        (("CeC",), {"A": 2, "canvas": 3}, "sizes names 'A', and the letters are C, e"),
        (("AB",), {"a": 1, "B": 1, "canvas": 2}, "did you mean 'A'?"),
        (("AB",), {"A": 1, "B": -1, "canvas": 2}, "found B=-1"),
        (("AB",), {"A": 1, "B": 1, "canvas": 0}, "canvas of more than 0 m"),
        (("AB",), {"A": 1, "canvas": 2, "soft": "B"}, "'B' has no size"),
        ((), {"canvas": 2}, "expected words such as 'CeC'"),
    ],
)
def test_a_case_that_cannot_be(words: tuple[str, ...], given: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=r"Case\.of") as fault:
        Case.of(*words, **given)
    assert told in str(fault.value)


def test_a_design_without_layers_has_nothing_to_search() -> None:
    empty = {"format": "facade-nb/design/1", "name": "Empty", "canvas": {"width": 3, "height": 3}}
    with pytest.raises(ExperimentError, match="Empty has no layers"):
        experiment(Design.from_dict(empty), heuristic=nothing)


def test_a_counter_on_both_axes_is_held() -> None:
    document = HOUSE.to_dict()
    document["patterns"]["storey"] = "Y Z^k"
    document["symbols"]["Z"] = {"size": 0.3}
    document["canvas"]["height"] = 3.4
    design = Design.from_dict(document)
    told = experiment(design, heuristic=nothing)
    assert told.exact and told.layout is not None and told.layout.counters == solve(design).counters


def test_a_pass_says_what_it_saw() -> None:
    passes: list[Pass] = []

    def least(own: Pass) -> float:
        passes.append(own)
        return own.beyond

    told = experiment(HOUSE, heuristic=nothing, next_limit=least)
    assert told.exact and told.passes > len(passes) > 3
    assert all(own.beyond > own.limit for own in passes)
    assert [own.number for own in passes[:2]] == [1, 2]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("Ce/ABA | C/BA", "Column 1 puts Ce into one element"),
        ("C/A | C/A", "Word 1 is CeC; these columns take CC from it."),
        ("C/A | e/BAB | C/AA", "Word 2 is ABABA; these columns take ABABAA from it."),
        ("C/A | e/BAB | C", "Column 3 has 1 elements; there are 2 words."),
        ("C/ε | e/ABABA | C/ε", "W is 16 m; the canvas is 12 m, and μ 1 m."),
        ("C/AB | e/AB | C/A", "Column 1 errs by 3 m; μ is 1 m."),
    ],
)
def test_what_is_wrong_with_an_alignment_is_said(text: str, told: str) -> None:
    case = Case.of("CeC", "ABABA", A=2, B=3, C=2, e=8, transparent="e", cuts=False, canvas=12, tolerance=1)
    weighed = weigh(case, text)
    assert any(told in fault for fault in weighed.faults), weighed.faults
    assert f"✗ {told}"[:20] in weighed._repr_html_()


def test_the_ledger_of_an_alignment_is_that_of_the_solver() -> None:
    weighed_so_far = 0
    for case in [*small_cases(9, 5), Case.of("CeC", "ABABA", A=2, B=3, C=2, canvas=13)]:
        best = align(case.words, case.canvas, case.tolerance, Objective(), search="best")
        if best is None:
            continue
        weighed_so_far += 1
        weighed = weigh(case, str(best))
        assert not weighed.faults
        assert weighed.cost == pytest.approx(best.cost) and weighed.omega == pytest.approx(best.error)
        assert weighed.width == pytest.approx(best.width)
        parts = weighed.omega + 0.8 * weighed.empty + 0.25 * weighed.loose
        assert weighed.cost == pytest.approx(parts + 0.25 * abs(weighed.width - case.canvas))
    assert weighed_so_far > 5
