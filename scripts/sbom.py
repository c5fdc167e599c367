#!/usr/bin/env python3
"""Writes the bill of materials of a release as CycloneDX: FOLDER/temper-X.Y.Z.cdx.json.

    scripts/sbom.py FOLDER     in the Python of scripts/release-requirements.txt

Each file of the release is a component with its checksum. Inside it are the libraries of others that the file itself names:
in a wheel, in the zip and in the npm package, the licenses NAME_VERSION.txt; in a Debian package, its dependencies; in the npm
package, also what its package.json lists; and in all of them the libraries of the HTML report, from its NOTICE.
"""

import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tarfile
import zipfile

from cyclonedx.model import HashAlgorithm, HashType
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.model.license import LicenseExpression
from cyclonedx.output.json import JsonV1Dot6
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from packageurl import PackageURL

from version import ROOT, version


def library(name, found, kind="generic", namespace=None):
    return Component(name=name, version=found or None, type=ComponentType.LIBRARY, purl=PackageURL(kind, namespace, name, found or None))


def report_libraries():
    """d3-array 3.2.4 (ISC), …: the headings of the notice."""
    notice = (ROOT / "web/report/dist/NOTICE").read_text()
    return [library(name, found, "npm") for name, found in re.findall(r"^(\S+) (\d[\w.]*) \([^)]*\)$", notice, re.MULTILINE)]


def licensed_libraries(path, names):
    """licenses/NAME_VERSION.txt, which cmake/cross/libraries.cmake writes for each library that it puts into temper."""
    found = [library(*match.groups()) for name in names if (match := re.search(r"/licenses/([^/_]+)_([^/]+)\.txt$", name))]
    if not found:
        sys.exit(f"sbom: {path.name} has no licenses of the libraries inside it")
    return found


def zip_libraries(path):
    with zipfile.ZipFile(path) as files:
        return licensed_libraries(path, files.namelist())


def debian_libraries(path):
    depends = subprocess.run(["dpkg-deb", "--field", path, "Depends"], capture_output=True, text=True, check=True).stdout
    for name in re.findall(r"([a-z0-9][a-z0-9.+-]+)(?: \([<>=]+ [^)]+\))?", depends):
        if "temper" not in name:
            yield library(name, "", "deb", "debian")


def npm_libraries(path):
    with tarfile.open(path) as package:
        listed = json.load(package.extractfile("package/package.json"))
        yield from licensed_libraries(path, package.getnames())
    for name, found in (listed.get("dependencies", {}) | listed.get("devDependencies", {})).items():
        purl = PackageURL.from_string(f"pkg:npm/{name.replace('@', '%40')}@{found}")
        yield library(purl.name, found, "npm", purl.namespace)


def container_libraries(path):
    """The dependencies of the Debian packages in the same folder, from which the container is made."""
    return [part for package in path.parent.glob("*.deb") for part in debian_libraries(package)]


def libraries(path):
    if "recipes" in path.name:
        return []
    of_suffix = {".whl": zip_libraries, ".zip": zip_libraries, ".deb": debian_libraries, ".tgz": npm_libraries}
    of_kind = container_libraries if "container" in path.name else of_suffix.get(path.suffix, lambda path: [])
    found = of_kind(path)
    return {str(part.purl): part for part in [*found, *report_libraries()]}.values()


def file_component(path):
    component = Component(
        name=path.name, type=ComponentType.FILE, bom_ref=path.name,
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=hashlib.sha256(path.read_bytes()).hexdigest())],
    )  # fmt: skip
    for part in libraries(path):
        part.bom_ref.value = f"{path.name}/{part.purl}"
        component.components.add(part)
    return component


def main(arguments):
    if len(arguments) != 1 or not arguments[0]:
        sys.exit("usage: scripts/sbom.py FOLDER")
    folder, found = pathlib.Path(arguments[0]), version()
    if not folder.is_dir() or not any(folder.glob(f"temper*{found}*")):
        sys.exit(f"sbom: expected a folder with the files of temper {found}, found {folder}")
    output = folder / f"temper-{found}.cdx.json"
    bom = Bom()
    bom.metadata.component = Component(
        name="temper", version=found, type=ComponentType.APPLICATION, licenses=[LicenseExpression("Apache-2.0")],
        purl=PackageURL("github", "temper-mesh", "temper", f"v{found}"),
    )  # fmt: skip
    for path in sorted(folder.iterdir()):
        if path.is_file() and path not in (output, folder / "SHA256SUMS"):
            bom.components.add(file_component(path))
    bom.register_dependency(bom.metadata.component, bom.components)
    text = JsonV1Dot6(bom).output_as_string(indent=2)
    wrong = JsonStrictValidator(SchemaVersion.V1_6).validate_str(text)
    if wrong:
        sys.exit(f"sbom: {wrong}")
    output.write_text(text)
    print(f"sbom: {len(bom.components)} files, {sum(len(part.components) for part in bom.components)} parts, {output.name}")


if __name__ == "__main__":
    main(sys.argv[1:])
