"""Where the view of a town and what belongs to it are found on a page."""

from __future__ import annotations

__all__ = ["CANVAS", "CONTEXT", "READ", "SESSION"]

CANVAS = ".fnb-town-view .fnb-town-canvas"
READ = """canvas => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let at = 0; at < data.length; at += 8192) text += String.fromCharCode(...data.subarray(at, at + 8192));
    return [canvas.width, canvas.height, btoa(text)];
}"""
CONTEXT = 'globalThis[Symbol.for("facade_nb.pipeline.context")]'
SESSION = "window.jupyterapp.shell.currentWidget.sessionContext.session"
