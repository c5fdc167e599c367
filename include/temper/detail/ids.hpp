// Strong four-byte ids and the arrays they index.
//
// A mesh is a set of flat arrays. The type of an id prevents the use of a vertex number as a triangle number. An id is
// a plain index with a tag: no reference count, no pointer to the mesh.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace temper {

/// An index with a type. Default-constructed ids are invalid.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kInvalid = 0xffffffffu;

  std::uint32_t index = kInvalid;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t i) : index(static_cast<std::uint32_t>(i)) {}

  [[nodiscard]] constexpr bool valid() const { return index != kInvalid; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using VertexId = Id<struct VertexTag>;
/// A directed edge of one triangle. Halfedge 3 t + k runs from corner k of triangle t to corner k + 1.
using HalfedgeId = Id<struct HalfedgeTag>;
using TriangleId = Id<struct TriangleTag>;

/// The ids 0 … n − 1, or a range [first, last), for range-based loops.
template <class IdType>
class IdRange {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = IdType;
    using difference_type = std::ptrdiff_t;
    using pointer = const IdType*;
    using reference = IdType;

    constexpr explicit Iterator(std::size_t i) : index_(i) {}
    constexpr IdType operator*() const { return IdType(index_); }
    constexpr Iterator& operator++() {
      ++index_;
      return *this;
    }
    constexpr Iterator operator++(int) { return Iterator(index_++); }
    friend constexpr bool operator==(Iterator, Iterator) = default;

   private:
    std::size_t index_;
  };

  constexpr explicit IdRange(std::size_t size) : last_(size) {}
  constexpr IdRange(IdType first, IdType last) : first_(first.index), last_(last.index) {}
  [[nodiscard]] constexpr Iterator begin() const { return Iterator(first_); }
  [[nodiscard]] constexpr Iterator end() const { return Iterator(last_); }
  [[nodiscard]] constexpr std::size_t size() const { return last_ - first_; }

 private:
  std::size_t first_ = 0, last_;
};

/// A std::vector that only its own id type can index.
template <class IdType, class T>
class IdVector {
 public:
  IdVector() = default;
  explicit IdVector(std::size_t size, const T& value = T()) : values_(size, value) {}

  decltype(auto) operator[](IdType id) { return values_[id.index]; }
  decltype(auto) operator[](IdType id) const { return values_[id.index]; }

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  void resize(std::size_t size, const T& value = T()) { values_.resize(size, value); }
  void reserve(std::size_t size) { values_.reserve(size); }
  void assign(std::size_t size, const T& value) { values_.assign(size, value); }
  void push_back(const T& value) { values_.push_back(value); }
  void pop_back() { values_.pop_back(); }
  void clear() { values_.clear(); }
  [[nodiscard]] auto begin() { return values_.begin(); }
  [[nodiscard]] auto end() { return values_.end(); }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }
  [[nodiscard]] const std::vector<T>& raw() const { return values_; }
  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  std::vector<T> values_;
};

}  // namespace temper
