// Values as bytes, and back: one function says what a class consists of, and is used both ways.
//
//   void Softener::visit(Archive& archive) {
//     auto& [attempt, settled, sweeps_at_level] = *this;  // all members: a new one has to be named here to compile
//     archive(settled, sweeps_at_level);                  // those that are kept
//   }
//
// A struct of others has a function visit(Archive&, T&) instead. Numbers are as they are in memory, so bytes are for
// the same build on the same kind of machine: seal() finds out when a class has got another member since. Bytes that
// were not written so make the archive fail, whatever they are; what is read then is of no use, but in bounds.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "temper/ids.hpp"
#include "temper/vec2.hpp"
#include "temper/vec3.hpp"

namespace temper {

/// Values that are written as they are in memory: without pointers, invariants and gaps.
template <class T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class Tag>
inline constexpr bool kIsPlain<Id<Tag>> = true;
template <>
inline constexpr bool kIsPlain<Vec2> = true;
template <>
inline constexpr bool kIsPlain<Vec3> = true;
template <>
inline constexpr bool kIsPlain<WeightedPoint> = true;
template <class T, std::size_t n>
inline constexpr bool kIsPlain<std::array<T, n>> = kIsPlain<T>;

/// A hash of one more number: a bijection of the number, and of the hash before.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t number) {
  hash = (hash ^ number) * 0x9e3779b97f4a7c15U;
  return hash ^ (hash >> 32);
}

class Archive {
 public:
  /// Writes, behind what is there.
  explicit Archive(std::string& out) : out_(&out) {}
  /// Reads.
  explicit Archive(std::string_view in) : in_(in) {}

  [[nodiscard]] bool reads() const { return out_ == nullptr; }
  /// Writes the values, or gives them those that were written.
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }
  /// The same for an array of elements that are plain, of a class that cannot say so.
  template <class Values>
  void plain(Values& values) {
    using T = std::remove_reference_t<decltype(*values.begin())>;
    static_assert(std::is_trivially_copyable_v<T>);
    note_kind<T>();
    resize(values, sizeof(T));
    if (values.begin() != values.end()) bytes(&*values.begin(), values.size() * sizeof(T));
  }
  /// Fails, when reading, unless `holds`: for what must hold of values that were read.
  void require(bool holds) { failed_ = failed_ || (reads() && !holds); }
  /// Compares the kinds of all values so far with those that were written.
  void seal() {
    const std::uint64_t kinds = kinds_;
    std::uint64_t written = kinds;
    one(written);
    require(written == kinds);
  }
  [[nodiscard]] bool failed() const { return failed_; }
  /// All that was written has been read.
  [[nodiscard]] bool at_end() const { return !failed_ && in_.empty(); }

 private:
  template <class T>
  void one(T& value) {
    if constexpr (requires { value.visit(*this); }) {
      value.visit(*this);
    } else if constexpr (requires { visit(*this, value); }) {
      visit(*this, value);
    } else {
      static_assert(kIsPlain<T>, "a class needs visit()");
      note_kind<T>();
      bytes(&value, sizeof value);
    }
  }
  void one(bool& value) {
    auto byte = static_cast<std::uint8_t>(value);
    one(byte);
    require(byte <= 1);
    value = byte == 1;
  }
  void one(std::string& text) { plain(text); }
  template <class T>
  void one(std::vector<T>& values) {
    many<T>(values);
  }
  template <class IdType, class T>
  void one(IdVector<IdType, T>& values) {
    many<T>(values);
  }
  template <class T>
  void one(std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (reads()) value = there && !failed_ ? std::optional<T>(T()) : std::nullopt;
    if (value) one(*value);
  }

  template <class... T>
  void one(std::variant<T...>& value) {
    std::uint64_t index = value.index();
    one(index);
    require(index < sizeof...(T));
    if (reads() && !failed_) choose(value, static_cast<std::size_t>(index), std::index_sequence_for<T...>());
    std::visit([this](auto& each) { this->one(each); }, value);
  }
  template <class Variant, std::size_t... i>
  static void choose(Variant& value, std::size_t index, std::index_sequence<i...>) {
    static_cast<void>(((index == i && (value.template emplace<i>(), true)) || ...));
  }

  /// Elements of any array. Each takes a byte at least: no count can ask for more memory than the bytes are worth.
  template <class T, class Values>
  void many(Values& values) {
    if constexpr (kIsPlain<T>) {
      plain(values);
    } else {
      resize(values, 1);
      for (T& value : values) one(value);
    }
  }
  template <class Values>
  void resize(Values& values, std::size_t least_bytes) {
    std::uint64_t count = values.size();
    bytes(&count, sizeof count);
    if (!reads()) return;
    require(count <= in_.size() / least_bytes);
    values.clear();
    if (!failed_) values.resize(static_cast<std::size_t>(count));
  }
  void bytes(void* value, std::size_t n) {
    if (!reads()) {
      out_->append(static_cast<const char*>(value), n);
      return;
    }
    require(n <= in_.size());
    if (failed_) return;
    std::memcpy(value, in_.data(), n);
    in_.remove_prefix(n);
  }
  template <class T>
  void note_kind() {
    constexpr std::uint64_t kKind = std::is_floating_point_v<T> ? 1
                                    : std::is_enum_v<T>         ? 2
                                    : std::is_class_v<T>        ? 3
                                                                : 0;
    kinds_ = mixed(kinds_, 4 * sizeof(T) + kKind);
  }

  std::string* out_ = nullptr;
  std::string_view in_;
  std::uint64_t kinds_ = 0;
  bool failed_ = false;
};

/// A checksum of bytes, that another one of them changes.
[[nodiscard]] inline std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = bytes.size();
  for (; bytes.size() >= sizeof sum; bytes.remove_prefix(sizeof sum)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof word);
    sum = mixed(sum, word);
  }
  std::uint64_t last = 0;
  if (!bytes.empty()) std::memcpy(&last, bytes.data(), bytes.size());
  return mixed(sum, last);
}

}  // namespace temper
