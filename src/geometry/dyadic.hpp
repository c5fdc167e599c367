// An exact number of any length and of any magnitude: an integer times a power of two.
//
// It is for products of many factors, which leave the range of doubles. Sums of doubles (expansion.hpp) cannot hold
// them. It is slow, and only decides signs that filters leave open.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "temper/detail/geometry.hpp"

namespace temper::exact {

class Dyadic {
 public:
  Dyadic() = default;
  /// Precondition: value is finite.
  explicit Dyadic(double value) {
    if (value == 0) return;
    int exponent = 0;
    auto significand = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), kBits));
    exponent -= kBits;
    place_ = floor_to_digits(exponent);
    const int shift = exponent - 32 * place_;
    // significand 2^shift has at most 53 + 31 bits.
    const std::uint64_t low = (significand & 0xffffffffU) << shift, high = ((significand >> 32) << shift) + (low >> 32);
    digits_ = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high),
               static_cast<std::uint32_t>(high >> 32)};
    negative_ = value < 0;
    trim();
  }

  [[nodiscard]] Sign sign() const {
    if (digits_.empty()) return Sign::zero;
    return negative_ ? Sign::negative : Sign::positive;
  }
  /// Within one unit in the last place, if that is a normal number.
  [[nodiscard]] double approximation() const {
    const std::size_t n = digits_.size();
    const auto digit = [&](std::size_t i) { return std::uint64_t{i <= n ? digits_[n - i] : 0U}; };  // 1 is the highest
    const double size = std::ldexp(static_cast<double>(digit(1)), 64) + static_cast<double>(digit(2) << 32 | digit(3));
    return std::ldexp(negative_ ? -size : size, 32 * (place_ + static_cast<int>(n) - 3));
  }

  friend Dyadic operator-(Dyadic a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend Dyadic operator+(Dyadic a, Dyadic b) {
    if (a.digits_.empty()) return b;
    if (b.digits_.empty()) return a;
    align(a, b);
    if (a.negative_ == b.negative_) {
      add(a.digits_, b.digits_);
    } else {
      if (std::ranges::lexicographical_compare(a.digits_.rbegin(), a.digits_.rend(), b.digits_.rbegin(),
                                               b.digits_.rend()))
        std::swap(a, b);
      subtract(a.digits_, b.digits_);
    }
    a.trim();
    return a;
  }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic product;
    product.negative_ = a.negative_ != b.negative_;
    product.place_ = a.place_ + b.place_;
    product.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.digits_.size(); ++j) {
        carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + product.digits_[i + j];
        product.digits_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      product.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
    }
    product.trim();
    return product;
  }

 private:
  using Digits = std::vector<std::uint32_t>;
  static constexpr int kBits = 53;

  static int floor_to_digits(int exponent) { return (exponent - (exponent < 0 ? 31 : 0)) / 32; }
  /// The same place and the same number of digits, with room for a carry.
  static void align(Dyadic& a, Dyadic& b) {
    const int place = std::min(a.place_, b.place_);
    for (Dyadic* x : {&a, &b}) {
      x->digits_.insert(x->digits_.begin(), static_cast<std::size_t>(x->place_ - place), 0);
      x->place_ = place;
    }
    const std::size_t n = std::max(a.digits_.size(), b.digits_.size()) + 1;
    a.digits_.resize(n, 0);
    b.digits_.resize(n, 0);
  }
  static void add(Digits& a, const Digits& b) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      carry += std::uint64_t{a[i]} + b[i];
      a[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
  /// Precondition: a ≥ b.
  static void subtract(Digits& a, const Digits& b) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::uint64_t taken = b[i] + borrow;
      borrow = a[i] < taken ? 1 : 0;
      a[i] = static_cast<std::uint32_t>(a[i] - taken);
    }
  }
  /// Drops zeros at both ends.
  void trim() {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
    const auto first = std::ranges::find_if(digits_, [](std::uint32_t digit) { return digit != 0; });
    place_ += static_cast<int>(first - digits_.begin());
    digits_.erase(digits_.begin(), first);
  }

  bool negative_ = false;
  int place_ = 0;  // the lowest digit counts 2^(32 place)
  Digits digits_;  // lowest first; none for zero
};

}  // namespace temper::exact
