"""``python -m facade_nb infer``: a design from the surveyed openings of a building (docs/surveys.md)."""

from __future__ import annotations

import argparse
from itertools import islice
from pathlib import Path
from typing import Any

from .cli_files import STANDARD_OUTPUT, Output, Source, write
from .design.errors import cut

__all__ = ["add_infer"]

_LISTED = 20


def add_infer(commands: Any) -> None:
    """Add the command to a parser's commands."""
    parser = commands.add_parser(
        "infer",
        help="make a design from a survey",
        description="Make a design from surveyed openings. Without --out it goes to standard output.",
    )
    parser.add_argument("survey", type=Source, metavar="SURVEY.json", help="surveyed façades")
    parser.add_argument("--building", metavar="ID", help="which façade; default: the only one")
    parser.add_argument(
        "--out",
        type=Output,
        default=STANDARD_OUTPUT,
        metavar="DESIGN.json",
        help="write the design; -: standard output",
    )
    parser.set_defaults(run=_infer)


def _infer(options: argparse.Namespace) -> int:
    from .survey import SurveyError, buildings, infer, load_survey

    path = Path(options.survey)
    building = options.building
    if building is None:
        known = buildings(path)
        if len(known) != 1:
            listed = ", ".join(map(cut, islice(known, _LISTED))) + (", …" if len(known) > _LISTED else "")
            found = f"found {len(known)} in {path}: {listed}" if known else f"{path} has none"
            raise SurveyError(f"--building: expected one of the façades; {found}")
        building = known[0]
    survey = load_survey(building, path)
    try:
        design = infer(survey.openings, survey.width, survey.height, survey.building)
    except SurveyError as error:
        raise SurveyError(f"{path}: building {cut(survey.building)}: {error}") from None
    write([(options.out, design.to_json() + "\n")])
    return 0
