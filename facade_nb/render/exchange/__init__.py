"""Files for other programs: OBJ, DXF, PDF, CityJSON, and the schedule (docs/exchange.md).

Each format has a function that makes the file's contents (`to_dxf`) and one that writes it (`write_dxf`). The libraries
that they need (ezdxf, reportlab, shapely, pandas) are loaded when a file is made.
"""

from .cityjson import to_cityjson, write_cityjson
from .dxf import to_dxf, write_dxf
from .obj import obj_files, to_obj, write_obj
from .pdf import to_pdf, write_pdf
from .schedule import schedule, to_schedule, write_schedule

__all__ = [
    "obj_files",
    "schedule",
    "to_cityjson",
    "to_dxf",
    "to_obj",
    "to_pdf",
    "to_schedule",
    "write_cityjson",
    "write_dxf",
    "write_obj",
    "write_pdf",
    "write_schedule",
]
