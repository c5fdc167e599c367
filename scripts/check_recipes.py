#!/usr/bin/env python3
"""Reads filled recipes as the tools of their systems do, as far as Python packages hold those tools.

    scripts/check_recipes.py RECIPES     RECIPES: what scripts/recipes.sh wrote; scripts/lint.sh calls this

conda: rattler-build renders the recipe for three platforms. winget: TEMPER_WINGET_SCHEMAS names the folder of its JSON schemas
(schemas/JSON/manifests of microsoft/winget-cli), without which only the keys are compared. All: each option TEMPER_… that a
recipe sets is one of CMakeLists.txt, and each recipe has the version of the release.
"""

import ast
import json
import os
import pathlib
import re
import sys

import jsonschema
import rattler_build
import ruamel.yaml

ROOT = pathlib.Path(__file__).resolve().parents[1]
PLATFORMS = ["linux-64", "linux-aarch64", "osx-arm64"]
WINGET_KEYS = {"PackageIdentifier", "PackageVersion", "ManifestType", "ManifestVersion"}


def check_options(recipes):
    cmake = "\n".join(path.read_text() for path in [ROOT / "CMakeLists.txt", *(ROOT / "cmake").rglob("*.cmake"), *(ROOT / "python").glob("*.txt")])
    known = set(re.findall(r"\b(TEMPER_[A-Z0-9_]+)\b", cmake))
    for path in sorted(recipes.rglob("*.*")):
        used = set(re.findall(r"(?:-D|\"|\s)(TEMPER_[A-Z0-9_]+)", path.read_text()))
        for option in sorted(used - known - {"TEMPER_NETCDF", "TEMPER_HDF5"}):  # variables of the environment
            yield f"{path.relative_to(recipes)}: CMake has no option {option}"


def check_conda(recipes):
    recipe = rattler_build.Stage0Recipe.from_file(recipes / "conda/recipe.yaml")
    for platform in PLATFORMS:
        config = rattler_build.RenderConfig(platform=rattler_build.PlatformConfig(target_platform=platform))
        stdlib = "macosx_deployment_target" if platform.startswith("osx") else "sysroot"  # as conda-forge sets them
        variants = rattler_build.VariantConfig({"python": ["3.10", "3.14"], "c_stdlib": [stdlib]})
        rendered = recipe.render(variants, config)
        if len(rendered) != 2:
            yield f"conda: expected two variants on {platform}, found {len(rendered)}"


def check_vcpkg(recipes):
    port = json.loads((recipes / "vcpkg/vcpkg.json").read_text())
    features = re.search(r"FEATURES\n(.*?)\)", (recipes / "vcpkg/portfile.cmake").read_text(), re.DOTALL)[1]
    if set(port["features"]) != set(features.split()[::2]):
        yield "vcpkg: vcpkg.json and portfile.cmake differ in their features"


def check_spack(recipes):
    try:
        ast.parse((recipes / "spack/package.py").read_text())
    except SyntaxError as error:
        yield f"spack: {error}"


def check_winget(recipes):
    schemas = os.environ.get("TEMPER_WINGET_SCHEMAS")
    for path in sorted((recipes / "winget").glob("*.yaml")):
        manifest = ruamel.yaml.YAML(typ="safe").load(path)
        kind, version = manifest["ManifestType"], manifest["ManifestVersion"]
        if schemas:
            schema = json.loads((pathlib.Path(schemas) / f"v{version}/manifest.{kind}.{version}.json").read_text())
            for error in jsonschema.Draft7Validator(schema).iter_errors(manifest):
                yield f"{path.name}: {'/'.join(map(str, error.path))}: {error.message}"
        elif not WINGET_KEYS <= manifest.keys():
            yield f"{path.name}: missing {', '.join(sorted(WINGET_KEYS - manifest.keys()))}"


def main(folder):
    recipes = pathlib.Path(folder)
    wrong = [line for check in [check_options, check_conda, check_vcpkg, check_spack, check_winget] for line in check(recipes)]
    print("\n".join(wrong) if wrong else f"{sum(path.is_file() for path in recipes.rglob('*'))} files of recipes")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
