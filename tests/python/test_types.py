"""Arguments of a wrong class are a TypeError or a ValueError for each public function, as promised."""

import inspect
import warnings

import pytest
import temper

WRONG = [None, 1, "x", object(), [], {}]
MODULES = [temper, temper.energy, temper.generate, temper.geometry, temper.projection, temper.size, temper.topology]
SILENT = {"use_instruction_set"}  # changes all calls that follow


def public_functions():
    found = {}
    for module in MODULES:
        for name in module.__all__:
            value = getattr(module, name)
            if not callable(value) or name in SILENT or (inspect.isclass(value) and issubclass(value, Exception)):
                continue
            found[f"{module.__name__}.{name}"] = value
            for inner, raw in vars(value).items() if inspect.isclass(value) else ():
                if isinstance(raw, (classmethod, staticmethod)) and not inner.startswith("_"):
                    found[f"{module.__name__}.{name}.{inner}"] = getattr(value, inner)
    return found


def calls(function):
    """Arguments that are all wrong, or wrong behind a mesh, and each option alone."""
    places = [p for p in inspect.signature(function).parameters.values() if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
    needed = [p for p in places if p.default is p.empty and p.kind is not p.KEYWORD_ONLY]
    takes_mesh = bool(needed) and needed[0].name == "mesh"
    for wrong in WRONG:
        if needed:
            yield [wrong] * len(needed), {}
        if takes_mesh:
            yield [temper.generate.sheared_grid(3, 3)] + [wrong] * (len(needed) - 1), {}
        if len(needed) == takes_mesh:
            for option in places[len(needed) :]:
                yield [temper.generate.sheared_grid(3, 3)] * takes_mesh, {option.name: wrong}


@pytest.mark.parametrize("name", sorted(public_functions()))
def test_a_wrong_class_is_a_type_error(name):
    function = public_functions()[name]
    try:
        inspect.signature(function)
    except ValueError:
        pytest.skip("a function of the compiled module")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for arguments, options in calls(function):
            try:
                function(*arguments, **options)
            except (TypeError, ValueError, OSError, ImportError):  # TemperError is a ValueError
                pass


def test_what_is_no_mesh_of_meshio_is_told():
    with pytest.raises(TypeError, match="mesh: expected a meshio.Mesh, found NoneType"):
        temper.from_meshio(None)
    with pytest.raises(TypeError, match="model: expected an EnergyModel, found int"):
        temper.energy.total_energy(temper.generate.sheared_grid(3, 3), 1)
