// Sparse Cholesky factors A = L Lᵀ in supernodes: columns of L with the same rows below them, stored as one dense panel
// (Ng and Peyton 1993). A panel takes the products of earlier panels as products of dense matrices, in the fastest
// instruction set that the machine has. Every set adds in the same order (base/pack.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/pack.hpp"

namespace temper {

/// The least multiple of kLanes that is not below m.
TEMPER_INLINE constexpr std::size_t padded(std::size_t m) { return (m + kLanes - 1) / kLanes * kLanes; }

/// Dense columns of L one after the other: `columns` of them, with `rows` numbers each. The first rows have the
/// numbers of the columns. Behind the last number of L are kLanes more, which kernels may read.
struct Panel {
  const double* values = nullptr;
  std::size_t rows = 0, columns = 0;
  const int* numbers = nullptr;  ///< of the rows in the order of elimination
};

struct PanelKernels {
  /// The first n columns of A Aᵀ at and below the diagonal, for m rows and k columns of A. Columns of `to` are
  /// padded(m) apart.
  void (*product)(const double* a, std::size_t apart, std::size_t m, std::size_t n, std::size_t k, double* to);
  /// The part of a panel in the solution with L, and with Lᵀ, for one right side or for kLanes ones.
  void (*forward)(const Panel& panel, double* x);
  void (*backward)(const Panel& panel, double* x);
  void (*forward_lanes)(const Panel& panel, double* x);
  void (*backward_lanes)(const Panel& panel, double* x);
};

class SupernodalCholesky {
 public:
  /// An entry of the matrix or of its transpose. Entries of one place are summed.
  struct Entry {
    int row = 0, column = 0;
  };

  /// Finds the structure of L. `place` has a place in the order of elimination for each unknown. The order becomes an
  /// equivalent one with contiguous supernodes. O(entries of L).
  void analyze(std::vector<int> place, std::span<const Entry> entries);
  /// Factors the matrix with these values of the entries, plus `shift` on the diagonal. Returns false if a pivot is not
  /// positive.
  [[nodiscard]] bool factor(std::span<const double> values, double shift = 0);

  /// Where an unknown is in the order of elimination.
  [[nodiscard]] std::size_t place(std::size_t unknown) const { return static_cast<std::size_t>(place_[unknown]); }
  /// Solves in place for one right side, in the order of the unknowns.
  void solve(std::span<double> x) const;
  /// Solves in place for kLanes right sides, side by side, in the order of elimination.
  void solve_lanes(double* x) const;

 private:
  struct Supernode {
    int first = 0;            // column
    std::size_t columns = 0;  // their number
    std::size_t rows_at = 0, rows = 0;
    std::size_t values_at = 0;
  };

  void find_supernodes(const std::vector<int>& parent, const std::vector<int>& count);
  void find_rows(const std::vector<int>& starts, const std::vector<int>& columns);
  [[nodiscard]] Panel panel(const Supernode& s) const {
    return {&values_[s.values_at], s.rows, s.columns, &rows_[s.rows_at]};
  }
  void subtract_products(const Supernode& to, const Supernode& from, std::size_t first, std::size_t last);
  [[nodiscard]] bool factor_panel(const Supernode& s);

  std::vector<int> place_;
  std::vector<Supernode> supernodes_;
  std::vector<int> supernode_of_;   // of each column
  std::vector<int> rows_;           // of all supernodes, in increasing order
  std::vector<std::size_t> slots_;  // of the entries among the values
  std::vector<double> values_;
  std::vector<int> where_;        // row of the present supernode, of each row that it has
  std::vector<double> products_;  // of two panels
};

}  // namespace temper

namespace temper::baseline {
extern const PanelKernels kPanelKernels;
}
namespace temper::avx2 {
extern const PanelKernels kPanelKernels;
}
namespace temper::avx512 {
extern const PanelKernels kPanelKernels;
}
