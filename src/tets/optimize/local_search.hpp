// Changes of connectivity: at all bad tetrahedra at once, and in patches, small meshes with a search of their own.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "temper/detail/executor.hpp"
#include "tets/optimize/draft.hpp"
#include "tets/optimize/sweeper.hpp"
#include "tets/optimize/violations.hpp"

namespace temper::tets {

struct SearchOptions {
  Criterion criterion = Criterion::well_centered;
  int most_in_vain = 0;     ///< Trials without success, after which the search ends
  double small_margin = 0;  ///< Without bad tetrahedra it looks at those with a smaller margin
  bool split_boundary = false;
  bool search_each = false;  ///< Each place has its own searches, not along with those nearby
  double most_cosine = 1;    ///< Of a dihedral angle; more only where it was more before
  std::size_t rank = 0;      ///< Of change_all: takes the best change at each place, or the next ones
};

/// Fills a cavity at each tetrahedron that violates the criterion, or else has a small margin, where this lowers the
/// energy. Improves the vertices around. False: there was nothing to do, or it must stop.
bool change_all(Draft& draft, const SearchOptions& options, const MustStop& must_stop, Executor* executor);

struct SearchResult {
  bool is_better = false;  ///< There was one
  std::size_t work = 0;    ///< Tetrahedra that chains have improved, each time they did
};
/// Tries chains of changes at tetrahedra that violate the criterion, or those with small margins. Takes the chains that
/// leave fewer of them, or less energy.
SearchResult search(Draft& draft, const SearchOptions& options, const MustStop& must_stop);

/// The places of a mesh that need a search, and how often each was in vain.
class Places {
 public:
  /// `work`: what is left of the work of all searches. Without any, places get no patch.
  Places(const SearchOptions& options, std::size_t& work) : options_(options), work_(work) {}
  /// Patches around tetrahedra where a search may help. They share no tetrahedron. A place where searches were in vain
  /// gets a larger patch, and after some none.
  [[nodiscard]] std::vector<Patch> choose(const Draft& draft, Executor* executor);
  /// Takes the work of the i-th search from what is left.
  void spend(std::size_t i, const SearchResult& result) {
    work_ += chosen_[i].reserved - std::min(work_ + chosen_[i].reserved, result.work);
  }
  /// Call this if the search of the i-th patch was successful. Its places may then be tried again.
  void succeeded(std::size_t i) {
    for (const Corners& corners : chosen_[i].along) tries_.erase(corners);
  }

 private:
  using Corners = std::array<VertexId, 4>;  ///< of a tetrahedron, by name, sorted
  /// A patch: the tetrahedra that are tried along with its place, and the work that its search may do.
  struct Chosen {
    std::vector<Corners> along;
    std::size_t reserved = 0;
  };
  SearchOptions options_;
  std::size_t& work_;
  std::map<Corners, int> tries_;
  std::vector<Chosen> chosen_;
};

}  // namespace temper::tets
