// Free memory by the files of Linux, and of this process.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/system/free_memory.hpp"
#include "temper/io.hpp"

namespace temper::test {
namespace {

class FreeMemory : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(root_); }
  void TearDown() override { std::filesystem::remove_all(root_); }
  void write(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = root_ / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  [[nodiscard]] std::optional<std::uint64_t> found() const { return io::free_memory_in_files(root_.string()); }

 private:
  std::filesystem::path root_ =
      std::filesystem::temp_directory_path() /
      ("temper_memory_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(FreeMemory, IsUnknownWithoutFiles) { EXPECT_EQ(found(), std::nullopt); }

TEST_F(FreeMemory, OfTheMachineIsWhatProgramsCanStillTake) {
  write("proc/meminfo", "MemTotal:       100 kB\nMemFree:        10 kB\nMemAvailable:   60 kB\n");
  EXPECT_EQ(found(), 60u * 1024);
}

TEST_F(FreeMemory, OfAGroupIsItsLimitLessItsUseWithoutTheCache) {
  write("proc/meminfo", "MemAvailable:   60 kB\n");
  write("proc/self/cgroup", "0::/job/step\n");
  write("sys/fs/cgroup/job/step/memory.max", "max\n");
  write("sys/fs/cgroup/job/memory.max", "40000\n");
  write("sys/fs/cgroup/job/memory.current", "15000\n");
  write("sys/fs/cgroup/job/memory.stat", "anon 9000\ninactive_file 5000\n");
  EXPECT_EQ(found(), 30000u);
  write("sys/fs/cgroup/job/step/memory.max", "20000\n");
  EXPECT_EQ(found(), 20000u);
  write("sys/fs/cgroup/job/step/memory.current", "20001\n");
  EXPECT_EQ(found(), 0u);
}

TEST_F(FreeMemory, OfAContainerIsInTheRootOfItsGroups) {
  write("proc/self/cgroup", "5:cpu:/\n4:memory:/docker/0123\n0::/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "50000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "20000\n");
  write("sys/fs/cgroup/memory/memory.stat", "inactive_file 1\ntotal_inactive_file 5000\n");
  EXPECT_EQ(found(), 35000u);
  write("proc/self/cgroup", "0::/\n");
  write("sys/fs/cgroup/memory.max", "12345\n");
  EXPECT_EQ(found(), 12345u);
}

TEST(FreeMemoryOfThisProcess, IsMoreThanNothing) {
  const auto free = io::free_memory();
  EXPECT_GT(free.value_or(1), 0u);
}

}  // namespace
}  // namespace temper::test
