"""What this temper is made of."""

from __future__ import annotations

from . import _temper


def build_info() -> dict[str, str]:
    """What ``temper --version`` prints, by the same names: ``"version"``, ``"commit"`` (``"unknown"`` where it was not
    built in a clone), ``"compiler"``, ``"processor"``, ``"instructions"``, ``"threads"``, and the versions of
    ``"oneTBB"``, ``"NetCDF"``, ``"HDF5"``, ``"zlib"``, ``"pugixml"``, ``"Clp"`` and ``"Eigen"``.

    libnetcdf and libhdf5 are looked for, and loaded, when this is asked.

    >>> import temper
    >>> temper.build_info()["version"] == temper.__version__
    True
    """
    return _temper.build_info()
