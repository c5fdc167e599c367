#include "io/text/names.hpp"

#include <algorithm>

#include "io/text/failure.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

/// use(name) for the name of each array and each group.
template <class File, class Use>
void for_each_name(File& file, Use use) {
  for (auto* arrays : all_data(file)) {
    for (auto& array : *arrays) use(array.name);
  }
  for (auto& name : file.names) use(name.name);
}

}  // namespace

std::string TakenNames::take(std::string name) {
  const auto [known, is_new] = next_.emplace(std::move(name), 2);
  if (is_new) return known->first;
  for (;;) {
    std::string other = text(known->first, "_", known->second++);
    if (next_.emplace(other, 2).second) return other;
  }
}

void make_names_unique(std::vector<DataArray>& arrays) {
  TakenNames taken;
  for (DataArray& array : arrays) array.name = taken.take(std::move(array.name));
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}
std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

std::size_t suffix_length(std::string_view suffixes, std::string_view path, bool any_case) {
  const auto lower = [any_case](char c) { return any_case && c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  std::size_t longest = 0;
  while (!suffixes.empty()) {
    const std::string_view suffix = suffixes.substr(0, suffixes.find(' '));
    const bool fits = path.size() >= suffix.size() &&
                      std::ranges::equal(path.substr(path.size() - suffix.size()), suffix, {}, lower, lower);
    if (fits) longest = std::max(longest, suffix.size());
    suffixes.remove_prefix(std::min(suffix.size() + 1, suffixes.size()));
  }
  return longest;
}

void append_percent(std::string& text, char c) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const auto code = static_cast<unsigned char>(c);
  text += {'%', kHex[code >> 4], kHex[code & 15]};
}

std::string list_of(const std::vector<std::string_view>& names) {
  constexpr std::size_t kMost = 100;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) list += text(i == 0 ? "" : ", ", names[i]);
  return names.size() > kMost ? text(list, " and ", names.size() - kMost, " more") : list;
}

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : printable(name)) {
    if (c == '\n') {
      plain += "\\x0a";
    } else if (c == '\t') {
      plain += "\\x09";
    } else {
      plain += c;
    }
  }
  return plain;
}

std::string listed(std::size_t n, std::string_view what, const std::vector<std::string>& names) {
  std::string result = text(n, " ", what, ": ");
  for (std::size_t i = 0; i < names.size(); ++i) result += (i == 0 ? "" : ", ") + names[i];
  return n > names.size() ? result + ", …" : result;
}

void make_names_plain(MeshFile& file) {
  std::size_t n = 0;
  std::string first;
  for_each_name(file, [&](std::string& name) {
    std::string plain = plain_name(name);
    if (plain == name) return;
    name = std::move(plain);
    if (n++ == 0) first = name;
  });
  if (n == 0) return;
  file.warnings.push_back(text(file.path, ": ", n, n == 1 ? " name has" : " names have",
                               " control characters, or bytes that are no UTF-8: read as '", first,
                               n == 1 ? "'" : "' and the like"));
}

void check_names(const std::string& path, const MeshFile& file) {
  for_each_name(file, [&](const std::string& name) {
    const std::string plain = plain_name(name);
    if (plain == name) return;
    fail(ErrorCode::unsupported, path, "the mesh to be written has the name '", plain,
         "'; expected one in UTF-8 without control characters");
  });
}

}  // namespace temper::io
