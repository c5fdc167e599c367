// Values as bytes: what is written is read, and nothing is read beyond the end.
#include "base/bytes.hpp"

#include <gtest/gtest.h>

#include "temper/detail/ids.hpp"

namespace temper {
namespace {

struct Message {
  double height = 0;
  std::vector<VertexId> vertices, none;
  std::uint8_t degree = 0;
  friend bool operator==(const Message&, const Message&) = default;
};

const Message kMessage = {2.5, {VertexId(7), VertexId(1)}, {}, 6};

std::string written(const Message& m) {
  std::string bytes;
  ByteWriter writer(bytes);
  writer.write(m.height);
  writer.write(m.vertices);
  writer.write(m.none);
  writer.write(m.degree);
  return bytes;
}

/// Says whether the bytes are those of a message.
bool reads(std::string_view bytes, Message& m) {
  ByteReader reader(bytes);
  reader.read(m.height);
  reader.read(m.vertices);
  reader.read(m.none);
  reader.read(m.degree);
  return reader.at_end();
}

TEST(Bytes, GiveBackWhatWasWritten) {
  Message read;
  EXPECT_TRUE(reads(written(kMessage), read));
  EXPECT_EQ(read, kMessage);
}

TEST(Bytes, FailWhenSomeAreMissingOrLeft) {
  const std::string bytes = written(kMessage);
  Message read;
  for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(reads(std::string_view(bytes).substr(0, n), read)) << n;
  EXPECT_FALSE(reads(bytes + "x", read));
}

TEST(Bytes, ThatCountMoreElementsThanThereAreTakeNoMemory) {
  std::string bytes = written(kMessage);
  bytes[sizeof(double) + 7] = '\x7f';  // the highest byte of the number of vertices
  Message read;
  EXPECT_FALSE(reads(bytes, read));
  EXPECT_TRUE(read.vertices.empty());
}

}  // namespace
}  // namespace temper
