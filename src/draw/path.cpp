#include "draw/path.hpp"

#include <charconv>

namespace temper {

void PathText::command(char c) {
  if (c != last_) text_ += c;
  last_ = c;
}

void PathText::number(std::int64_t value) {
  const char before = text_.empty() ? '\0' : text_.back();
  if (value >= 0 && before >= '0' && before <= '9') text_ += ' ';
  char buffer[24];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  text_.append(buffer, result.ptr);
}

void PathText::step_to(GridPoint p) {
  number(p.x - at_.x);
  number(p.y - at_.y);
  at_ = p;
}

void PathText::move_to(GridPoint p) {
  last_ = '\0';  // a pair after a move would be a line
  command('m');
  step_to(p);
  start_ = p;
}

void PathText::line_to(GridPoint p) {
  command('l');
  step_to(p);
}

void PathText::close() {
  text_ += 'z';
  last_ = '\0';
  at_ = start_;
}

void PathText::circle(GridPoint center, std::int64_t radius) {
  if (radius <= 0) return;
  move_to({center.x - radius, center.y});
  for (const std::int64_t across : {2 * radius, -2 * radius}) {
    command('a');
    number(radius);
    number(radius);
    text_ += " 0 1 0";
    number(across);
    number(0);
  }
  close();
}

void PathText::segment(GridPoint a, GridPoint b) {
  if (a == b) return;
  const bool goes_on = !text_.empty() && last_ == 'l';
  if (goes_on && at_ == a) return line_to(b);
  if (goes_on && at_ == b) return line_to(a);
  move_to(a);
  line_to(b);
}

}  // namespace temper
