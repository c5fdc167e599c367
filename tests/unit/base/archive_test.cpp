// Archives: what is written is read, and what was not written so is refused, whatever it is.
#include "temper/archive.hpp"

#include <gtest/gtest.h>

#include "base/rng.hpp"

namespace temper {
namespace {

enum class Color { red, green };

struct Leaf {
  std::optional<double> height;
  bool is_green = false;
};
void visit(Archive& archive, Leaf& leaf) {
  auto& [height, is_green] = leaf;
  archive(height, is_green);
}

struct Tree {
  std::vector<Leaf> leaves = {{}, {.height = 0.5, .is_green = true}};
  IdVector<VertexId, Vec2> places = IdVector<VertexId, Vec2>(3, {1, -0.0});
  std::string name = "an oak";
  Color color = Color::green;
  Rng rng{7};

  void visit(Archive& archive) {
    auto& [the_leaves, the_places, the_name, the_color, the_rng] = *this;
    archive(the_leaves, the_places, the_name, the_color, the_rng);
    archive.seal();
  }
};

std::string bytes_of(Tree tree) {
  std::string bytes;
  Archive archive(bytes);
  archive(tree);
  return bytes;
}

TEST(Archives, GiveBackWhatWasWritten) {
  Tree tree;
  tree.rng.next();
  const std::string bytes = bytes_of(tree);
  Tree read;
  read.leaves.clear();
  read.places.clear();
  read.name = "?";
  read.color = Color::red;
  Archive archive{std::string_view(bytes)};
  archive(read);
  EXPECT_TRUE(archive.at_end());
  EXPECT_EQ(bytes_of(read), bytes);
  EXPECT_EQ(read.name, "an oak");
  EXPECT_EQ(read.rng.next(), tree.rng.next());
}

TEST(Archives, FailAtAnyEndThatIsTooEarlyAndNeverTakeMoreMemoryThanBytes) {
  const std::string bytes = bytes_of({});
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    for (const char filler : {'\0', '\xff'}) {
      std::string changed = bytes.substr(0, n) + std::string(bytes.size() - n, filler);
      for (const std::string_view part : {std::string_view(bytes).substr(0, n), std::string_view(changed)}) {
        Tree tree;
        Archive archive(part);
        archive(tree);
        EXPECT_TRUE(archive.failed() || part == bytes);
        EXPECT_LE(tree.leaves.size(), bytes.size());
        EXPECT_LE(tree.places.size(), bytes.size());
      }
    }
  }
}

TEST(Archives, FindOutThatAClassHasAnotherMemberThanWhenItWasWritten) {
  std::string bytes;
  std::uint32_t a = 1, b = 2;
  std::uint64_t both = 0;
  Archive writes(bytes);
  writes(a, b);
  writes.seal();
  Archive reads{std::string_view(bytes)};
  reads(both);
  EXPECT_FALSE(reads.failed());
  reads.seal();
  EXPECT_TRUE(reads.failed());
}

}  // namespace
}  // namespace temper
