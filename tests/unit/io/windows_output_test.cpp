// Outputs on Windows: files that other programs hold open, names in any language, and runs that are killed.
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
// After it:
#include "support.hpp"
#include "temper/detail/path.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

class WindowsOutput : public FileTest {
 protected:
  /// All names in the folder.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path_of(path(""))))
      found.push_back(utf8(entry.path().filename()));
    std::sort(found.begin(), found.end());
    return found;
  }
};

using Names = std::vector<std::string>;

TEST_F(WindowsOutput, ReplacesAFile) {
  ASSERT_TRUE(write_text(path("a.txt"), "old"));
  ASSERT_TRUE(write_text(path("a.txt"), "new\n"));
  EXPECT_EQ(slurp(path("a.txt")), "new\n");
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(WindowsOutput, LeavesAFileThatAnotherProgramHoldsOpen) {
  ASSERT_TRUE(write_text(path("a.txt"), "old"));
  const HANDLE held = CreateFileW(path_of(path("a.txt")).c_str(), GENERIC_READ, 0, nullptr, OPEN_EXISTING, 0, nullptr);
  ASSERT_NE(held, INVALID_HANDLE_VALUE);
  const auto written = write_text(path("a.txt"), "new");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("another program has it open"), std::string::npos) << written.error().what();
  CloseHandle(held);
  EXPECT_EQ(slurp(path("a.txt")), "old");
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_TRUE(write_text(path("a.txt"), "new"));
}

TEST_F(WindowsOutput, TakesNamesOfAnyLanguageInUtf8) {
  const std::string name = path("Gew\xc3\xa4sser \xe6\x97\xa5\xe6\x9c\xac.obj");
  ASSERT_TRUE(write_text(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(names(), Names{utf8(path_of(name).filename())});
  const auto file = read(name);
  ASSERT_TRUE(file) << file.error().what();
  EXPECT_EQ(file->triangles.size(), 1u);
}

TEST_F(WindowsOutput, LetsTwoWritersOfOneFileBothFinish) {
  auto first = TextStream::open(path("a.txt")), second = TextStream::open(path("a.txt"));
  ASSERT_TRUE(first && second);
  first->write("first"), second->write("second");
  ASSERT_TRUE(second->commit());
  EXPECT_EQ(slurp(path("a.txt")), "second");
  ASSERT_TRUE(first->commit());
  EXPECT_EQ(slurp(path("a.txt")), "first");
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(WindowsOutput, RemovesAnUnfinishedFile) {
  {
    auto stream = TextStream::open(path("a.txt"));
    ASSERT_TRUE(stream);
    stream->write("lost");
  }
  EXPECT_EQ(names(), Names{});
}

TEST_F(WindowsOutput, ReplacesTheTemporaryFileOfACrash) {
  spill(path("a.txt.tmp0"), "left over");
  ASSERT_TRUE(write_text(path("a.txt"), "new"));
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(WindowsOutput, SaysThatAFolderIsMissing) {
  const auto written = write_text(path("no folder/a.txt"), "x");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("No such file or directory"), std::string::npos) << written.error().what();
}

}  // namespace
}  // namespace temper::io
