// Sparse symmetric systems in blocks of three unknowns, solved roughly: conjugate gradients, preconditioned by
// symmetric over-relaxation.
//
// The diagonal blocks are identities, A = L + I + U with U = Lᵀ. Conjugate gradients run on the split system
//
//   (I/ω + L)⁻¹ A (I/ω + U)⁻¹ y = (I/ω + L)⁻¹ b,    x = (I/ω + U)⁻¹ y
//
// whose product needs no A (Eisenstat's trick): with t = (I/ω + U)⁻¹ p it is t + (I/ω + L)⁻¹ (p + (1 − 2/ω) t). So an
// iteration costs one pass through U backwards and one through L. Single precision is enough for a step that is
// measured by what it gains; sums are in double, and all in one order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/pack.hpp"

namespace temper {

/// Three numbers, and a fourth that means nothing.
struct Float4 {
  using Floats [[gnu::vector_size(16)]] = float;
  Floats v = {};

  [[nodiscard]] TEMPER_INLINE float operator[](int i) const { return v[i]; }
  friend TEMPER_INLINE Float4 operator+(Float4 a, Float4 b) { return {a.v + b.v}; }
  friend TEMPER_INLINE Float4 operator-(Float4 a, Float4 b) { return {a.v - b.v}; }
  friend TEMPER_INLINE Float4 operator*(float a, Float4 b) { return {a * b.v}; }
  friend TEMPER_INLINE float dot(Float4 a, Float4 b) {
    const Floats product = a.v * b.v;
    return product[0] + product[1] + product[2];
  }
};

/// The blocks of L and U; the diagonal blocks are identities.
struct BlockMatrix {
  /// Row i has in L the entries start[2i] … start[2i + 1] − 1, and in U those up to start[2i + 2].
  std::vector<std::uint32_t> start;
  std::vector<std::uint32_t> column;  ///< of each entry
  std::vector<float> number;          ///< nine of each entry, its block by columns; and what is read beyond

  /// Blocks of 0 for all entries.
  void clear_blocks() { number.assign(kBlock * column.size() + kBeyond, 0); }
  [[nodiscard]] float* block(std::size_t entry) { return &number[kBlock * entry]; }
  /// A block times three numbers.
  [[nodiscard]] TEMPER_INLINE Float4 times(std::size_t entry, Float4 x) const {
    const float* b = &number[kBlock * entry];
    return x[0] * load(b) + x[1] * load(b + 3) + x[2] * load(b + 6);
  }

  [[nodiscard]] std::size_t size() const { return start.size() / 2; }
  [[nodiscard]] std::size_t begin_lower(std::size_t i) const { return start[2 * i]; }
  [[nodiscard]] std::size_t begin_upper(std::size_t i) const { return start[2 * i + 1]; }
  [[nodiscard]] std::size_t end_upper(std::size_t i) const { return start[2 * i + 2]; }

 private:
  static constexpr std::size_t kBlock = 9, kBeyond = 1;

  static TEMPER_INLINE Float4 load(const float* p) {
    Float4 r;
    __builtin_memcpy(&r.v, p, sizeof r.v);
    return r;
  }
};

class ConjugateGradients {
 public:
  /// Until the residual of the split system is a tenth of what it was. Where A is not positive definite, as far as it
  /// seems to be: always a direction along which b rises. Takes b, and returns x until the next call.
  [[nodiscard]] const std::vector<Float4>& solve(const BlockMatrix& a, const std::vector<Float4>& b);

 private:
  void divide_by_lower(const BlockMatrix& a, const std::vector<Float4>& b);
  void divide_by_upper(const BlockMatrix& a, const std::vector<Float4>& p);
  double multiply(const BlockMatrix& a);

  std::vector<Float4> x_, residual_, direction_, upper_, product_;  // upper_: t above; product_: A of the split system
};

}  // namespace temper
