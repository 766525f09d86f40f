// ISO-MME: the sample of the vectors, our own files read back, and what a reader must refuse.
#include "recorder/isomme.h"

#include <cmath>
#include <fstream>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "common/error.h"
#include "tests/recorder/vectors.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;

TEST(IsoMmeVectors, TheSampleIsReadAsStated) {
  const nlohmann::json wanted = expected("isomme");
  const MmeTest test = read_isomme(vector_folder("isomme") / wanted["test"].get<std::string>());
  EXPECT_EQ(test.name, wanted["test"]);
  std::vector<std::string> comments;
  for (const auto& [key, value] : test.header) {
    if (key == "Comments") comments.push_back(value);
  }
  EXPECT_EQ(nlohmann::json(comments), wanted["header_lines_with_key_Comments"]);
  ASSERT_EQ(test.channels.size(), wanted["channels"].size());
  for (std::size_t i = 0; i < test.channels.size(); ++i) {
    const MmeChannel& c = test.channels[i];
    const nlohmann::json& w = wanted["channels"][i];
    EXPECT_EQ(c.code, w["code"]);
    EXPECT_EQ(c.unit, w["unit"]);
    ASSERT_EQ(c.values.size(), w["n"].get<std::size_t>());
    if (w.value("constant", false)) {
      EXPECT_TRUE(c.is_constant);
      EXPECT_EQ(c.values[0], w["value"]);
      continue;
    }
    EXPECT_EQ(c.time[0], w["t0"]);
    EXPECT_NEAR(c.time[1] - c.time[0], w["dt"].get<double>(), 1e-15);
    EXPECT_EQ(c.values.front(), w["first"]);
    EXPECT_EQ(c.values.back(), w["last"]);
    std::vector<int> missing;
    double sum = 0, low = INFINITY, high = -INFINITY;
    for (std::size_t k = 0; k < c.values.size(); ++k) {
      if (std::isnan(c.values[k])) {
        missing.push_back(static_cast<int>(k));
        continue;
      }
      sum += c.values[k];
      low = std::min(low, c.values[k]);
      high = std::max(high, c.values[k]);
    }
    EXPECT_EQ(nlohmann::json(missing), w["missing"]);
    EXPECT_NEAR(sum, w["sum"].get<double>(), 1e-9 * std::abs(w["sum"].get<double>()));
    EXPECT_EQ(low, w["min"]);
    EXPECT_EQ(high, w["max"]);
  }
}

struct IsoMme : ::testing::Test {
  fs::path folder =
      fs::temp_directory_path() /
      (std::string("cw_mme_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  ~IsoMme() override { fs::remove_all(folder); }

  static MmeTest sample() {
    Channel a{"head_acceleration_x",
              "mps2",
              std::string(120, 'd'),
              -0.001,
              5e-5,
              {0.1, 1.0 / 3, -2e-17, std::nan("")}};
    Channel r = a;
    r.name = "head_angular_acceleration_resultant";  // longer than a line of the list takes
    r.unit = "radps2";
    Channel d{"head_cog_y", "mm", "displacement", -0.001, 5e-5, {1, 2, 3, 4}};
    Channel none{"mb_kinetic_energy", "J", "no code", 0, 1, {1, 2}};
    MmeTest test = mme_test("TEST01", {a, d, none, r}, {{"Title", "a run"}});
    test.channels.push_back(mme_constant("D0HICRCG15VH00RX", "HIC15", 689.0518434038969));
    return test;
  }
};

TEST_F(IsoMme, WhatIsWrittenComesBack) {
  const MmeTest test = sample();
  write_isomme(folder, test);
  const MmeTest back = read_isomme(folder);
  ASSERT_EQ(back.channels.size(), 4U);
  EXPECT_EQ(value_of(back.header, "Title"), "a run");
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(back.channels[c].code, test.channels[c].code);
    EXPECT_EQ(back.channels[c].name, test.channels[c].name);
    EXPECT_EQ(back.channels[c].unit, test.channels[c].unit);
    ASSERT_EQ(back.channels[c].values.size(), test.channels[c].values.size());
    for (std::size_t i = 0; i < test.channels[c].values.size(); ++i) {
      const double wanted = test.channels[c].values[i];
      EXPECT_TRUE(back.channels[c].values[i] == wanted ||
                  (std::isnan(wanted) && std::isnan(back.channels[c].values[i])));
    }
  }
  EXPECT_DOUBLE_EQ(back.channels[1].values[3], 0.004);  // mm to m
  EXPECT_EQ(value_of(back.channels[0].header, "Channel frequency class"), "1000");
}

TEST_F(IsoMme, EveryKeyOfTheTestIsWrittenOnce) {
  write_isomme(folder, sample());
  std::map<std::string, std::string> header;
  for (const auto& [key, value] : read_isomme(folder).header) {
    EXPECT_TRUE(header.emplace(key, value).second) << key;
  }
  EXPECT_EQ(header.at("Laboratory test ref. number"), "TEST01");
  EXPECT_EQ(header.at("Title"), "a run");
  EXPECT_EQ(header.at("Customer name"), "NOVALUE");
}

TEST_F(IsoMme, LinesEndInCrLfAndStayWithin80Characters) {
  write_isomme(folder, sample());
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    for (std::string line; std::getline(in, line);) {
      ASSERT_FALSE(line.empty());
      EXPECT_EQ(line.back(), '\r') << entry.path();
      EXPECT_LE(line.size() - 1, 80U) << entry.path() << ": " << line;
    }
  }
}

TEST_F(IsoMme, ExplicitTimesComeFromTheNamedChannel) {
  write_isomme(folder, sample());
  const auto put = [&](const char* number, const std::string& text) {
    std::ofstream(folder / "Channel" / (std::string("TEST01.") + number), std::ios::binary) << text;
  };
  std::ofstream(folder / "Channel/TEST01.chn") << "Name of channel 001 :11TIRS000000TI0P / time\n"
                                               << "Name of channel 002 :D0HEADCG00VHACXA / a\n";
  put("001",
      "Channel code :11TIRS000000TI0P\nUnit\t:s\nReference channel :NOVALUE\n0.0\n0.1\n0.4\n");
  put("002",
      "Channel code :D0HEADCG00VHACXA\nUnit :m/(s*s)\nReference channel :explicit\n"
      "Reference channel name :11TIRS000000TI0P\n1\n2\n3\n");
  const MmeTest back = read_isomme(folder);
  EXPECT_EQ(back.channels[1].time, (std::vector<double>{0.0, 0.1, 0.4}));
  EXPECT_FALSE(back.channels[1].is_constant);
}

TEST_F(IsoMme, DamagedFilesAreRefusedByName) {
  write_isomme(folder, sample());
  std::ofstream(folder / "Channel/TEST01.001", std::ios::app) << "not a number\r\n";
  EXPECT_THROW(read_isomme(folder), UserError);
  EXPECT_THROW(read_isomme("/nowhere"), UserError);
}

/// A dummy's raw channel (Hybrid III, no filter) is our head acceleration; other places are not.
TEST(IsoMmeCodes, OtherDummiesAndFiltersAreTheSameQuantity) {
  const auto channel = [](const char* code, const char* unit) {
    return MmeChannel{code, "", unit, false, {0, 1e-4, 2e-4}, {1, 2, 3}, {}};
  };
  MmeTest test{"T",
               {},
               {channel("11HEAD0000H3ACX0", "m/(s*s)"), channel("D0HEADCG00VHDS20", "m"),
                channel("11CHST0000H3ACXA", "m/(s*s)"), channel("11HEAD0000H3ACYA", "g")}};
  const std::vector<Channel> found = channels_of(test);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "head_acceleration_x");
  EXPECT_EQ(found[1].name, "head_cog_y");
  EXPECT_EQ(found[1].unit, "mm");
  EXPECT_DOUBLE_EQ(found[1].samples[2], 3000);
  EXPECT_DOUBLE_EQ(found[1].dt, 1e-4);
}

TEST_F(IsoMme, ChannelsComeBackUnderOurNames) {
  write_isomme(folder, sample());
  EXPECT_TRUE(is_isomme(folder));
  const std::vector<Channel> back = channels_of(read_isomme(folder));
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(back[1].name, "head_cog_y");
  EXPECT_EQ(back[1].samples, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_DOUBLE_EQ(back[1].t0, -0.001);
}

TEST(IsoMmeCodes, AreSixteenCharacters) {
  for (const char* name :
       {"head_acceleration_x", "head_cog_y", "buck_velocity_y", "head_speed_relative"}) {
    EXPECT_EQ(mme_code(name).size(), 16U) << name;
  }
  EXPECT_EQ(mme_code("head_acceleration_resultant"), "D0HEADCG00VHACRA");
}

}  // namespace
}  // namespace crosswalk::recording
