// The viewer's interface.
export { type ColorScale, darkTheme, lightTheme, type Theme } from './colors.ts';
export { type Point, triangleNumbers, type TriangleNumbers, verdicts } from './geometry.ts';
export { badTriangles, type Preference, findMeasure, type Measure, measures, valuesOf } from './measures.ts';
export { type Box, findTwins, type MeshData, nTriangles, nVertices, Verdict } from './mesh.ts';
export type { Layers } from './scene.ts';
export { type Pick, type Side, Viewer, type ViewerOptions, type VertexTool } from './viewer.ts';
