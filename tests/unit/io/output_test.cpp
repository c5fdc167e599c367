// Output is whole or not at all.
#include <fcntl.h>
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

/// A file that is open and has no name any more, as standard output may be, and a link to it.
class NamelessFile {
 public:
  NamelessFile(const std::string& name, const std::string& link) : file_(open(name.c_str(), O_RDWR | O_CREAT, 0600)) {
    std::filesystem::remove(name);
    std::filesystem::create_symlink(path(), link);
    EXPECT_EQ(::write(file_, "before ", 7), 7);
  }
  ~NamelessFile() { close(file_); }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  [[nodiscard]] int number() const { return file_; }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }
  [[nodiscard]] std::string content() const {
    std::string bytes(100, '\0');
    bytes.resize(static_cast<std::size_t>(pread(file_, bytes.data(), bytes.size(), 0)));
    return bytes;
  }

 private:
  int file_;
};

TEST_F(FileTest, ALinkToAnOpenFileStaysAndTheFileIsWrittenOn) {
  if (!std::filesystem::exists("/proc/self/fd")) GTEST_SKIP() << "no /proc here";
  const NamelessFile file(path("nameless"), path("link.svg"));
  std::filesystem::create_symlink("link.svg", path("second.svg"));
  for (const std::string& name : {path("link.svg"), path("second.svg"), file.path()}) {
    EXPECT_TRUE(is_stream(name)) << name;
    EXPECT_EQ(open_file_of(name), file.number()) << name;
    const auto result = write_text(name, "new ");
    EXPECT_TRUE(result) << result.error().what();
  }
  EXPECT_EQ(file.content(), "before new new new ");
  EXPECT_EQ(std::filesystem::read_symlink(path("link.svg")), file.path());
  EXPECT_EQ(std::filesystem::read_symlink(path("second.svg")), "link.svg");
  EXPECT_EQ(files(), (std::vector<std::string>{"link.svg", "second.svg"}));
}

TEST_F(FileTest, ALinkToAFileOfAnotherProcessStaysAndTheFileGrows) {
  if (!std::filesystem::exists("/proc/self/fd")) GTEST_SKIP() << "no /proc here";
  const std::string parent = "/proc/" + std::to_string(getpid());
  const NamelessFile file(path("nameless"), path("link.svg"));
  std::filesystem::create_symlink(parent + "/fd/" + std::to_string(file.number()), path("other.svg"));
  const pid_t child = fork();
  if (child == 0) _exit(write_text(path("other.svg"), "new") ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(file.content(), "before new");
  EXPECT_EQ(files(), (std::vector<std::string>{"link.svg", "other.svg"}));
}

TEST_F(FileTest, ALinkToAClosedFileIsRefused) {
  const std::string closed = "/proc/self/fd/987";
  if (!std::filesystem::exists("/proc/self/fd")) GTEST_SKIP() << "no /proc here";
  std::filesystem::create_symlink(closed, path("link.svg"));
  const auto result = write_text(path("link.svg"), "new");
  ASSERT_FALSE(result);
  EXPECT_EQ(plain(result.error().what()), "link.svg: cannot be written: the stream is closed. Next: name a file");
  EXPECT_EQ(std::filesystem::read_symlink(path("link.svg")), closed);
  EXPECT_EQ(files(), std::vector<std::string>{"link.svg"});
}

TEST_F(FileTest, ALinkToAFileThatIsNotThereYetStays) {
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("folder/real.svg", path("link.svg"));
  EXPECT_TRUE(write_text(path("link.svg"), "new"));
  EXPECT_EQ(std::filesystem::read_symlink(path("link.svg")), "folder/real.svg");
  EXPECT_EQ(slurp(path("folder/real.svg")), "new");
}

TEST_F(FileTest, LinksInCirclesAreRefused) {
  std::filesystem::create_symlink("b.svg", path("a.svg"));
  std::filesystem::create_symlink("a.svg", path("b.svg"));
  const auto result = write_text(path("a.svg"), "new");
  ASSERT_FALSE(result);
  EXPECT_EQ(plain(result.error().what()), "a.svg: cannot be written: Too many levels of symbolic links");
  EXPECT_EQ(std::filesystem::read_symlink(path("a.svg")), "b.svg");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.svg", "b.svg"}));
}

TEST_F(FileTest, APipeIsWrittenAndStays) {
  ASSERT_EQ(mkfifo(path("pipe.svg").c_str(), 0600), 0);
  const int reader = open(path("pipe.svg").c_str(), O_RDWR);
  std::filesystem::create_symlink("pipe.svg", path("link.svg"));
  EXPECT_TRUE(write_text(path("link.svg"), "new"));
  std::string got(3, ' ');
  EXPECT_EQ(::read(reader, got.data(), 3), 3);
  EXPECT_EQ(got, "new");
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe.svg")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.svg")));
  close(reader);
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
