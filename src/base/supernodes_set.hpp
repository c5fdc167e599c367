// Included by one source for each instruction set, compiled for that set.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/pack.hpp"
#include "base/supernodes.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

constexpr std::size_t kTile = 4;  // columns of a product that registers hold

/// Eight rows of kTile columns of A Aᵀ.
template <std::size_t N>
TEMPER_INLINE void product_tile(const double* rows, const double* columns, std::size_t apart, std::size_t k, double* to,
                                std::size_t to_apart) {
  Pack sums[N];
  for (Pack& sum : sums) sum = Pack::all(0);
  for (std::size_t l = 0; l < k; ++l, rows += apart, columns += apart) {
    const Pack a = Pack::load(rows);
    for (std::size_t j = 0; j < N; ++j) sums[j] = sums[j] + columns[j] * a;
  }
  for (std::size_t j = 0; j < N; ++j) sums[j].store(to + j * to_apart);
}

void product(const double* a, std::size_t apart, std::size_t m, std::size_t n, std::size_t k, double* to) {
  const std::size_t to_apart = padded(m);
  for (std::size_t j = 0; j < n; j += kTile) {
    for (std::size_t i = j / kLanes * kLanes; i < m; i += kLanes) {
      double* const at = to + j * to_apart + i;
      switch (std::min(n - j, kTile)) {
        case 1:
          product_tile<1>(a + i, a + j, apart, k, at, to_apart);
          break;
        case 2:
          product_tile<2>(a + i, a + j, apart, k, at, to_apart);
          break;
        case 3:
          product_tile<3>(a + i, a + j, apart, k, at, to_apart);
          break;
        default:
          product_tile<kTile>(a + i, a + j, apart, k, at, to_apart);
      }
    }
  }
}

// One number, or one for each lane, at a row.
struct OneLane {
  double v;
  TEMPER_INLINE static OneLane load(const double* p) { return {*p}; }
  TEMPER_INLINE void store(double* p) const { *p = v; }
  friend TEMPER_INLINE OneLane operator-(OneLane a, OneLane b) { return {a.v - b.v}; }
  friend TEMPER_INLINE OneLane operator*(double a, OneLane b) { return {a * b.v}; }
};
template <class T>
constexpr std::size_t kSizeOf = kLanes;
template <>
constexpr std::size_t kSizeOf<OneLane> = 1;

template <std::size_t N, class T>
TEMPER_INLINE void forward_columns(const Panel& panel, std::size_t j, double* x) {
  const double* const l = panel.values + j * panel.rows;
  double* const own = x + static_cast<std::size_t>(panel.numbers[j]) * kSizeOf<T>;
  T solved[N];
  for (std::size_t a = 0; a < N; ++a) {
    solved[a] = T::load(own + a * kSizeOf<T>);
    for (std::size_t b = 0; b < a; ++b) solved[a] = solved[a] - l[b * panel.rows + j + a] * solved[b];
    solved[a] = (1 / l[a * panel.rows + j + a]) * solved[a];
    solved[a].store(own + a * kSizeOf<T>);
  }
  for (std::size_t i = j + N; i < panel.rows; ++i) {
    double* const at = x + static_cast<std::size_t>(panel.numbers[i]) * kSizeOf<T>;
    T value = T::load(at);
    for (std::size_t a = 0; a < N; ++a) value = value - l[a * panel.rows + i] * solved[a];
    value.store(at);
  }
}

template <std::size_t N, class T>
TEMPER_INLINE void backward_columns(const Panel& panel, std::size_t j, double* x) {
  const double* const l = panel.values + j * panel.rows;
  double* const own = x + static_cast<std::size_t>(panel.numbers[j]) * kSizeOf<T>;
  T solved[N];
  for (std::size_t a = 0; a < N; ++a) solved[a] = T::load(own + a * kSizeOf<T>);
  for (std::size_t i = j + N; i < panel.rows; ++i) {
    const T value = T::load(x + static_cast<std::size_t>(panel.numbers[i]) * kSizeOf<T>);
    for (std::size_t a = 0; a < N; ++a) solved[a] = solved[a] - l[a * panel.rows + i] * value;
  }
  for (std::size_t a = N; a-- > 0;) {
    for (std::size_t b = a + 1; b < N; ++b) solved[a] = solved[a] - l[a * panel.rows + j + b] * solved[b];
    solved[a] = (1 / l[a * panel.rows + j + a]) * solved[a];
    solved[a].store(own + a * kSizeOf<T>);
  }
}

template <class T>
TEMPER_INLINE void forward_panel(const Panel& panel, double* x) {
  std::size_t j = 0;
  for (; j + kTile <= panel.columns; j += kTile) forward_columns<kTile, T>(panel, j, x);
  for (; j < panel.columns; ++j) forward_columns<1, T>(panel, j, x);
}
template <class T>
TEMPER_INLINE void backward_panel(const Panel& panel, double* x) {
  const std::size_t tiles = panel.columns / kTile * kTile;
  for (std::size_t j = panel.columns; j-- > tiles;) backward_columns<1, T>(panel, j, x);
  for (std::size_t j = tiles; j > 0; j -= kTile) backward_columns<kTile, T>(panel, j - kTile, x);
}

void forward(const Panel& panel, double* x) { forward_panel<OneLane>(panel, x); }
void backward(const Panel& panel, double* x) { backward_panel<OneLane>(panel, x); }
void forward_lanes(const Panel& panel, double* x) { forward_panel<Pack>(panel, x); }
void backward_lanes(const Panel& panel, double* x) { backward_panel<Pack>(panel, x); }

}  // namespace

const PanelKernels kPanelKernels = {product, forward, backward, forward_lanes, backward_lanes};

}  // namespace temper::TEMPER_INSTRUCTION_SET
