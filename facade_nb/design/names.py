"""Names of any script: one form in which they are compared, and Unicode's rule of what an identifier is."""

from __future__ import annotations

from unicodedata import normalize

__all__ = ["is_identifier", "nfc"]


def nfc(text: str) -> str:
    """The text in Unicode's composed form: é is one character, however it was typed."""
    return normalize("NFC", text)


def is_identifier(text: str) -> bool:
    """Whether the text is an identifier of any script by Unicode's rule (UAX 31).

    It begins with a letter (XID_Start) or an underscore, and goes on with letters, marks, digits and
    underscores (XID_Continue).
    """
    return nfc(text).isidentifier()
