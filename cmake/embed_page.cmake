# Writes a C++ source with the bytes of a page: cmake -DFROM=report.html -DTO=html_page.cpp -P embed_page.cmake
file(READ ${FROM} hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
string(REGEX REPLACE "((0x..,){24})" "\\1\n" bytes "${bytes}")
file(WRITE ${TO}.new "// Made by cmake/embed_page.cmake.
#include <string_view>

namespace temper::io {

std::string_view html_page();

namespace {

constexpr unsigned char kPage[] = {
${bytes}};

}  // namespace

std::string_view html_page() { return {reinterpret_cast<const char*>(kPage), sizeof kPage}; }

}  // namespace temper::io
")
file(RENAME ${TO}.new ${TO})
