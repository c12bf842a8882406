"""The schema of designs: ``python -m scripts.docs.schema`` writes docs/design.schema.json and the page's tables."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from facade_nb.design import design_schema
from facade_nb.design.files import write_atomically

from .tables import with_tables

__all__ = ["refresh"]

DOCS = Path(__file__).resolve().parents[2] / "docs"


def _kind(schema: dict[str, Any]) -> str:
    """What a value is, in words."""
    if "anyOf" in schema:
        return " or ".join(map(_kind, schema["anyOf"]))
    if "$ref" in schema:
        name = schema["$ref"].rpartition("/")[2]
        return f"[{name}](#{name})"
    if "const" in schema or "enum" in schema:
        return ", ".join(f"`{json.dumps(value)}`" for value in schema.get("enum", [schema.get("const")]))
    match schema["type"]:
        case "array":
            return f"list: {_kind(schema['items'])}"
        case "object" if isinstance(schema["additionalProperties"], dict):
            return f"object, by name: {_kind(schema['additionalProperties'])}"
        case "object" if "width" in schema["properties"]:
            return "[canvas](#canvas)"
        case "object":
            return "object, as below"
        case "string":
            return "text"
        case "number" | "integer" as kind:
            low, high = (f"{schema[key]:,.6f}".rstrip("0").rstrip(".") for key in ("minimum", "maximum"))
            return f"{'whole number' if kind == 'integer' else 'number'}, {low} to {high}"
        case kind:
            return {"boolean": "true or false"}.get(kind, kind)


def _table(schema: dict[str, Any]) -> str:
    required = schema.get("required", [])
    rows = ["| field | value | default | |", "|---|---|---|---|"]
    for name, member in schema["properties"].items():
        default = (
            "*required*"
            if name in required
            else f"`{json.dumps(member['default'])}`"
            if "default" in member
            else ""
        )
        rows.append(f"| `{name}` | {_kind(member)} | {default} | {member.get('description', '')} |")
    return "\n".join(rows)


def tables() -> str:
    """A table for each kind of object."""
    whole = design_schema()
    parts = [f"## The document\n\n{_table(whole)}", f"## canvas\n\n{_table(whole['properties']['canvas'])}"]
    for name, part in whole["$defs"].items():
        table = _table(next((own for own in [part, *part.get("anyOf", [])] if "properties" in own), part))
        parts.append(f"## {name}\n\n{part['description']}\n\n{table}")
    return "\n\n".join(parts)


def refresh(page: str) -> str:
    """The page with its tables made anew."""
    return with_tables(page, {"schema": f"\n{tables()}\n"})


if __name__ == "__main__":
    write_atomically(
        DOCS / "design.schema.json", json.dumps(design_schema(), ensure_ascii=False, indent=2) + "\n"
    )
    page = DOCS / "design-schema.md"
    write_atomically(page, refresh(page.read_text("utf-8")))
