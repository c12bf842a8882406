"""Which constraint pulls where: multipliers as forces, and the certificate that sizes are the best there are."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb import Layout, NoLayout, gallery, solve
from facade_nb.design import edit
from facade_nb.design.model import AXES
from facade_nb.solver.model.sizing import FREE, Sizing, Solution, System
from facade_nb.solver.sizing.least_squares import least_squares
from tests.oracle.designs import design, make_design

QUICK = [
    "figure-7",
    "residential-house",
    "apartment-house",
    "qualifiers-a",
    "qualifiers-b",
    "qualifiers-c",
    "qualifiers-d",
]


def sizing(layout: Layout, axis: Any = "x") -> Sizing:
    found = layout.along(axis).sizing
    assert found is not None
    return found


def posed(weight: Any, target: Any, rows: Any, lower: Any, upper: Any) -> Sizing | None:
    """A system by hand, solved."""
    weight, target = np.asarray(weight, float), np.asarray(target, float)
    rows = np.asarray(rows, float).reshape(-1, weight.size)
    lower, upper = np.asarray(lower, float), np.asarray(upper, float)
    solution = least_squares(weight, target, rows, lower, upper)
    if solution is None:
        return None
    keys = tuple(("|", f"v{n}") for n in range(weight.size))
    row_keys = tuple(("extent", f"r{n}") for n in range(len(rows)))
    return Sizing(
        System(keys, row_keys, rows, lower, upper, weight, target, np.full(weight.size, 1e-6)), solution
    )


class TestCertificate:
    @pytest.mark.parametrize("name", QUICK)
    def test_of_the_gallery(self, name: str) -> None:
        """The supplement's Figure 7 among them, whose equations repeat each other."""
        layout = solve(gallery.load(name))
        for axis in AXES:
            own = sizing(layout, axis)
            assert own.primal_residual <= 1e-8 and own.kkt_residual <= 1e-8

    @pytest.mark.parametrize("seed", range(30))
    def test_of_random_designs(self, seed: int) -> None:
        try:
            layout = solve(make_design(seed))
        except NoLayout as error:
            assert str(error)
            return
        assert max(sizing(layout, axis).kkt_residual for axis in AXES) <= 1e-8

    @settings(max_examples=60, deadline=None)
    @given(st.integers(0, 10**6))
    def test_of_degenerate_and_redundant_systems(self, seed: int) -> None:
        """Rows twice, rows that follow from others, bounds that just touch, sizes that nothing draws anywhere."""
        draw = np.random.default_rng(seed)
        n, m = int(draw.integers(2, 9)), int(draw.integers(1, 6))
        rows = draw.choice([-1.0, 0.0, 1.0], size=(m, n))
        rows = np.vstack([rows, rows[:1], rows.sum(axis=0, keepdims=True)])
        inside = draw.choice([0.5, 1.0, 2.0], size=n)  # a point that keeps all constraints
        at = np.concatenate([inside, rows @ inside])
        slack = draw.choice([0.0, 0.0, 1.0, FREE], size=(2, at.size))
        lower, upper = (
            np.where(slack[0] < FREE, at - slack[0], -FREE),
            np.where(slack[1] < FREE, at + slack[1], FREE),
        )
        lower[:n], upper[:n] = np.minimum(lower[:n], 0.0), np.maximum(upper[:n], 3.0)
        own = posed(draw.choice([0.0, 1.0], size=n), draw.choice([0.0, 1.0, 3.0], size=n), rows, lower, upper)
        assert own is not None
        assert own.primal_residual <= 1e-8 and own.kkt_residual <= 1e-8

    def test_it_tells_wrong_sizes_and_wrong_multipliers(self) -> None:
        own = sizing(solve(gallery.load("residential-house")))
        x, pull = own.solution.x, own.solution.multipliers
        felt = int(np.argmax(np.abs(pull)))
        other = pull.copy()
        other[felt] *= -1.0
        shifted = x.copy()
        shifted[int(np.flatnonzero(own.system.weight)[0])] += 1e-3
        assert replace(own, solution=Solution(x, other, 1)).kkt_residual > 1e-3
        assert replace(own, solution=Solution(shifted, pull, 1)).kkt_residual > 1e-4
        assert replace(own, solution=Solution(shifted, pull, 1)).primal_residual > 1e-4

    def test_it_tells_a_multiplier_that_pulls_at_the_wrong_end(self) -> None:
        """x is drawn to 2 and held at its upper bound 1: the pull is 2 there. At the lower bound it would be none."""
        own = posed([1.0], [2.0], [[0.0]], [0.0, -FREE], [1.0, FREE])
        assert own is not None and own.multipliers == pytest.approx([2.0, 0.0])
        assert own.kkt_residual <= 1e-9
        system = replace(own.system, target=np.array([0.0]))
        wrong = Sizing(system, Solution(np.array([1.0]), np.array([-2.0, 0.0]), 1))
        assert wrong.kkt_residual >= 1.0


class TestForces:
    ONE = design({"A": 1.0, "B": 2.0}, {"a": "ABA"}, ["a"], 4.6)

    def test_the_canvas_pulls_what_is_too_short(self) -> None:
        own = sizing(solve(self.ONE))
        (edge,) = [force for force in own.forces() if force.kind == "bound" and force.name == "0:3"]
        assert edge.side == "equation" and edge.multiplier < 0 < edge.on["0:3"]
        assert own.tension == {"|A|": pytest.approx(0.48), "|B|": pytest.approx(0.24)}

    def test_and_presses_what_is_too_long(self) -> None:
        own = sizing(solve(edit.with_canvas(self.ONE, width=3.4)))
        (edge,) = [force for force in own.forces() if force.kind == "bound" and force.name == "0:3"]
        assert edge.multiplier > 0 > edge.on["0:3"]
        assert all(pull < 0 for pull in own.tension.values())

    @pytest.mark.parametrize("width", [3.4, 4.6, 5.0])
    def test_a_multiplier_is_what_a_little_more_canvas_would_change(self, width: float) -> None:
        def objective(own_width: float) -> float:
            return solve(edit.with_canvas(self.ONE, width=own_width)).x.deviation ** 2

        step = 1e-4
        slope = (objective(width + step) - objective(width - step)) / (2 * step)
        own = sizing(solve(edit.with_canvas(self.ONE, width=width)))
        pull = dict(zip(own.names, own.multipliers, strict=True))["0:3"]
        assert slope == pytest.approx(-pull, abs=1e-6)

    def test_a_bound_that_is_met(self) -> None:
        """|A| is kept from growing by its max; |B| has to grow more."""
        own = sizing(solve(design({"A": {"size": 1.0, "max": 1.1}, "B": 2.0}, {"a": "ABA"}, ["a"], 4.6)))
        (held,) = [force for force in own.forces() if force.name == "|A|"]
        assert (held.kind, held.side) == ("bound", "upper")
        assert held.multiplier > 0 and held.on == {"|A|": -held.multiplier}
        assert "|A|" in own.active and "|B|" not in own.active

    @pytest.mark.parametrize("name", QUICK)
    def test_forces_and_tension_are_in_balance(self, name: str) -> None:
        layout = solve(gallery.load(name))
        for axis in AXES:
            own = sizing(layout, axis)
            total: defaultdict[str, float] = defaultdict(float)
            forces = own.forces()
            for force in forces:
                assert force.name in own.active and force.multiplier != 0.0
                for variable, pull in force.on.items():
                    total[variable] += pull
            strength = [
                round(abs(f.multiplier), 9) for f in forces
            ]  # of those as strong the order is the system's
            assert strength == sorted(strength, reverse=True)
            for variable in own.system.variables:
                assert total[variable] == pytest.approx(own.tension.get(variable, 0.0), abs=1e-7)

    def test_names(self) -> None:
        own = sizing(solve(self.ONE))
        assert len(own.names) == len(own.multipliers) == own.solution.x.size + len(own.system.rows)
        assert {"|A|", "|B|", "0:0", "0:3"} <= set(own.names)
        assert any(name.endswith("= |B|") for name in own.names)

    def test_a_layout_that_was_read_has_none(self) -> None:
        layout = solve(self.ONE)
        again = Layout.from_dict(layout.to_dict())
        assert again.x.sizing is None and again == layout

    def test_nothing_pulls_where_everything_fits(self) -> None:
        own = sizing(solve(edit.with_canvas(self.ONE, width=4.0)))
        assert own.forces() == [] and own.kkt_residual <= 1e-9
