"""Footprints from GeoJSON: what can be used, in metres, and why the rest is left out."""

from __future__ import annotations

import gzip
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from ...design.errors import DesignError, Fault, cut, listed, nearest, quoted
from ...design.inputs import read_json_text, read_text
from .chance import Floats, millimetres
from .projection import to_metres
from .rings import Ints, areas, offsets_of, ring_numbers, take_rings

__all__ = ["Outlines", "read_outlines"]

LEAST = 4.0
"""Footprints are no smaller, square metres."""

FARTHEST = 60_000.0
"""They lie no further from the middle of the town, metres."""

MOST = 200_000
"""There are no more of them."""

_TYPES = ("FeatureCollection", "Feature", "GeometryCollection", "Polygon", "MultiPolygon")
_OTHERS = ("Point", "MultiPoint", "LineString", "MultiLineString")
_LINES = ("LineString", "MultiLineString")
_WORLD = ("crs84", "epsg:4326", "epsg::4326", "wgs84")


@dataclass(frozen=True, slots=True, eq=False)
class Outlines:
    """Footprints that can be used.

    Attributes
    ----------
    offsets, corners
        Rings, whole millimetres; x east, y north. Outer rings are counter-clockwise, courtyards clockwise.
    ring_of
        (r,) footprint of each ring; the outer one comes first.
    holes
        (r,) whether it is a courtyard.
    tags
        (b,) what is told of each.
    centre
        Longitude and latitude of the origin.
    left_out
        Why others were left out, and how many.
    roads
        Streets that are told: a line (p, 2) each in whole millimetres, and the value of its `highway`.
    """

    offsets: Ints
    corners: Floats
    ring_of: Ints
    holes: NDArray[np.bool_]
    tags: tuple[Mapping[str, Any], ...]
    centre: tuple[float, float]
    left_out: Mapping[str, int]
    roads: tuple[tuple[Floats, str], ...] = ()

    def polygons(self) -> NDArray[np.object_]:
        """As shapely's polygons."""
        return _polygons(self.offsets, self.corners, self.ring_of)


@dataclass(slots=True)
class _Found:
    """Polygons as they are read: rings of longitude and latitude, with their tags; and lines of streets."""

    polygons: list[list[Any]] = field(default_factory=list)
    tags: list[Mapping[str, Any]] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    roads: list[tuple[Floats, str]] = field(default_factory=list)


def read_outlines(source: Mapping[str, Any] | str | Path) -> Outlines:
    """Read footprints.

    Parameters
    ----------
    source
        GeoJSON: a FeatureCollection, a Feature or a geometry, or a file of it (``.geojson``, ``.json``, also ``.gz``).
        Longitude and latitude (WGS 84).

    Raises
    ------
    DesignError
        If it cannot be read, is no GeoJSON, is not in longitude and latitude, or if no footprint is left.
    """
    place, document = _document(source)
    _check(document, place)
    found = _Found()
    for geometry, tags in _geometries(document, {}, found.left_out):
        if geometry["type"] in _LINES:
            _take_road(geometry, str(tags["highway"]), found)
        else:
            _take(geometry, tags, found)
        if len(found.polygons) > MOST:
            raise DesignError(Fault(place, f"expected at most {MOST:,} footprints; there are more"))
    _buildings_only(found)
    outlines = _usable(found)
    if not outlines.tags:
        reasons = ", ".join(f"{count:,} {reason}" for reason, count in outlines.left_out.items())
        told = f"left out: {reasons}" if reasons else "there is no feature"
        if set(outlines.left_out) == {_RANGE}:
            told += "; are they metres of a map? Longitude and latitude (WGS 84) are needed"
        raise DesignError(Fault(place, f"expected footprints of buildings (polygons); found none: {told}"))
    return outlines


def _document(source: Mapping[str, Any] | str | Path) -> tuple[str, Any]:
    """The place to name in messages, and the document."""
    if isinstance(source, Mapping):
        return "", source
    if not isinstance(source, str | Path):
        raise DesignError(
            Fault("", f"expected GeoJSON as a dict, or the path of a file; found {type(source).__name__}")
        )
    path = Path(source)
    place = str(path)
    if isinstance(source, str) and source.lstrip()[:1] == "{":
        return "", read_json_text(source)
    try:
        with path.open("rb") as file:
            packed = file.read(2) == b"\x1f\x8b"
        text = (
            gzip.decompress(path.read_bytes()).decode("utf-8-sig") if packed else read_text(path, "GeoJSON")
        )
    except (gzip.BadGzipFile, EOFError, zlib.error) as error:
        raise DesignError(Fault(place, f"cannot be read as GeoJSON: its gzip is broken; {error}")) from error
    except UnicodeDecodeError as error:
        raise DesignError(Fault(place, "cannot be read as GeoJSON: it is not text in UTF-8")) from error
    except (OSError, ValueError) as error:
        if isinstance(error, DesignError):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise DesignError(Fault(place, f"cannot be read as GeoJSON: {reason}")) from error
    return place, read_json_text(text, place)


def _check(document: Any, place: str) -> None:
    """What the whole document must be."""
    if not isinstance(document, Mapping):
        what = "a list" if isinstance(document, list) else cut(repr(document))
        raise DesignError(Fault(place, f"expected GeoJSON, an object with a type; found {what}"))
    kind = document.get("type")
    if kind not in _TYPES and kind not in _OTHERS:
        told = "no type" if kind is None else quoted(kind)
        near = nearest(str(kind), _TYPES) if kind is not None else ""
        raise DesignError(
            Fault(_at(place, "type"), f"expected GeoJSON ({listed(_TYPES)}); found {told}{near}")
        )
    if kind == "FeatureCollection" and not isinstance(document.get("features"), list):
        raise DesignError(Fault(_at(place, "features"), "expected a list of features; found none"))
    crs = document.get("crs")
    if crs is None:
        return
    properties = crs.get("properties") if isinstance(crs, Mapping) else None
    name = str(properties.get("name", "")) if isinstance(properties, Mapping) else ""
    if not any(name.lower().replace(" ", "").endswith(end) for end in _WORLD):
        raise DesignError(
            Fault(
                _at(place, "crs"),
                f"expected longitude and latitude (WGS 84, CRS84 or EPSG:4326); found {quoted(name or crs)}",
            )
        )


def _at(place: str, name: str) -> str:
    return f"{place}: {name}" if place else name


def _geometries(
    value: Any, tags: Mapping[str, Any], left_out: Counter[str], depth: int = 0
) -> Iterator[tuple[Mapping[str, Any], Mapping[str, Any]]]:
    """Every geometry of a document, with the tags of its feature."""
    if not isinstance(value, Mapping) or depth > 20:
        left_out[_NO_FEATURE] += 1
        return
    kind = value.get("type")
    if kind == "FeatureCollection":
        features = value.get("features")
        for feature in features if isinstance(features, list) else []:
            yield from _geometries(feature, {}, left_out, depth + 1)
    elif kind == "Feature":
        own = value.get("properties")
        if value.get("geometry") is None:
            left_out[_EMPTY] += 1
        else:
            own = own if isinstance(own, Mapping) else {}
            yield from _geometries(value["geometry"], own, left_out, depth + 1)
    elif kind == "GeometryCollection":
        geometries = value.get("geometries")
        for geometry in geometries if isinstance(geometries, list) else []:
            yield from _geometries(geometry, tags, left_out, depth + 1)
    elif kind in ("Polygon", "MultiPolygon") or (kind in _LINES and tags.get("highway")):
        yield value, tags
    else:
        left_out[_NO_POLYGON if kind in _OTHERS else _NO_FEATURE] += 1


_NO_FEATURE = "not a feature or geometry"
_NO_POLYGON = "not a polygon"
_EMPTY = "empty"
_MALFORMED = "malformed coordinates"
_RANGE = "out of range (longitude ±180, latitude ±90)"
_CORNERS = "of fewer than three corners"
_SMALL = f"smaller than {LEAST:g} m²"
_CROSSED = "crossing itself"
_TWICE = "given twice"
_WITHIN = "within another"
_FAR = f"further than {FARTHEST / 1000:g} km from the others"
_OTHER = "not a building"


def _take(geometry: Mapping[str, Any], tags: Mapping[str, Any], found: _Found) -> None:
    """Note the polygons of a geometry."""
    coordinates = geometry.get("coordinates")
    if not isinstance(coordinates, list):
        found.left_out[_MALFORMED] += 1
        return
    for polygon in coordinates if geometry["type"] == "MultiPolygon" else [coordinates]:
        if polygon == [] or polygon == [[]]:
            found.left_out[_EMPTY] += 1
            continue
        rings = _rings(polygon)
        if rings is None:
            found.left_out[_MALFORMED] += 1
        elif any((np.abs(ring) > (180.0, 90.0)).any() for ring in rings):
            found.left_out[_RANGE] += 1
        else:
            found.polygons.append(rings)
            found.tags.append(tags)
    if geometry["type"] == "MultiPolygon" and not coordinates:
        found.left_out[_EMPTY] += 1


def _take_road(geometry: Mapping[str, Any], kind: str, found: _Found) -> None:
    """Note the lines of a street."""
    coordinates = geometry.get("coordinates")
    lines = _rings([coordinates] if geometry["type"] == "LineString" else coordinates)
    if lines is None:
        found.left_out[_MALFORMED] += 1
        return
    for line in lines:
        if (np.abs(line) > (180.0, 90.0)).any():
            found.left_out[_RANGE] += 1
        elif len(line) > 1:
            found.roads.append((line, kind))


def _rings(polygon: Any) -> list[Floats] | None:
    """The rings of a polygon as arrays (n, 2); heights in them are passed over. None: malformed."""
    if not isinstance(polygon, list):
        return None
    rings: list[Floats] = []
    for ring in polygon:
        try:
            # Numbers alone, as nearly always, need no closer look.
            plain = set(map(type, chain.from_iterable(ring))) <= {int, float}
            if not plain and any(isinstance(v, bool | str) for point in ring for v in point[:2]):
                return None
            points = np.array([(point[0], point[1]) for point in ring], np.float64)
        except (TypeError, ValueError, IndexError, KeyError, OverflowError):
            return None
        if points.ndim != 2 or not np.isfinite(points).all():
            return None
        rings.append(points)
    return rings


def _buildings_only(found: _Found) -> None:
    """Where some features are tagged as buildings, others are none."""
    tagged = [str(tags.get("building") or "no") != "no" for tags in found.tags]
    if any(tagged):
        found.left_out[_OTHER] += len(tagged) - sum(tagged)
        found.polygons = [own for own, good in zip(found.polygons, tagged, strict=True) if good]
        found.tags = [own for own, good in zip(found.tags, tagged, strict=True) if good]


def _usable(found: _Found) -> Outlines:
    """The polygons in metres, without those that cannot be used."""
    left_out = found.left_out
    counts = [len(rings) for rings in found.polygons]
    rings = [ring for polygon in found.polygons for ring in polygon]
    if not rings:
        return _nothing(left_out)
    ring_of = np.repeat(np.arange(len(counts)), counts)
    offsets = offsets_of(np.array([len(ring) for ring in rings]))
    places = np.concatenate(rings)
    centre = _centre(places, offsets, ring_of)
    corners = millimetres(to_metres(places, centre))
    far = np.zeros(len(counts), bool)
    np.logical_or.at(far, ring_of[ring_numbers(offsets)], (np.abs(corners) > FARTHEST).any(axis=1))
    offsets, corners = _cleaned(offsets, corners)
    outer = np.append(True, ring_of[1:] != ring_of[:-1])
    short = np.zeros(len(counts), bool)
    np.logical_or.at(short, ring_of, np.diff(offsets) < 3)
    holes = ~outer
    signed = areas(corners, offsets)
    corners = _turned(offsets, corners, (signed < 0) != holes)
    sizes = np.zeros(len(counts))
    np.add.at(sizes, ring_of, np.where(holes, -np.abs(signed), np.abs(signed)))
    reason = np.full(len(counts), "", object)
    reason[far] = _FAR
    reason[(reason == "") & short] = _CORNERS
    good = reason == ""
    polygons = _some_polygons(offsets, corners, ring_of, good)
    valid = np.ones(len(counts), bool)
    valid[good] = shapely.is_valid(polygons)
    # A figure of eight may have no area: it crosses itself all the same.
    reason[good & ~valid & (np.abs(sizes) < LEAST) & ~_crosses(polygons, good)] = _SMALL
    reason[(reason == "") & ~valid] = _CROSSED
    reason[(reason == "") & (sizes < LEAST)] = _SMALL
    for drop, why in ((_twice, _TWICE), (_within, _WITHIN)):
        good = reason == ""
        polygons = _some_polygons(offsets, corners, ring_of, good)
        reason[np.flatnonzero(good)[drop(polygons)]] = why
    for why in (_FAR, _CORNERS, _SMALL, _CROSSED, _TWICE, _WITHIN):
        left_out[why] += int((reason == why).sum())
    kept = reason == ""
    rings_kept = np.flatnonzero(kept[ring_of])
    index, new = take_rings(offsets, rings_kept)
    number = np.cumsum(kept) - 1
    tags = tuple(own for own, good in zip(found.tags, kept.tolist(), strict=True) if good)
    told = {why: count for why, count in left_out.items() if count}
    roads = ((millimetres(to_metres(line, centre)), kind) for line, kind in found.roads)
    near = tuple((line, kind) for line, kind in roads if (np.abs(line) <= FARTHEST).all())
    number = number[ring_of[rings_kept]]
    return Outlines(new, corners[index], number, holes[rings_kept], tags, centre, told, near)


def _nothing(left_out: Counter[str]) -> Outlines:
    none = np.zeros(0, np.int64)
    told = {why: count for why, count in left_out.items() if count}
    return Outlines(np.zeros(1, np.int64), np.zeros((0, 2)), none, none > 0, (), (0.0, 0.0), told)


def _centre(places: Floats, offsets: Ints, ring_of: Ints) -> tuple[float, float]:
    """The middle one of all footprints, longitude and latitude apart; also where they lie on both sides of 180°."""
    outer = np.append(True, ring_of[1:] != ring_of[:-1])
    counts = np.diff(offsets)
    first = places[np.minimum(offsets[:-1], len(places) - 1)][outer & (counts > 0)]
    if not len(first):
        return 0.0, 0.0
    turned = (first[:, 0] - first[0, 0] + 540) % 360 - 180
    middle = [float(np.sort(v)[len(v) // 2]) for v in (turned, first[:, 1])]
    lon = (middle[0] + float(first[0, 0]) + 540) % 360 - 180
    return round(lon, 6), round(middle[1], 6)


def _cleaned(offsets: Ints, corners: Floats) -> tuple[Ints, Floats]:
    """Rings without the corner that closes them, and without corners that are the same as the next one."""
    counts = np.diff(offsets)
    following = np.arange(1, len(corners) + 1)
    ends = offsets[1:][counts > 0] - 1
    following[ends] = offsets[:-1][counts > 0]
    kept = (corners != corners[following]).any(axis=1)
    rings = ring_numbers(offsets)
    return offsets_of(np.bincount(rings[kept], minlength=len(counts))), corners[kept]


def _turned(offsets: Ints, corners: Floats, turn: NDArray[np.bool_]) -> Floats:
    """Corners with some rings in the other sense."""
    rings = ring_numbers(offsets)
    mirrored = offsets[:-1][rings] + offsets[1:][rings] - 1 - np.arange(len(corners))
    return corners[np.where(turn[rings], mirrored, np.arange(len(corners)))]


def _polygons(offsets: Ints, corners: Floats, ring_of: Ints) -> NDArray[np.object_]:
    rings = shapely.linearrings(corners, indices=ring_numbers(offsets))
    outer = np.append(True, ring_of[1:] != ring_of[:-1])
    shells = rings[outer]
    if outer.all():
        return np.asarray(shapely.polygons(shells), object)
    numbers = np.cumsum(outer) - 1
    made = np.asarray(shapely.polygons(shells), object)
    for k in np.unique(numbers[~outer]).tolist():
        made[k] = shapely.polygons(shells[k], holes=list(rings[~outer & (numbers == k)]))
    return made


def _some_polygons(
    offsets: Ints, corners: Floats, ring_of: Ints, chosen: NDArray[np.bool_]
) -> NDArray[np.object_]:
    """The polygons of some footprints, all of whose rings have three corners."""
    if not chosen.any():
        return np.zeros(0, object)
    rings = np.flatnonzero(chosen[ring_of])
    index, new = take_rings(offsets, rings)
    return _polygons(new, corners[index], ring_of[rings])


def _crosses(polygons: NDArray[np.object_], good: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether an outline crosses itself, for footprints that are `good`."""
    crossed = np.zeros(len(good), bool)
    crossed[good] = ~shapely.is_simple(shapely.boundary(polygons))
    return crossed


def _twice(polygons: NDArray[np.object_]) -> NDArray[np.bool_]:
    """Which are the same as one before."""
    seen: set[bytes] = set()
    again = []
    for key in shapely.to_wkb(shapely.normalize(polygons)) if len(polygons) else []:
        again.append(key in seen)
        seen.add(key)
    return np.array(again, bool)


def _within(polygons: NDArray[np.object_]) -> NDArray[np.bool_]:
    """Which lie within another: parts that are drawn over a whole."""
    inside = np.zeros(len(polygons), bool)
    if len(polygons):
        one, other = shapely.STRtree(polygons).query(polygons, predicate="covered_by")
        inside[one[one != other]] = True
    return inside
