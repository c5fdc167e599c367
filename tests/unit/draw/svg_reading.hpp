// Reading back what src/draw writes: is the document well-formed, which segments has a path?
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/viewport.hpp"

namespace temper::test {

// The nesting of the document's tags, checked by hand: what is opened is closed, and nothing is stray.
inline void expect_well_formed(std::string_view svg) {
  std::vector<std::string> open;
  std::size_t elements = 0;
  for (std::size_t at = svg.find('<'); at != std::string_view::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    ASSERT_NE(end, std::string_view::npos);
    std::string_view tag = svg.substr(at + 1, end - at - 1);
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), tag.substr(1));
      open.pop_back();
      continue;
    }
    ++elements;
    std::size_t quotes = 0;
    for (const char c : tag) quotes += c == '"';
    EXPECT_EQ(quotes % 2, 0u) << tag;
    const std::string name(tag.substr(0, tag.find_first_of(" /")));
    EXPECT_NE(std::isalpha(static_cast<unsigned char>(name[0])), 0) << tag;
    if (tag.back() != '/') open.push_back(name);
  }
  EXPECT_TRUE(open.empty());
  EXPECT_GT(elements, 3u);
  EXPECT_EQ(svg.find("nan"), std::string_view::npos);
  EXPECT_EQ(svg.find("inf"), std::string_view::npos);
}

inline std::size_t count(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

// Reads the subset of SVG paths that PathText writes: m, l, z and whole circles of two a.
struct PathReader {
  std::string text;
  std::size_t at = 0;

  [[nodiscard]] bool more_numbers() {
    while (at < text.size() && text[at] == ' ') ++at;
    return at < text.size() && (text[at] == '-' || std::isdigit(static_cast<unsigned char>(text[at])) != 0);
  }
  std::int64_t number() {
    EXPECT_TRUE(more_numbers()) << text.substr(at);
    std::size_t used = 0;
    const std::int64_t value = std::stoll(text.substr(at), &used);
    at += used;
    return value;
  }
};

struct Read {
  std::vector<std::pair<GridPoint, GridPoint>> segments;
  std::vector<std::pair<GridPoint, std::int64_t>> circles;
};

inline Read read_path(const std::string& text) {
  PathReader r{text};
  Read result;
  GridPoint at, start;
  while (r.at < text.size()) {
    const char command = text[r.at++];
    if (command == 'z') {
      if (!(at == start)) result.segments.push_back({at, start});
      at = start;
      continue;
    }
    EXPECT_NE(std::string("mla").find(command), std::string::npos) << command;
    if (command == 'a') {
      do {  // a repeated command is left out
        const std::int64_t radius = r.number();
        EXPECT_EQ(r.number(), radius);
        for (const std::int64_t flag : {0, 1, 0}) EXPECT_EQ(r.number(), flag);
        const std::int64_t across = r.number();
        EXPECT_EQ(std::abs(across), 2 * radius);
        EXPECT_EQ(r.number(), 0);
        at.x += across;
        if (across > 0) result.circles.push_back({{at.x - radius, at.y}, radius});
      } while (r.more_numbers());
      continue;
    }
    do {
      const GridPoint from = at;
      at.x += r.number();
      at.y += r.number();
      if (command == 'm') {
        start = at;
        EXPECT_FALSE(r.more_numbers()) << "numbers after a move would be a line";
      } else {
        result.segments.push_back({from, at});
      }
    } while (r.more_numbers());
  }
  return result;
}

}  // namespace temper::test
