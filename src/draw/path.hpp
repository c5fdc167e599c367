// The d attribute of an SVG path in few bytes: relative integer coordinates, and no byte that SVG's grammar
// can do without. "m3 4l-1-2 5 0z": a minus sign separates, a repeated l is left out.
#pragma once

#include <cstdint>
#include <string>

#include "draw/frame.hpp"

namespace temper {

class PathText {
 public:
  void move_to(GridPoint p);
  void line_to(GridPoint p);
  void close();
  /// A whole circle.
  void circle(GridPoint center, std::int64_t radius);
  /// A separate segment, in whichever direction goes on from where the path is.
  void segment(GridPoint a, GridPoint b);

  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void command(char c);
  void number(std::int64_t value);
  void step_to(GridPoint p);

  std::string text_;
  GridPoint at_;      // where the path is
  GridPoint start_;   // where its subpath began
  char last_ = '\0';  // the command that a bare pair of numbers would repeat
};

}  // namespace temper
