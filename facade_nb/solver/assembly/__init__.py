"""From solved axes to the layout: letters placed, shapes merged, holes found."""
