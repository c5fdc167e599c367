#include "completions.hpp"

#include <algorithm>
#include <array>

namespace temper::app {
namespace {

// Names of values that stand for something. All others of a list a|b|c are words to be typed.
constexpr std::array<std::string_view, 7> kFiles = {"FILE", "IN", "IN0", "MESH", "OUT", "OUTLINE", "TRACE"};
constexpr std::string_view kFolder = "DIR";
constexpr std::array<std::string_view, 4> kStandIns = {"N", "X", "VERTEX", "KIND[:lon,lat]"};

template <class Names>
bool has(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> alternatives(const std::string& value_name) {
  std::vector<std::string> parts = {""};
  for (const char c : value_name) {
    if (c == '|') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

Completion completion_of(const Option& option) {
  const std::vector<std::string> parts = alternatives(option.is_argument() ? option.names : option.value_name);
  Completion completion;
  for (const std::string& part : parts) {
    if (has(kFiles, part)) {
      completion.kind = Completion::Kind::file;
    } else if (part == kFolder) {
      completion.kind = Completion::Kind::folder;
    } else if (parts.size() > 1 && !has(kStandIns, part)) {
      completion.words.push_back(part);
    }
  }
  if (completion.kind == Completion::Kind::nothing && !completion.words.empty())
    completion.kind = Completion::Kind::words;
  return completion;
}

std::string first_clause(const std::string& sentence) {
  constexpr std::size_t kLongest = 70;
  std::string clause = sentence.substr(0, sentence.find_first_of(";(:"));
  if (clause.size() > kLongest) clause = clause.substr(0, clause.rfind(' ', kLongest));
  while (!clause.empty() && (clause.back() == ' ' || clause.back() == ',')) clause.pop_back();
  return clause;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string escaped(const std::string& text, std::string_view special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

}  // namespace temper::app
