"""What the stage can ask for: one function per operation, each taking the channel and the message."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ...design import Design, DesignError, Fault
from ..shared.bundled import Message
from .beginnings import begun, empty, survey_of, thumbnail
from .commands import Reply, file_name
from .exports import export
from .extras import Snapshot
from .facts import Remedy, apply_remedy
from .fields import apply
from .foretold import foretold
from .python_code import python_of
from .wire import describe_faults

if TYPE_CHECKING:
    from .channel import Channel

__all__ = ["REQUESTS"]

_MOST_SNAPSHOTS = 12


def _want(channel: Channel, message: Message) -> Reply:
    channel.want(str(message["what"]), str(message["client"]), bool(message["on"]))
    return None


def _thumbnail(channel: Channel, message: Message) -> Reply:
    name, theme = str(message["name"]), channel.theme

    def work() -> dict[str, Any]:
        return {"kind": "thumbnail", "name": name, "theme": theme, "svg": thumbnail(name, theme)}

    return channel.later(work, _tag(message))


def _new(channel: Channel, message: Message) -> Reply:
    """An empty canvas of a size, as typed, with a first pattern."""
    model = channel.model
    sized = _sized(Design(model.design.name), message)
    name = "Untitled" if model.design.layers else model.design.name
    model.load(empty(name, sized.canvas.width, sized.canvas.height))
    return {"kind": "begun", "pattern": "P1"}


def _sized(design: Design, message: Message) -> Design:
    """A design with the canvas that was typed, if one was."""
    for side in ("width", "height"):
        if side in message:
            design = apply(design, ("canvas", side), message[side])
    return design


def _begin(channel: Channel, message: Message) -> Reply:
    """A façade from the pattern that was typed."""
    model = channel.model
    text = str(message["text"])
    try:
        model.load(begun(_sized(Design(model.design.name, model.design.canvas), message), text))
    except DesignError as error:
        return {"kind": "unbegun", "faults": describe_faults(error.faults)}
    return {"kind": "begun", "pattern": "across"}


def _survey(channel: Channel, message: Message) -> Reply:
    building = str(message["building"])
    design, survey = survey_of(building)
    channel.model.load(design)
    channel.surveyed = survey
    return {"kind": "opened", "name": f"building {building}"}


def _export(channel: Channel, message: Message) -> Reply:
    model, key = channel.model, str(message["key"])

    def work() -> dict[str, Any]:
        try:
            return export(model, key)
        except DesignError as error:
            return {"kind": "refused", "faults": describe_faults(error.faults)}

    return channel.later(work, _tag(message)) if key == "png" else work()


def _python(channel: Channel, _: Message) -> Reply:
    design = channel.model.design
    return {"kind": "python", "name": f"{file_name(design.name)}.py", "text": python_of(design)}


def _snapshot(channel: Channel, _: Message) -> Reply:
    """Put the present design aside."""
    model, taken = channel.model, channel.taken
    if taken and taken[-1].design == model.design:
        return {
            "kind": "note",
            "text": f"Snapshot {taken[-1].number} is the same: nothing was changed since.",
        }
    number = taken[-1].number + 1 if taken else 1
    layout = None if model.stale or model.busy else model.layout
    channel.taken = [*taken, Snapshot(number, model.design, layout)][-_MOST_SNAPSHOTS:]
    return {"kind": "note", "text": f"Snapshot {number} taken."}


def _forget(channel: Channel, message: Message) -> Reply:
    channel.taken = [one for one in channel.taken if one.number != message["number"]]
    return None


def _bring_back(channel: Channel, message: Message) -> Reply:
    """Make a snapshot the design, as a step that can be undone."""
    for one in channel.taken:
        if one.number == message["number"]:
            channel.model.load(one.design)
            return {"kind": "opened", "name": f"snapshot {one.number}"}
    return None


def _stop(channel: Channel, _: Message) -> Reply:
    """End the solve under way, and say what is kept."""
    model = channel.model
    if not model.busy:
        return None
    model.stop()
    kept = "the layout that was shown last" if model.layout is not None else "nothing"
    text = f"Cancelled. The best layout found so far is taken; if there is none yet, {kept} stays."
    return {"kind": "note", "text": text}


def _limit(channel: Channel, message: Message) -> Reply:
    """Search for so many seconds from now on."""
    try:
        seconds = float(str(message["seconds"]).replace(",", "."))
    except ValueError:
        seconds = 0.0
    if not 0 < seconds <= 86400:
        raise DesignError(
            Fault("limit", f"expected seconds, more than 0 and at most 86400; found {message['seconds']!r}")
        )
    channel.model.solve_for(seconds)
    return None


def _remedy(channel: Channel, message: Message) -> Reply:
    apply_remedy(channel.model, Remedy(int(message["warning"]), str(message["text"])))
    return None


def _keep(channel: Channel, message: Message) -> Reply:
    """Answer what is said of the design that was kept."""
    if channel.keeper is not None:
        answers = {
            "restore": channel.keeper.restore,
            "anew": channel.keeper.anew,
            "settle": channel.keeper.settle,
        }
        answers[message["answer"]]()
    return None


def _foretell(channel: Channel, message: Message) -> Reply:
    """What another width of the canvas would bring; the design stays."""
    model, width = channel.model, float(message["width"])
    design, layout = model.design, None if model.stale or model.busy else model.layout
    return channel.later(lambda: foretold(design, layout, width), _tag(message))


def _tag(message: Message) -> dict[str, Any]:
    return {"client": message.get("client", ""), "seq": message.get("seq", 0)}


REQUESTS: dict[str, Callable[[Channel, Message], Reply]] = {
    "want": _want,
    "thumbnail": _thumbnail,
    "new": _new,
    "begin": _begin,
    "survey": _survey,
    "export": _export,
    "python": _python,
    "snapshot": _snapshot,
    "forget": _forget,
    "bring-back": _bring_back,
    "stop": _stop,
    "limit": _limit,
    "remedy": _remedy,
    "keep": _keep,
    "foretell": _foretell,
}
