// Runs of numbers, and names made of them.
#include "io/text/file_names.hpp"

#include <algorithm>

#include "io/text/failure.hpp"

namespace temper::io {

void RunLength::push_back(std::int64_t value) {
  const bool continues =
      !runs_.empty() && static_cast<std::uint64_t>(runs_.back().value) + (size_ - runs_.back().index) ==
                            static_cast<std::uint64_t>(value);
  if (!continues) runs_.push_back({size_, value});
  ++size_;
}

std::int64_t RunLength::operator[](std::int64_t index) const {
  if (runs_.empty()) return index;
  auto after = std::upper_bound(runs_.begin(), runs_.end(), index, [](std::int64_t i, const Run& run) {
    return i < static_cast<std::int64_t>(run.index);
  });
  const Run& run = after == runs_.begin() ? runs_.front() : *(after - 1);
  return run.value + (index - static_cast<std::int64_t>(run.index));
}

bool RunLength::counts_from(std::int64_t first) const {
  return runs_.empty() || (runs_.size() == 1 && runs_.front().value == first);
}

NumberLookup::NumberLookup(const RunLength& numbers) {
  const auto& runs = numbers.runs_;
  spans_.reserve(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t end = i + 1 < runs.size() ? runs[i + 1].index : numbers.size_;
    spans_.push_back({runs[i].value, runs[i].index, end - runs[i].index});
  }
  std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
}

std::optional<std::size_t> NumberLookup::find(std::int64_t number) const {
  if (spans_.empty()) return std::nullopt;
  if (!spans_[last_].contains(number)) {
    auto after = std::upper_bound(spans_.begin(), spans_.end(), number,
                                  [](std::int64_t n, const Span& span) { return n < span.first; });
    if (after == spans_.begin() || !(after - 1)->contains(number)) return std::nullopt;
    last_ = static_cast<std::size_t>(after - 1 - spans_.begin());
  }
  const Span& span = spans_[last_];
  return span.index + static_cast<std::size_t>(number - span.first);
}

std::optional<std::int64_t> NumberLookup::duplicate() const {
  for (std::size_t i = 1; i < spans_.size(); ++i) {
    if (spans_[i - 1].contains(spans_[i].first)) return spans_[i].first;
  }
  return std::nullopt;
}

namespace {

std::string named(const char* kind, const RunLength& numbers, std::size_t index) {
  return text(kind, numbers[static_cast<std::int64_t>(index)]);
}

}  // namespace

std::string at_line(const std::string& path, const RunLength& lines, std::size_t index) {
  return index < lines.size() ? text(path, ":", lines[static_cast<std::int64_t>(index)]) : path;
}

std::string FileNames::point(std::size_t index) const { return named("point ", points, index); }
std::string FileNames::triangle(std::size_t index) const { return named("triangle ", triangles, index); }
std::string FileNames::tetrahedron(std::size_t index) const { return named("tetrahedron ", tetrahedra, index); }
std::string FileNames::line(std::size_t index) const { return named("line ", lines, index); }

std::string FileNames::point_where(std::size_t index) const { return at_line(path, point_lines, index); }
std::string FileNames::triangle_where(std::size_t index) const {
  return at_line(triangle_path.empty() ? path : triangle_path, triangle_lines, index);
}
std::string FileNames::tetrahedron_where(std::size_t index) const {
  return at_line(tetrahedron_path.empty() ? path : tetrahedron_path, tetrahedron_lines, index);
}
std::string FileNames::line_where(std::size_t index) const { return at_line(path, line_lines, index); }

}  // namespace temper::io
