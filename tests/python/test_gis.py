"""Outlines of GIS: a shapefile and a GeoPackage, written here by their descriptions. They are read through GDAL, if it
is installed; else the error says what to install."""

import ctypes
import os
import sqlite3
import struct
import subprocess

import pytest

import temper

SQUARE = [(0, 0), (0, 1e3 + 1e-9), (2e3, 1e3), (2e3, 0), (0, 0)]  # clockwise: a shell
HOLE = [(800, 400), (1200, 400), (1200, 600), (800, 600), (800, 400)]
WELL = (300.0, 500.0)
PROJECTED = (
    'PROJCS["plane",GEOGCS["g",DATUM["d",SPHEROID["s",6378137,298.257223563]],PRIMEM["Greenwich",0],'
    'UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["central_meridian",9],'
    'PARAMETER["scale_factor",0.9996],UNIT["metre",1]]'
)


def has_gdal():
    names = [os.environ[v] for v in ["TEMPER_GDAL"] if v in os.environ] or [
        f"libgdal.so.{n}" for n in (36, 35, 34, 33, 32, 31, 30, 28)
    ]
    for name in names:
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return True
    return False


def polygon(rings):
    """The content of a polygon in a shapefile: type 5, box, counts, first points, points."""
    points = [p for ring in rings for p in ring]
    firsts = [sum(len(r) for r in rings[:i]) for i in range(len(rings))]
    xs, ys = zip(*points)
    content = struct.pack("<i4d2i", 5, min(xs), min(ys), max(xs), max(ys), len(rings), len(points))
    return content + struct.pack(f"<{len(rings)}i", *firsts) + b"".join(struct.pack("<2d", *p) for p in points)


def shapefile(folder, rings, fields):
    """One polygon with fields of text (C) or numbers (N) in dBase III."""
    content = polygon(rings)

    def header(bytes_in_file):
        return struct.pack(">i20xi", 9994, bytes_in_file // 2) + struct.pack("<2i8d", 1000, 5, *[0.0] * 8)

    record = struct.pack(">2i", 1, len(content) // 2) + content
    (folder / "coast.shp").write_bytes(header(100 + len(record)) + record)
    (folder / "coast.shx").write_bytes(header(108) + struct.pack(">2i", 50, len(content) // 2))
    width = 20
    table = struct.pack("<4BIHH20x", 3, 126, 1, 1, 1, 32 + 32 * len(fields) + 1, 1 + width * len(fields))
    for name, value in fields.items():
        kind = b"C" if isinstance(value, str) else b"N"
        table += struct.pack("<11sc4xBB14x", name.encode(), kind, width, 3 if isinstance(value, float) else 0)
    table += b"\r " + b"".join(str(v).encode().rjust(width) for v in fields.values()) + b"\x1a"
    (folder / "coast.dbf").write_bytes(table)
    (folder / "coast.prj").write_text(PROJECTED)
    return folder / "coast.shp"


def geopackage(folder):
    """A layer with a polygon, and one with a well; their geometries are headers "GP" and well-known binaries."""
    data = sqlite3.connect(folder / "coast.gpkg")
    data.executescript(
        f"""
        pragma application_id = 1196444487; pragma user_version = 10300;
        create table gpkg_spatial_ref_sys (srs_name text, srs_id integer primary key, organization text,
          organization_coordsys_id integer, definition text, description text);
        insert into gpkg_spatial_ref_sys values ('plane', 7, 'NONE', 7, '{PROJECTED}', '');
        create table gpkg_contents (table_name text primary key, data_type text, identifier text, description text,
          last_change datetime, min_x double, min_y double, max_x double, max_y double, srs_id integer);
        create table gpkg_geometry_columns (table_name text, column_name text, geometry_type_name text, srs_id integer,
          z tinyint, m tinyint);
        create table land (fid integer primary key, geom blob, name text, region integer);
        create table wells (fid integer primary key, geom blob, NAME text, tag integer, size real);
        """
    )
    for table, kind in (("land", "POLYGON"), ("wells", "POINT")):
        contents = "insert into gpkg_contents values (?, 'features', ?, '', '2026-01-01T00:00:00Z', 0, 0, 1, 1, 7)"
        data.execute(contents, (table, table))
        data.execute("insert into gpkg_geometry_columns values (?, 'geom', ?, 7, 0, 0)", (table, kind))
    head = b"GP\0\1" + struct.pack("<i", 7)
    shell, hole = SQUARE, HOLE
    wkb = struct.pack("<BII", 1, 3, 2) + b"".join(
        struct.pack("<I", len(r)) + b"".join(struct.pack("<2d", *p) for p in r) for r in (shell, hole)
    )
    data.execute("insert into land values (1, ?, 'bay', 3)", (head + wkb,))
    data.execute("insert into wells values (5, ?, 'well A', 8, 20)", (head + struct.pack("<BI2d", 1, 1, *WELL),))
    data.commit()
    data.close()
    return folder / "coast.gpkg"


@pytest.mark.parametrize("kind", ["shp", "gpkg"])
def test_a_map_is_an_outline(kind, in_scratch):
    fields = {"NAME": "bay", "REGION": 3}
    path = shapefile(in_scratch, [SQUARE, HOLE], fields) if kind == "shp" else geopackage(in_scratch)
    command = ["temper", "mesh", path, "--size", "100", "-o", "out.msh"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if not has_gdal():
        assert run.returncode == 1 and "need GDAL 3 or later" in run.stderr and "apt: libgdal32" in run.stderr
        assert not (in_scratch / "out.msh").exists()
        return
    assert run.returncode == 0 and "warning" not in run.stderr, run.stderr
    made = temper.read("out.msh")
    assert made.names["bay"] == (2, 3)
    places = {tuple(p) for p in made.points.tolist()}
    assert {*SQUARE, *HOLE} <= places, "bit for bit"
    if kind == "gpkg":
        assert WELL in places and made.names["well A"] == (0, 8)
