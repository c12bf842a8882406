"""How far a town has come, and whether it is still wanted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...design.errors import FacadeError

__all__ = ["Stages", "TownStopped"]


class TownStopped(FacadeError):
    """Raised where `should_stop` said so: there is no town."""


@dataclass(frozen=True, slots=True)
class Stages:
    """Tells how far a town has come.

    Attributes
    ----------
    progress
        Called with the part that is done, from 0 to 1, and with what comes next: ``"streets"``.
    should_stop
        Asked between stages; `TownStopped` is raised when it says yes.
    """

    progress: Callable[[float, str], None] | None = None
    should_stop: Callable[[], bool] | None = None

    def at(self, share: float, name: str) -> None:
        """A stage begins."""
        if self.should_stop is not None and self.should_stop():
            raise TownStopped(f"the town was stopped before its {name}, at {share:.0%}")
        if self.progress is not None:
            self.progress(share, name)

    def done(self) -> None:
        """There is a town: nobody is asked any more whether it is wanted."""
        if self.progress is not None:
            self.progress(1.0, "")
