"""``python -m facade_nb infer``: a design from the surveyed openings of a building (docs/surveys.md)."""

from __future__ import annotations

import argparse
from itertools import islice
from pathlib import Path
from typing import Any

from .cli_ending import say
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
    parser.add_argument(
        "survey",
        type=Source,
        metavar="SURVEY_FILE",
        help="surveyed façades, or a city model: CityGML, CityJSON",
    )
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
    from .survey import SurveyError

    try:
        text = _inferred(Path(options.survey), options.building)
    except SurveyError as error:
        say(error)
        return 2
    write([(options.out, text)])
    return 0


def _inferred(path: Path, building: str | None) -> str:
    """The design of a building of a file, as JSON."""
    from .survey import SurveyError, buildings, infer, load_survey

    if not path.exists():
        raise SurveyError(f"survey: expected a file of surveyed façades; there is no {str(path)!r}")
    if building is None:
        known = buildings(path)
        if len(known) != 1:
            listed = ", ".join(map(cut, islice(known, _LISTED))) + (", …" if len(known) > _LISTED else "")
            found = f"{path} has {len(known)}: {listed}" if known else f"{path} has none"
            raise SurveyError(f"--building: expected the number of a façade; {found}")
        building = known[0]
    survey = load_survey(building, path)
    try:
        design = infer(survey.openings, survey.width, survey.height, survey.building)
    except SurveyError as error:
        raise SurveyError(f"{path}: building {cut(survey.building)}: {error}") from None
    return design.to_json() + "\n"
