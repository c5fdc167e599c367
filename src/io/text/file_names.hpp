// The numbers and lines that a file gives its points and triangles, so that errors use the user's numbers. Numbers
// nearly always count up by one, so they are kept as runs: a few bytes, not eight for each of a million points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "temper/tets/mesh.hpp"

namespace temper::io {

/// A sequence of integers that mostly counts up by one.
class RunLength {
 public:
  RunLength() = default;
  /// n numbers: first, first + 1, …
  RunLength(std::int64_t first, std::size_t n) : size_(n) { runs_.push_back({0, first}); }

  void push_back(std::int64_t value);
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// The value at an index. Past either end the nearest run continues.
  [[nodiscard]] std::int64_t operator[](std::int64_t index) const;
  /// Says whether the numbers are first, first + 1, …
  [[nodiscard]] bool counts_from(std::int64_t first) const;

 private:
  friend class NumberLookup;
  struct Run {
    std::size_t index;
    std::int64_t value;
  };
  std::vector<Run> runs_;
  std::size_t size_ = 0;
};

/// A lookup from a file's numbers to indices: O(log runs), and O(1) if calls follow the order of the file.
class NumberLookup {
 public:
  explicit NumberLookup(const RunLength& numbers);
  [[nodiscard]] std::optional<std::size_t> find(std::int64_t number) const;
  /// A number that was given twice, if any.
  [[nodiscard]] std::optional<std::int64_t> duplicate() const;

 private:
  struct Span {
    std::int64_t first;
    std::size_t index, size;
    [[nodiscard]] bool contains(std::int64_t number) const {
      return number >= first && static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(first) < size;
    }
  };
  std::vector<Span> spans_;  // sorted by first
  mutable std::size_t last_ = 0;
};

/// "coast.msh:41", for the line of an element; the path alone if lines are unknown.
[[nodiscard]] std::string at_line(const std::string& path, const RunLength& lines, std::size_t index);

class FileNames final : public tets::InputNames {
 public:
  explicit FileNames(std::string of) : path(std::move(of)) {}

  [[nodiscard]] std::string point(std::size_t index) const override;
  [[nodiscard]] std::string triangle(std::size_t index) const override;
  [[nodiscard]] std::string point_where(std::size_t index) const override;
  [[nodiscard]] std::string triangle_where(std::size_t index) const override;
  [[nodiscard]] std::string tetrahedron(std::size_t index) const override;
  [[nodiscard]] std::string tetrahedron_where(std::size_t index) const override;
  [[nodiscard]] std::string line(std::size_t index) const override;
  [[nodiscard]] std::string line_where(std::size_t index) const;

  std::string path;
  std::string triangle_path;                       ///< when triangles are in another file than points
  std::string tetrahedron_path;                    ///< when tetrahedra are
  RunLength points, triangles, lines, tetrahedra;  ///< numbers in the file
  RunLength point_lines, triangle_lines, line_lines, tetrahedron_lines;  ///< lines of text; empty: unknown
};

}  // namespace temper::io
