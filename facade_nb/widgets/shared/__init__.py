"""What the widgets of all rooms share: the front end's code, undo."""
