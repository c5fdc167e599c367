"""Meshes the polygons of a layer, from the toolbox of QGIS or qgis_process.

Copy this file to processing/scripts in the folder of your QGIS profile. QGIS's Python needs temper (docs/howto/plugins.md).
"""

import json
import pathlib
import tempfile
import warnings

from qgis.core import (
    NULL,
    QgsCoordinateTransform,
    QgsMeshLayer,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputNumber,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterDistance,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterMultipleLayers,
)

TARGETS = {
    "D-Flow FM: orthogonal": "dflowfm", "ADCIRC, SCHISM: fort.14": "adcirc", "linear elements": "fem",
    "unknowns at vertices, with weights": "vertex", "unknowns in triangles, with weights": "cell",
}  # fmt: skip
FILES = "UGRID (*.nc);;2DM (*.2dm);;ADCIRC (*.14);;VTU (*.vtu)"
PROPERTIES = ("name", "region", "size", "tag")  # of a feature, which temper reads


class MeshPolygons(QgsProcessingAlgorithm):
    def name(self):
        return "temper_mesh_polygons"

    def displayName(self):
        return "Mesh polygons (temper)"

    def group(self):
        return "Meshes"

    def groupId(self):
        return "meshes"

    def shortHelpString(self):
        return (
            "Fills polygons with triangles whose dual is safe for solvers. Common borders become interfaces. Lines become edges, and "
            "points become vertices. The fields name, region, size and tag of features have the meaning that temper gives them in GeoJSON. "
            "The result is a mesh layer. In UGRID it has the margin of each triangle, which is negative if the triangle is bad."
        )

    def createInstance(self):
        return MeshPolygons()

    def initAlgorithm(self, config=None):
        self.addParameter(QgsProcessingParameterFeatureSource("INPUT", "Polygons", [QgsProcessing.TypeVectorPolygon]))
        self.addParameter(QgsProcessingParameterMultipleLayers("KEEP", "Lines and points to keep", QgsProcessing.TypeVectorAnyGeometry, optional=True))
        self.addParameter(QgsProcessingParameterDistance("SIZE", "Length of edges", parentParameterName="INPUT", minValue=0))
        self.addParameter(QgsProcessingParameterDistance("SNAP", "Join points nearer than", parentParameterName="INPUT", minValue=0, optional=True))
        self.addParameter(QgsProcessingParameterBoolean("SPLIT", "Divide lines where they cross", defaultValue=False))
        self.addParameter(QgsProcessingParameterEnum("TARGET", "Solver", list(TARGETS), defaultValue=0))
        self.addParameter(QgsProcessingParameterFileDestination("OUTPUT", "Mesh", FILES))
        self.addOutput(QgsProcessingOutputNumber("TRIANGLES", "Number of triangles"))
        self.addOutput(QgsProcessingOutputNumber("BAD", "Triangles that are not well-centered"))

    def processAlgorithm(self, parameters, context, feedback):
        try:
            import temper
        except ImportError as error:
            raise QgsProcessingException(f"{error}. Next: install temper for the Python of QGIS (docs/howto/plugins.md)") from None
        polygons = self.parameterAsSource(parameters, "INPUT", context)
        if polygons is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "INPUT"))
        crs = polygons.sourceCrs()
        if crs.isGeographic():
            raise QgsProcessingException(f"the polygons are in degrees ({crs.authid()}). Next: reproject the layer to a system in meters")
        kept = self.parameterAsLayerList(parameters, "KEEP", context) or []
        features = [feature for source in (polygons, *kept) for feature in self.features(source, crs, context)]
        size = self.parameterAsDouble(parameters, "SIZE", context)
        snap = self.parameterAsDouble(parameters, "SNAP", context) if parameters.get("SNAP") is not None else None
        target = list(TARGETS.values())[self.parameterAsEnum(parameters, "TARGET", context)]
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        with warnings.catch_warnings(record=True) as messages, tempfile.TemporaryDirectory() as folder:
            warnings.simplefilter("always", temper.TemperWarning)
            file = pathlib.Path(folder, "polygons.geojson")
            file.write_text(json.dumps({"type": "FeatureCollection", "features": features}), encoding="utf-8")
            try:
                outline = temper.read_outline(file).outline
                meshed = temper.mesh_outline(
                    outline, size, snap=snap, split_crossings=self.parameterAsBoolean(parameters, "SPLIT", context), target=target,
                    observer=lambda now: not feedback.isCanceled(),
                )  # fmt: skip
                mesh = meshed.mesh
                is_ugrid = output.endswith(".nc")
                if is_ugrid:
                    mesh.cell_data["margin"] = temper.triangle_quality(mesh).min_h_over_l
                temper.write(output, mesh, format="ugrid" if is_ugrid else None)
            except temper.TemperError as error:
                raise QgsProcessingException(str(error).replace(str(file), polygons.sourceName())) from None
        for message in messages:
            feedback.pushWarning(str(message.message).replace(str(file), polygons.sourceName()))
        feedback.pushInfo(f"{mesh.n_vertices} vertices, {mesh.n_triangles} triangles, {meshed.bad} of them not well-centered")
        self.open_at_end(output, crs, context)
        return {"OUTPUT": output, "TRIANGLES": mesh.n_triangles, "BAD": meshed.bad}

    @staticmethod
    def features(source, crs, context):
        """As GeoJSON, in the coordinate system of the polygons, with all digits."""
        own = source.sourceCrs() if hasattr(source, "sourceCrs") else source.crs()
        to_crs = QgsCoordinateTransform(own, crs, context.transformContext())
        for feature in source.getFeatures():
            geometry = feature.geometry()
            if geometry.isNull():
                continue
            if own != crs:
                geometry.transform(to_crs)
            values = {field.name().lower(): feature[field.name()] for field in feature.fields()}
            properties = {name: values[name] for name in PROPERTIES if values.get(name) not in (None, NULL)}
            yield {"type": "Feature", "geometry": json.loads(geometry.asJson(17)), "properties": properties}

    @staticmethod
    def open_at_end(output, crs, context):
        layer = QgsMeshLayer(output, "mesh", "mdal")
        if layer.isValid() and context.project() is not None:
            layer.setCrs(crs)
            context.temporaryLayerStore().addMapLayer(layer)
            context.addLayerToLoadOnCompletion(layer.id(), QgsProcessingContext.LayerDetails("mesh", context.project(), "OUTPUT"))
