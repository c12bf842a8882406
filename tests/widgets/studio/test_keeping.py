"""Designs kept beside the notebook: what comes back, and what is never overwritten unasked."""

from __future__ import annotations

import asyncio
import json
import os
from pathlib import Path
from typing import Any

import pytest

from facade_nb import Design
from facade_nb.design.edit import with_canvas
from facade_nb.widgets import FacadeModel, Studio
from facade_nb.widgets.studio import keeping
from facade_nb.widgets.studio.keeping import Keeper, Kept, kept_path

from ..houses import house

GONE = 2**22 + 1  # no process has such a number
WIDE, WIDER = with_canvas(house(), width=8.0), with_canvas(house(), width=9.0)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / ".facade_nb" / "notebook" / "cell.json"


def edited(file: Path) -> Keeper:
    """A model that was edited twice while it was kept."""
    keeper = Keeper(FacadeModel(house()), file)
    keeper.model.edit(WIDE)
    keeper.model.edit(WIDER)
    return keeper


def written_by(file: Path, **writer: Any) -> None:
    """Have a file be another kernel's."""
    document = json.loads(file.read_text())
    document["writer"] |= {"token": "another", **writer}
    file.write_text(json.dumps(document))


def test_nothing_is_written_until_something_is_edited(file: Path) -> None:
    keeper = Keeper(FacadeModel(house()), file)
    keeper.model.select(0)
    keeper.close()
    assert not file.exists()


def test_what_a_kernel_that_has_gone_left_comes_back_with_its_history(file: Path) -> None:
    edited(file)
    written_by(file, pid=GONE)
    model = FacadeModel(house())
    keeper = Keeper(model, file)
    assert keeper.state == "restored"
    assert model.design == WIDER
    model.undo()
    assert model.design == WIDE
    model.undo()
    assert model.design == house()
    model.redo()
    model.redo()
    assert model.design == WIDER and not model.can_redo


def test_redo_comes_back_too(file: Path) -> None:
    keeper = edited(file)
    keeper.model.undo()
    written_by(file, pid=GONE)
    model = FacadeModel(house())
    Keeper(model, file)
    assert model.design == WIDE
    model.redo()
    assert model.design == WIDER


def test_one_can_begin_anew_and_change_ones_mind(file: Path) -> None:
    edited(file)
    written_by(file, pid=GONE)
    keeper = Keeper(FacadeModel(house()), file)
    keeper.anew()
    assert keeper.model.design == house()
    assert keeper.state == "on"
    keeper.model.undo()
    assert keeper.model.design == WIDER


def test_a_cell_that_is_run_again_in_its_kernel_offers_what_was(file: Path) -> None:
    edited(file).close()
    keeper = Keeper(FacadeModel(house()), file)
    assert keeper.state == "offered"
    assert keeper.model.design == house()
    keeper.restore()
    assert keeper.model.design == WIDER and keeper.state == "on"


def test_a_cell_that_is_run_again_at_once_offers_the_last_edit_too(file: Path) -> None:
    async def again() -> Keeper:  # with a loop, an edit is written a moment later
        before = edited(file)
        after = Keeper(FacadeModel(house()), file)
        assert before.state == "on"
        return after

    keeper = asyncio.run(again())
    assert keeper.state == "offered"
    keeper.restore()
    assert keeper.model.design == WIDER


def test_a_cell_that_makes_another_design_gets_that_one(file: Path) -> None:
    edited(file)
    written_by(file, pid=GONE)
    other = Design("Another")
    keeper = Keeper(FacadeModel(other), file)
    assert keeper.model.design == other
    assert keeper.state == "offered"
    keeper.model.edit(with_canvas(other, width=7.0))
    before = Kept.read(file.with_suffix(".before.json"))
    assert before is not None and before.design == WIDER


def test_another_kernel_that_lives_is_not_overwritten_until_one_says_so(file: Path) -> None:
    edited(file)
    written_by(file, pid=os.getppid())
    model = FacadeModel(house())
    keeper = Keeper(model, file)
    assert keeper.state == "elsewhere"
    model.edit(WIDE)
    kept = Kept.read(file)
    assert kept is not None and kept.design == WIDER
    keeper.settle()
    keeper.write()
    kept = Kept.read(file)
    assert kept is not None and kept.design == WIDE


def test_a_kernel_that_comes_later_is_noticed(file: Path) -> None:
    told: list[str] = []
    keeper = Keeper(FacadeModel(house()), file, lambda: told.append(keeper.state))
    keeper.model.edit(WIDER)
    written_by(file, pid=os.getppid())
    keeper.model.edit(WIDE)
    assert keeper.state == "elsewhere"
    assert told == ["elsewhere"]
    kept = Kept.read(file)
    assert kept is not None and kept.design == WIDER


@pytest.mark.parametrize("text", ["", "{", "[]", '{"format": "facade-nb/kept/1"}', '{"format": "x"}'])
def test_a_file_that_cannot_be_read_is_no_obstacle(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True)
    file.write_text(text)
    keeper = edited(file)
    assert keeper.state == "on"
    kept = Kept.read(file)
    assert kept is not None and kept.design == WIDER


def test_where_it_cannot_be_written_that_is_said_until_it_can(tmp_path: Path) -> None:
    folder = tmp_path / ".facade_nb"
    folder.write_text("not a folder")
    keeper = edited(folder / "notebook" / "cell.json")
    assert keeper.state == "failed" and keeper.reason
    folder.unlink()
    keeper.model.edit(WIDE)
    assert keeper.state == "on"


def test_the_folder_is_nobodys_to_commit(file: Path) -> None:
    edited(file)
    assert (file.parents[1] / ".gitignore").read_text() == "*\n"


def test_a_studio_is_kept_by_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    studio = Studio(house(), name="my house")
    studio.model.edit(WIDE)
    kept = Kept.read(kept_path("designs", "my house"))
    assert kept is not None and kept.design == WIDE
    assert Studio(house()).channel.keeper is None  # no notebook, no name
    assert Studio(FacadeModel(house())).channel.keeper is None
    assert keeping.studio_name() is None


def test_what_a_studio_restored_is_what_it_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Studio(house(), name="mine").model.edit(WIDE)
    written_by(kept_path("designs", "mine"), pid=GONE)
    studio = Studio(house(), name="mine")
    assert studio.channel.design["canvas"]["width"] == 8.0
    assert studio.channel.stage["keeping"]["state"] == "restored"
    assert Design.from_json(studio.channel.document) == WIDE
