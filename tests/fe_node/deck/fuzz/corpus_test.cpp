// Every input of the fuzzer's corpus goes the fuzzer's way without its engine: whatever once
// crashed, hung or contradicted itself stays mended. A failure aborts and names what it met.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/source_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace crosswalk::fe {
namespace {

std::vector<std::filesystem::path> corpus() {
  std::vector<std::filesystem::path> out;
  for (const auto& entry :
       std::filesystem::directory_iterator(source_folder() / "tests/fe_node/deck/fuzz/corpus"))
    out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

std::string name_of(const testing::TestParamInfo<std::filesystem::path>& input) {
  return input.param.stem().string();
}

class FuzzedDeck : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(FuzzedDeck, EndsInAModelOrInProblems) {
  std::ifstream in(GetParam(), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
            0);
}

INSTANTIATE_TEST_SUITE_P(Corpus, FuzzedDeck, testing::ValuesIn(corpus()), name_of);

}  // namespace
}  // namespace crosswalk::fe
