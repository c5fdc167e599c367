// Archives and envelopes: what is written is read, and what was not written so is refused, whatever it is.
#include "temper/archive.hpp"

#include <gtest/gtest.h>

#include "base/rng.hpp"
#include "temper/envelope.hpp"

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

TEST(Envelopes, AreRefusedWhenOneBitIsAnother) {
  const std::string kind = "temper letter", text = "what was written", envelope = in_envelope(kind, text);
  ASSERT_TRUE(from_envelope(kind, envelope));
  EXPECT_EQ(*from_envelope(kind, envelope), text);
  for (std::size_t i = 0; i < 8 * envelope.size(); ++i) {
    std::string changed = envelope;
    changed[i / 8] = static_cast<char>(changed[i / 8] ^ (1 << (i % 8)));
    EXPECT_FALSE(from_envelope(kind, changed)) << "bit " << i;
  }
  for (std::size_t n = 0; n < envelope.size(); ++n) {
    const auto cut = from_envelope(kind, std::string_view(envelope).substr(0, n));
    ASSERT_FALSE(cut) << n;
    EXPECT_EQ(cut.error().code, ErrorCode::truncated) << n;
  }
  EXPECT_EQ(from_envelope(kind, envelope + "x").error().code, ErrorCode::syntax);
  EXPECT_EQ(from_envelope("temper song", envelope).error().code, ErrorCode::syntax);
  EXPECT_EQ(from_envelope(kind, "temper letter, version 0.0.1\n").error().code, ErrorCode::unsupported);
  EXPECT_EQ(*from_envelope(kind, in_envelope(kind, {})), "");
}

}  // namespace
}  // namespace temper
