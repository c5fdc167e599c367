// Output is whole or not at all.
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "support.hpp"

namespace temper::io {
namespace {

/// Files may not grow beyond so many bytes: a full disk, as far as a program can tell.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    old_ = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before_;
    small.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, old_);
  }

 private:
  rlimit before_{};
  void (*old_)(int) = nullptr;
};

TEST_F(FileTest, AFullDiskIsReportedAndTheOldFileStays) {
  for (const char* file : {"m.vtu", "m.msh", "m.mesh", "m.obj", "m.node"}) {
    make(file, "the old file");
    const auto before = files();
    Expected<std::vector<std::string>> result = std::vector<std::string>{};
    {
      const SmallDisk disk(100);
      result = write(path(file), sample());
    }
    ASSERT_FALSE(result) << file;
    EXPECT_EQ(result.error().code, ErrorCode::not_writable);
    EXPECT_EQ(plain(result.error().what()),
              std::string(file) + ": cannot be written: File too large; what was there before is unchanged");
    EXPECT_EQ(slurp(path(file)), "the old file");
    EXPECT_EQ(files(), before) << "a temporary file was left behind";
  }
}

TEST_F(FileTest, AFullDeviceIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const auto result = write("/dev/full", sample(), {"vtu", {}});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().what(), "/dev/full: cannot be written: No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(FileTest, AnOutputInNoFolderOrThatIsAFolderIsReported) {
  const auto nowhere = write(path("no/such/m.vtu"), sample());
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::not_writable);
  EXPECT_EQ(plain(nowhere.error().what()), "no/such/m.vtu: cannot be written: No such file or directory");
  std::filesystem::create_directory(path("folder.vtu"));
  const auto folder = write(path("folder.vtu"), sample());
  ASSERT_FALSE(folder);
  EXPECT_EQ(plain(folder.error().what()), "folder.vtu: is a directory; expected the name of a file");
}

TEST_F(FileTest, WhenOneOfSeveralFilesFailsNoneIsChanged) {
  make("m.node", "old points");
  std::filesystem::create_directory(path("m.ele"));
  const auto result = write(path("m.node"), sample());
  ASSERT_FALSE(result);
  EXPECT_EQ(plain(result.error().what()), "m.ele: is a directory; expected the name of a file");
  EXPECT_EQ(slurp(path("m.node")), "old points");
  EXPECT_EQ(files(), (std::vector<std::string>{"m.ele", "m.node"}));
}

TEST_F(FileTest, ALinkStaysALinkAndPermissionsStay) {
  make("real.vtu", "old");
  std::filesystem::permissions(path("real.vtu"),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::create_symlink("real.vtu", path("link.vtu"));
  ASSERT_TRUE(write(path("link.vtu"), sample()));
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.vtu")));
  EXPECT_TRUE(slurp(path("real.vtu")).starts_with("<?xml"));
  EXPECT_EQ(std::filesystem::status(path("real.vtu")).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(FileTest, WhatAKilledRunLeftIsRemovedByTheNextOne) {
  const pid_t child = fork();
  if (child == 0) {
    auto stream = TextStream::open(path("a.svg"));
    stream->write(std::string(1000000, 'x'));
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(files(), std::vector<std::string>{"a.svg.tmp0"});
  ASSERT_TRUE(write_text(path("a.svg"), "whole"));
  EXPECT_EQ(files(), std::vector<std::string>{"a.svg"});
  EXPECT_EQ(slurp(path("a.svg")), "whole");
}

TEST_F(FileTest, TwoRunsThatWriteOneFileDoNotMeet) {
  auto first = TextStream::open(path("a.svg")), second = TextStream::open(path("a.svg"));
  ASSERT_TRUE(first && second);
  first->write("first");
  second->write("second");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.svg.tmp0", "a.svg.tmp1"}));
  EXPECT_TRUE(first->commit());
  EXPECT_EQ(slurp(path("a.svg")), "first");
  EXPECT_TRUE(second->commit());
  EXPECT_EQ(slurp(path("a.svg")), "second");
}

TEST_F(FileTest, WhatIsUnfinishedCanBeDiscarded) {
  make("a.svg", "old");
  auto stream = TextStream::open(path("a.svg"));
  ASSERT_TRUE(stream);
  stream->write("new");
  discard_unfinished();
  EXPECT_EQ(files(), std::vector<std::string>{"a.svg"});
  const auto result = stream->commit();
  ASSERT_FALSE(result);
  EXPECT_EQ(plain(result.error().what()),
            "a.svg: cannot be replaced: No such file or directory; what was there before is unchanged");
  EXPECT_EQ(slurp(path("a.svg")), "old");
}

TEST_F(FileTest, TextIsWrittenWhole) {
  const std::string text(1000000, 'x');
  ASSERT_TRUE(write_text(path("a.svg"), text));
  EXPECT_EQ(slurp(path("a.svg")), text);
  EXPECT_EQ(files(), std::vector<std::string>{"a.svg"});
  {
    const SmallDisk disk(1000);
    EXPECT_FALSE(write_text(path("a.svg"), std::string(2000000, 'y')));
  }
  EXPECT_EQ(slurp(path("a.svg")), text);
}

}  // namespace
}  // namespace temper::io
