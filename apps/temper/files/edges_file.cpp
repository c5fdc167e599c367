#include <fmt/format.h>

#include <sstream>
#include <unordered_map>

#include "exit.hpp"
#include "files/input.hpp"

namespace temper::app {
namespace {

class EdgesFile {
 public:
  EdgesFile(const std::string& path, const Input& input) : path_(path), input_(input) {
    for (const VertexId v : input.mesh().vertices()) vertices_.emplace(input.vertex_number(v), v);
  }

  std::vector<HalfedgeId> read() {
    std::ifstream file = open_text(path_);
    std::vector<HalfedgeId> edges;
    for (std::string text; std::getline(file, text);) {
      ++line_;
      std::istringstream words(text.substr(0, text.find('#')));
      std::vector<std::string> ends;
      for (std::string word; words >> word;) ends.push_back(word);
      if (!ends.empty()) edges.push_back(edge(ends));
    }
    if (file.bad()) throw Failure(Exit::bad_input, path_ + ": cannot be read");
    if (edges.empty()) throw Failure(Exit::bad_input, path_ + ": expected edges, found none");
    return edges;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Failure(Exit::bad_input, fmt::format("{}:{}: {}", path_, line_, message));
  }
  [[nodiscard]] VertexId vertex(const std::string& word) const {
    const auto found = vertices_.find(word);
    if (found == vertices_.end()) fail(fmt::format("{} has no vertex {} in a triangle", input_.path, printable(word)));
    return found->second;
  }
  [[nodiscard]] HalfedgeId edge(const std::vector<std::string>& ends) const {
    if (ends.size() != 2) fail(fmt::format("expected two vertices, found {} words", ends.size()));
    const VertexId a = vertex(ends[0]), b = vertex(ends[1]);
    const HalfedgeId h = input_.mesh().find_halfedge(a, b);
    const HalfedgeId found = h.valid() ? h : input_.mesh().find_halfedge(b, a);
    if (!found.valid()) fail(fmt::format("{} has no edge {}-{}", input_.path, ends[0], ends[1]));
    return found;
  }

  const std::string& path_;
  const Input& input_;
  std::unordered_map<std::string, VertexId> vertices_;
  std::size_t line_ = 0;
};

}  // namespace

std::vector<HalfedgeId> prescribed_edges(const std::string& which, const Input& input) {
  const Mesh& mesh = input.mesh();
  const bool is_file = which != "all" && which != "lines";
  std::vector<HalfedgeId> edges;
  if (is_file) edges = EdgesFile(which, input).read();
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!is_file && mesh.is_edge_representative(h) && (which == "all" || mesh.is_constrained(h))) edges.push_back(h);
  }
  std::erase_if(edges, [&](HalfedgeId h) { return mesh.is_boundary(h); });  // regular whatever the weights
  if (edges.empty()) {
    throw Failure(Exit::bad_input,
                  fmt::format("{}: none of the edges that --edges {} names is inside the mesh", input.path, which));
  }
  return edges;
}

}  // namespace temper::app
