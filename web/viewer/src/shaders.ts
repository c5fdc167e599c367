// The shaders. None has attributes: a vertex of the drawing finds what it stands for by its number, in textures that
// hold the mesh once, so that all layers follow when a position changes.
//
// Places are two single-precision numbers each, the second what the first leaves of the double: a view may be 10⁹ times
// smaller than the mesh.

const kCommon = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
`;

/** kWidth: of all textures with one texel an element. */
export const kWidth = 2048;

const kVertex = `${kCommon}
uniform sampler2D places;    // of vertices: x, y, and their remainders
uniform sampler2D duals;     // of orthocenters, then of the midpoints of boundary edges
uniform vec4 center;         // of the view, as a place
uniform vec2 scale;          // from places to clip space
uniform vec2 pixel;          // of the screen in clip space

ivec2 texel(int i) { return ivec2(i & ${kWidth - 1}, i >> ${Math.log2(kWidth)}); }
vec2 onScreen(vec4 place) { return ((place.xy - center.xy) + (place.zw - center.zw)) * scale; }
vec2 vertexAt(uint v) { return onScreen(texelFetch(places, texel(int(v)), 0)); }
vec2 dualAt(uint i) { return onScreen(texelFetch(duals, texel(int(i)), 0)); }
vec2 cornerOfQuad(int i) { return vec2(i == 1 || i == 2 || i == 4 ? 1.0 : -1.0, i == 2 || i == 4 || i == 5 ? 1.0 : -1.0); }
`;

export const fillVertex = `${kVertex}
uniform usampler2D corners;  // three texels a triangle, in drawing order
uniform usampler2D rows;     // of the color table, in drawing order
flat out uint row;
void main() {
  int i = gl_VertexID;
  row = texelFetch(rows, texel(i / 3), 0).r;
  gl_Position = vec4(vertexAt(texelFetch(corners, texel(i), 0).r), 0.0, 1.0);
}`;

export const fillFragment = `${kCommon}
uniform sampler2D table;
uniform vec4 plain;          // with alpha 0: by the table
flat in uint row;
out vec4 color;
void main() { color = plain.a > 0.0 ? plain : vec4(texelFetch(table, ivec2(int(row), 0), 0).rgb, 1.0); }`;

/** Bad triangles: striped, so that they are known without their color; points where they are too small to be seen. */
export const badVertex = `${kVertex}
uniform usampler2D corners;
uniform usampler2D bad;      // places of bad triangles in drawing order
void main() {
  int i = gl_VertexID;
  int triangle = int(texelFetch(bad, texel(i / 3), 0).r);
  gl_Position = vec4(vertexAt(texelFetch(corners, texel(3 * triangle + i % 3), 0).r), 0.0, 1.0);
}`;

export const badFragment = `${kCommon}
uniform vec4 ink;
uniform float ratio;
out vec4 color;
void main() {
  float at = mod((gl_FragCoord.x + gl_FragCoord.y) / ratio, 7.0);
  color = vec4(at < 2.6 ? ink.rgb : mix(ink.rgb, vec3(1.0), 0.8), 0.95 * ink.a);
}`;

export const markVertex = `${kVertex}
uniform usampler2D corners;
uniform usampler2D bad;
uniform float radius;        // in pixels
out vec2 at;
void main() {
  int i = gl_VertexID;
  int triangle = int(texelFetch(bad, texel(i / 6), 0).r);
  vec2 p[3];
  for (int k = 0; k < 3; k++) p[k] = vertexAt(texelFetch(corners, texel(3 * triangle + k), 0).r);
  vec2 low = min(p[0], min(p[1], p[2])), high = max(p[0], max(p[1], p[2]));
  vec2 extent = (high - low) / pixel;
  at = cornerOfQuad(i % 6);
  bool small = max(extent.x, extent.y) < 2.0 * radius;
  gl_Position = small ? vec4((low + high) / 2.0 + at * radius * pixel, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}`;

/** Lines as quads, their rims smooth. */
export const lineVertex = `${kVertex}
uniform usampler2D edges;    // ends, with flags in their highest bits; ends of the dual edge, the same
uniform bool dual;
uniform float width;         // in pixels
uniform float wide;          // of boundary and constrained edges
out float across;
out float half_width;
flat out uint kind;
const uint kFlag = 0x80000000u;
void main() {
  int i = gl_VertexID;
  uvec4 e = texelFetch(edges, texel(i / 6), 0);
  bool boundary = (e.x & kFlag) != 0u, constrained = (e.y & kFlag) != 0u, negative = (e.z & kFlag) != 0u;
  e &= ~kFlag;
  vec2 a = dual ? dualAt(e.z) : vertexAt(e.x), b = dual ? dualAt(e.w) : vertexAt(e.y);
  kind = dual ? (negative ? 3u : 0u) : (boundary ? 1u : constrained ? 2u : 0u);
  half_width = 0.5 * (kind == 0u ? width : wide);
  vec2 along = (b - a) / pixel;
  float l = length(along);
  along = l > 0.0 ? along / l : vec2(1.0, 0.0);
  vec2 corner = cornerOfQuad(i % 6);
  across = corner.y * (half_width + 1.0);
  vec2 normal = vec2(-along.y, along.x);
  vec2 end = corner.x < 0.0 ? a : b;
  gl_Position = vec4(end + (normal * across + along * corner.x * 0.5 * half_width) * pixel, 0.0, 1.0);
}`;

export const lineFragment = `${kCommon}
uniform vec4 inks[4];        // plain, boundary, constrained, not regular
in float across;
in float half_width;
flat in uint kind;
out vec4 color;
void main() {
  float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
  vec4 ink = inks[kind];
  color = vec4(ink.rgb, ink.a * cover);
}`;

/** Weights: circles of radius √|w|, dashed where w < 0. */
export const circleVertex = `${kVertex}
uniform sampler2D radii;     // √|w| as places are scaled, with the sign of w
out vec2 at;
out float radius;
flat out float side;
void main() {
  int i = gl_VertexID;
  float r = texelFetch(radii, texel(i / 6), 0).r;
  side = sign(r);
  radius = abs(r) * scale.x / pixel.x;
  at = cornerOfQuad(i % 6) * (radius + 2.0);
  vec2 middle = vertexAt(uint(i / 6));
  gl_Position = r == 0.0 ? vec4(2.0, 2.0, 0.0, 1.0) : vec4(middle + at * pixel, 0.0, 1.0);
}`;

export const circleFragment = `${kCommon}
uniform vec4 positive;
uniform vec4 negative;
in vec2 at;
in float radius;
flat in float side;
out vec4 color;
void main() {
  float rim = clamp(1.3 - abs(length(at) - radius), 0.0, 1.0);
  float inside = length(at) < radius ? 0.1 : 0.0;
  float dashes = side > 0.0 ? 1.0 : step(0.4, fract(atan(at.y, at.x) * max(4.0, floor(radius / 3.0)) / 6.2831853));
  vec4 ink = side > 0.0 ? positive : negative;
  float cover = max(inside, rim * dashes);
  if (cover == 0.0) discard;
  color = vec4(ink.rgb, ink.a * cover);
}`;

/** Orthocenters: dots. */
export const dotVertex = `${kVertex}
uniform float radius;        // in pixels
out vec2 at;
void main() {
  int i = gl_VertexID;
  at = cornerOfQuad(i % 6);
  gl_Position = vec4(dualAt(uint(i / 6)) + at * (radius + 1.0) * pixel, 0.0, 1.0);
}`;

export const dotFragment = `${kCommon}
uniform vec4 ink;
uniform float radius;
in vec2 at;
out vec4 color;
void main() {
  float cover = clamp(radius + 0.5 - length(at) * (radius + 1.0), 0.0, 1.0);
  if (cover == 0.0) discard;
  color = vec4(ink.rgb, ink.a * cover);
}`;
