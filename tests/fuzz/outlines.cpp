// Readers of outlines, and of the JSON that some are.
#include "io/outlines/json_tree.hpp"
#include "io/text/failure.hpp"
#include "target.hpp"
#include "temper/io.hpp"

namespace temper::fuzz {
namespace {

void read_outline_of(std::string_view bytes) {
  static const Scratch scratch;
  const auto outline = io::read_outline(scratch.make("o", bytes));
  if (!outline) return insist(!outline.error().message.empty(), "an error has a message");
  const Outline& o = outline->outline;
  const auto n = static_cast<std::int32_t>(o.points.size());
  for (const auto& segment : o.segments) {
    for (const std::int32_t end : segment.ends) insist(end >= 0 && end < n, "segments end at points");
  }
  for (std::size_t i = 0; i < o.points.size(); ++i) insist(!o.names->point_where(i).empty(), "points have a place");
}

void parse(std::string_view bytes) {
  try {
    const io::JsonValue value = io::parse_json("j.json", bytes);
    insist(!io::describe(value).empty(), "a value is something");
  } catch (const io::Failure& failure) {
    insist(!failure.error.message.empty(), "an error has a message");
  }
}

const std::string kGeoJson =
    "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{\"region\":2,\"size\":0.5,"
    "\"tag\":3,\"a\":[null,true,\"\\u00e9\\n\"]},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[4,0],[4,4]"
    ","
    "[0,0]],[[1,0.2],[2,0.2],[2,1e-1],[1,0.2]]]}},{\"type\":\"Feature\",\"properties\":null,\"geometry\":{\"type\":"
    "\"GeometryCollection\",\"geometries\":[{\"type\":\"MultiLineString\",\"coordinates\":[[[0,0],[1,1,5]]]},{\"type\":"
    "\"MultiPoint\",\"coordinates\":[[2,2],[-3,1]]}]}}]}";

}  // namespace

std::vector<Target> outline_targets() {
  return {{"geojson", read_outline_of, [] { return std::vector<std::string>{kGeoJson}; }},
          {"poly", read_outline_of,
           [] {
             return std::vector<std::string>{
                 "4 2 1 1\n1 0 0 9 1\n2 4 0 9 1\n3 4 4 9 1\n4 0 4 9 0\n4 1\n1 1 2 5\n2 2 3 5\n3 3 4 6\n4 4 1 6\n1\n1 2 "
                 "2\n1\n1 1 1 7 0.5\n",
                 "3 2\n0 0 0\n1 1 0\n2 0 1\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n"};
           }},
          {"jigsaw_outline", read_outline_of,
           [] {
             return std::vector<std::string>{
                 "# c\nMSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=3\n0;0;0\n1;0;0\n0;+1D0;0\nEDGE2=3\n0;1;1\n1;2;2\n2;0;3\n"
                 "BOUND=3\n1;0;20\n1;1;20\n1;2;20\n"};
           }},
          {"json", parse, [] {
             return std::vector<std::string>{kGeoJson, "[[1,2],[3,\"x\"],{}]"};
           }}};
}

}  // namespace temper::fuzz
