#include "common/byte_archive.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace crosswalk {
namespace {

struct Sample {
  std::int64_t step = 0;
  std::vector<double> nodes;
  std::vector<int> touched;
};

template <class Archive, class State>
void visit(Archive& archive, State& state) {
  archive.value(state.step);
  archive.values(state.nodes);
  archive.list(state.touched);
}

std::vector<std::byte> bytes_of(const Sample& sample) {
  ByteWriter writer;
  visit(writer, sample);
  return writer.take();
}

TEST(ByteArchive, ReturnsWhatWasWrittenBitForBit) {
  const Sample written{7, {0.1, -0.0, 1e-310}, {4, 5}};
  const std::vector<std::byte> bytes = bytes_of(written);
  Sample read{0, std::vector<double>(3), {}};
  ByteReader reader(bytes);
  visit(reader, read);
  reader.require_end();
  EXPECT_EQ(read.step, 7);
  EXPECT_EQ(read.touched, written.touched);
  EXPECT_EQ(bytes_of(read), bytes);
}

TEST(ByteArchive, RefusesBytesOfAnotherModel) {
  const std::vector<std::byte> bytes = bytes_of({7, {1, 2, 3}, {}});
  Sample read{0, std::vector<double>(2), {}};
  ByteReader reader(bytes);
  EXPECT_THROW(visit(reader, read), ProtocolError);
}

TEST(ByteArchive, RefusesBytesThatEndTooEarlyOrTooLate) {
  std::vector<std::byte> bytes = bytes_of({7, {1, 2, 3}, {4}});
  Sample read{0, std::vector<double>(3), {}};
  bytes.push_back(std::byte{0});
  ByteReader longer(bytes);
  visit(longer, read);
  EXPECT_THROW(longer.require_end(), ProtocolError);
  bytes.resize(bytes.size() - 2);
  ByteReader shorter(bytes);
  EXPECT_THROW(visit(shorter, read), ProtocolError);
}

}  // namespace
}  // namespace crosswalk
