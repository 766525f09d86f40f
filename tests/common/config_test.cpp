#include "common/config.h"

#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace crosswalk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

ConfigDocument document(const std::string& text) {
  return ConfigDocument::from_text(text, "test.toml");
}

/// What a user reads after `read` has asked for its keys; empty when all is well.
std::string complaint(const std::string& text, const std::function<void(ConfigTable)>& read) {
  ConfigDocument doc = document(text);
  read(doc.root());
  try {
    doc.finish();
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

void read_height(ConfigTable root) {
  root.table("subject", "").quantity("standing_height", Dimension::Length, {1.2, 2.2}, "");
}

class ConfigFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("config_test_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }
  fs::path folder_;
};

TEST(Config, QuantitiesComeInSiWhateverTheUnit) {
  ConfigDocument doc = document(
      "height_mm = 1795.0\nspeed_km_h = 36\nangle_deg = 180\ndrop_g = 2\nloss_kN = 1.5\n"
      "spring_N_per_mm = 3\nplain = 4\nwarm_degC = 20\n");
  ConfigTable root = doc.root();
  EXPECT_DOUBLE_EQ(root.quantity("height", Dimension::Length, {}, ""), 1.795);
  EXPECT_DOUBLE_EQ(root.quantity("speed", Dimension::Speed, {}, ""), 10.0);
  EXPECT_DOUBLE_EQ(root.quantity("angle", Dimension::Angle, {}, ""), kPi);
  EXPECT_DOUBLE_EQ(root.quantity("drop", Dimension::Acceleration, {}, ""), 2 * kStandardGravity);
  EXPECT_DOUBLE_EQ(root.quantity("loss", Dimension::Force, {}, ""), 1500.0);
  EXPECT_DOUBLE_EQ(root.quantity("spring", Dimension::Stiffness, {}, ""), 3000.0);
  EXPECT_DOUBLE_EQ(root.quantity("plain", Dimension::None, {}, ""), 4.0);
  EXPECT_DOUBLE_EQ(root.quantity("warm", Dimension::Temperature, {}, ""), 293.15);
  EXPECT_NO_THROW(doc.finish());
}

TEST(Config, UnknownKeySuggestsTheNearestAndHidesTheMissingOne) {
  EXPECT_EQ(complaint("[subject]\n\n\nstanding_heigth_mm = 1795\n", read_height),
            "test.toml:4:1: subject.standing_heigth_mm: unknown key; did you mean "
            "`standing_height_mm`?");
}

TEST(Config, OutOfRangeValueAsksForTheUnitThatFits) {
  EXPECT_EQ(complaint("[subject]\nstanding_height_m = 1795\n", read_height),
            "test.toml:2:21: subject.standing_height_m: expected 1.2 .. 2.2 m, found 1795; is the "
            "value in mm? write `standing_height_mm`");
  EXPECT_EQ(complaint("[subject]\nstanding_height_mm = 3000\n", read_height),
            "test.toml:2:22: subject.standing_height_mm: expected 1200 .. 2200 mm, found 3000");
}

TEST(Config, MissingKeyShowsAnExample) {
  const std::string text = complaint("[subject]\n", [](ConfigTable root) {
    root.table("subject", "").quantity("mass", Dimension::Mass, kPositive, "");
  });
  EXPECT_EQ(text,
            "test.toml:1:1: subject.mass: missing; expected a mass, for example `mass_kg = 1.0`");
}

TEST(Config, DoubledUnitIsRefused) {
  EXPECT_EQ(
      complaint("[subject]\nstanding_height_m = 1.7\nstanding_height_mm = 1700\n", read_height),
      "test.toml:3:1: subject.standing_height_mm: expected one value, found "
      "`standing_height_m` and `standing_height_mm`; keep one of the two");
}

TEST(Config, MissingOrForeignUnitIsNamed) {
  EXPECT_EQ(complaint("[subject]\nstanding_height = 1.7\n", read_height),
            "test.toml:2:1: subject.standing_height: expected a length with its unit (_m, _cm, _mm "
            "or _um), found `standing_height`; write for example `standing_height_m`");
  EXPECT_THAT(complaint("[subject]\nstanding_height_kg = 1.7\n", read_height),
              HasSubstr("found `standing_height_kg`"));
}

TEST(Config, WrongKindsAreReportedTogetherInFileOrder) {
  const std::string text = complaint(
      "count = 1.5\nflag = 1\nname = 3\nmode = \"couplet\"\nmass_kg = \"75\"\ncurve_x_mm = [0, 1]\n"
      "curve_y_kN = [0]\nthree = [1, 2]\ntab = 1\nbodies = [1]\n",
      [](ConfigTable root) {
        root.table("tab", "");
        root.tables("bodies", "");
        root.integer_or("count", 1, 9, 1, "");
        root.flag_or("flag", false, "");
        root.text("name", "");
        root.choice_or("mode", {"coupled", "multibody"}, "coupled", "");
        root.quantity("mass", Dimension::Mass, kPositive, "");
        root.curve("curve", Dimension::Length, Dimension::Force, Curve::Outside::Hold, "");
        root.quantities("three", Dimension::None, 3, "");
      });
  EXPECT_EQ(
      text,
      "test.toml:1:9: count: expected an integer 1 .. 9, found 1.5\n"
      "test.toml:2:8: flag: expected true or false, found 1\n"
      "test.toml:3:8: name: expected text in quotes, found 3\n"
      "test.toml:4:8: mode: expected \"coupled\" or \"multibody\", found \"couplet\"; did you "
      "mean `\"coupled\"`?\n"
      "test.toml:5:11: mass_kg: expected a positive number, found \"75\"; write the number "
      "without quotes\n"
      "test.toml:6:14: curve_x: expected a curve, found a curve needs as many ordinates as "
      "abscissae, and at least one\n"
      "test.toml:8:9: three: expected an array of 3 numbers, found [1, 2]\n"
      "test.toml:9:7: tab: expected a table, written `[tab]`, found 1\n"
      "test.toml:10:10: bodies: expected tables, written `[[bodies]]`, found [1]");
}

TEST(Config, NotANumberAndInfinityAreRefused) {
  const auto read = [](ConfigTable root) { root.quantity("mass", Dimension::Mass, {}, ""); };
  EXPECT_EQ(complaint("mass_kg = nan\n", read),
            "test.toml:1:11: mass_kg: expected a number, found nan");
  EXPECT_EQ(complaint("mass_kg = -inf\n", read),
            "test.toml:1:11: mass_kg: expected a number, found -inf");
}

TEST(Config, RangeEdgesAreInsideInEveryUnit) {
  const auto read = [](ConfigTable root) {
    root.quantity("step", Dimension::Time, {10e-6, 100e-6}, "");
  };
  EXPECT_EQ(complaint("step_us = 10\n", read), "");
  EXPECT_EQ(complaint("step_us = 100.0\n", read), "");
  EXPECT_THAT(complaint("step_us = 0\n", read), HasSubstr("expected 10 .. 100 us, found 0"));
  EXPECT_THAT(
      complaint("zero_m = 0\n",
                [](ConfigTable root) { root.quantity("zero", Dimension::Length, kPositive, ""); }),
      HasSubstr("expected a positive number, found 0"));
}

TEST(Config, SyntaxErrorHasItsPlace) {
  try {
    document("[run]\nduration_ms = no\n");
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("test.toml:2:16: syntax error in floating-point: expected"));
  }
}

TEST(Config, DefaultsAndAbsentTables) {
  ConfigDocument doc = document("");
  ConfigTable run = doc.root().table("run", "");
  EXPECT_DOUBLE_EQ(run.quantity_or("window", Dimension::Time, {}, 20e-6, ""), 20e-6);
  EXPECT_EQ(run.integer_or("n", 0, 9, 7, ""), 7);
  EXPECT_TRUE(run.flag_or("on", true, ""));
  EXPECT_EQ(run.text_or("name", "x", ""), "x");
  EXPECT_EQ(run.choice_or("mode", {"a", "b"}, "b", ""), "b");
  EXPECT_TRUE(doc.root().tables("interfaces", "").empty());
  EXPECT_FALSE(run.has("window"));
  EXPECT_NO_THROW(doc.finish());
}

TEST(Config, OpenSetsOfTablesKeepTheOrderOfTheFile) {
  ConfigDocument doc = document("[joint.neck]\na = 1\n[joint.ankle]\na = 2\n[joint.hip]\na = 3\n");
  ConfigTable joints = doc.root().table("joint", "the joints");
  EXPECT_THAT(joints.table_names(), testing::ElementsAre("neck", "ankle", "hip"));
  double sum = 0;
  for (const std::string& name : joints.table_names())
    sum += joints.table(name, "one joint").quantity("a", Dimension::None, {}, "a number");
  EXPECT_DOUBLE_EQ(sum, 6);
  EXPECT_NO_THROW(doc.finish());
  EXPECT_THAT(doc.key_reference(), HasSubstr("`joint.<name>.a`"));
}

TEST(Config, TablesOfAnArrayAndRulesBetweenKeys) {
  const std::string text =
      complaint("[[interfaces]]\nbody = \"a\"\n[[interfaces]]\nbody = \"a\"\nextra = 1\n",
                [](ConfigTable root) {
                  auto faces = root.tables("interfaces", "");
                  ASSERT_EQ(faces.size(), 2u);
                  faces[0].text("body", "");
                  faces[1].text("body", "");
                  faces[1].problem("body", "each body once", "\"a\" again");
                });
  EXPECT_EQ(text,
            "test.toml:4:8: interfaces[1].body: expected each body once, found \"a\" again\n"
            "test.toml:5:1: interfaces[1].extra: unknown key");
}

TEST(Config, IgnoredTablesBelongToOthers) {
  ConfigDocument doc = document("[fe]\nanything = 1\n[multibdoy]\nx = 1\n");
  doc.ignore_tables({"fe", "multibody"});
  try {
    doc.finish();
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "test.toml:3:1: multibdoy: unknown key; did you mean `multibody`?");
  }
}

TEST_F(ConfigFiles, BaseLiesUnderneathAndKeepsItsPlaces) {
  write("subjects/male.toml", "mass_kg = 75\nheight_mm = 3000\n[head]\nlength_mm = 196\n");
  const fs::path test =
      write("tests/a.toml", "[subject]\nbase = \"../subjects/male.toml\"\nmass_g = 72600\n");
  ConfigDocument doc(test);
  ConfigTable subject = doc.root().table("subject", "");
  EXPECT_DOUBLE_EQ(subject.quantity("mass", Dimension::Mass, kPositive, ""), 72.6);
  EXPECT_DOUBLE_EQ(subject.table("head", "").quantity("length", Dimension::Length, {}, ""), 0.196);
  subject.quantity("height", Dimension::Length, {1.2, 2.2}, "");
  try {
    doc.finish();
    FAIL() << "no error";
  } catch (const UserError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].place.text(),
              (folder_ / "subjects/male.toml").string() + ":2:13");
  }
}

TEST_F(ConfigFiles, CyclicBaseIsNamed) {
  write("a.toml", "base = \"b.toml\"\n");
  write("b.toml", "base = \"a.toml\"\n");
  try {
    ConfigDocument doc(folder_ / "a.toml");
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.toml -> b.toml -> a.toml"));
    EXPECT_EQ(error.problems()[0].place.line, 1);
  }
}

TEST_F(ConfigFiles, MissingBaseAndMissingFileAreNamed) {
  EXPECT_THROW(ConfigDocument(folder_ / "none.toml"), UserError);
  EXPECT_THROW(ConfigDocument{write("a.toml", "base = \"none.toml\"\n")}, UserError);
  const fs::path path = write("b.toml", "deck = \"none.k\"\n");
  ConfigDocument doc(path);
  EXPECT_TRUE(doc.root().file("deck", "").empty());
  try {
    doc.finish();
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("b.toml:1:8: deck: expected an existing file, found "
                                        "\"none.k\"; there is no "));
  }
}

TEST_F(ConfigFiles, FilesAreRelativeToTheFileThatNamesThem) {
  write("data/head.k", "*KEYWORD\n");
  write("data/base.toml", "deck = \"head.k\"\n");
  ConfigDocument doc(write("tests/a.toml", "[fe]\nbase = \"../data/base.toml\"\n"));
  EXPECT_EQ(doc.root().table("fe", "").file("deck", ""), fs::canonical(folder_ / "data/head.k"));
  EXPECT_NO_THROW(doc.finish());
}

TEST_F(ConfigFiles, ResolvedTextReadsBackEqualFromAnyFolder) {
  write("data/head.k", "*KEYWORD\n");
  write(
      "data/base.toml",
      "deck = \"head.k\"\nx = [1, 2.5]\nnote = \"say \\\"hi\\\"\\n\"\nsub.on = true\n[[list]]\nn = "
      "1\n[[list]]\nn = 2\n");
  const fs::path test =
      write("tests/a.toml", "[fe]\nbase = \"../data/base.toml\"\nmass_kg = 2.0\n");
  const ConfigDocument doc(test);
  ConfigDocument again(write("run/scenario.toml", doc.resolved_text()));
  ConfigTable fe = again.root().table("fe", "");
  EXPECT_EQ(fe.file("deck", ""), fs::canonical(folder_ / "data/head.k"));
  EXPECT_EQ(fe.quantities("x", Dimension::None, 2, "")[1], 2.5);
  EXPECT_EQ(fe.text("note", ""), "say \"hi\"\n");
  EXPECT_TRUE(fe.table("sub", "").flag_or("on", false, ""));
  EXPECT_EQ(fe.quantity("mass", Dimension::Mass, {}, ""), 2.0);
  auto list = fe.tables("list", "");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].integer_or("n", 0, 9, 0, "") + list[1].integer_or("n", 0, 9, 0, ""), 3);
  EXPECT_NO_THROW(again.finish());
  EXPECT_THAT(doc.resolved_text(), HasSubstr("a.toml:3:11"));  // the origin of mass_kg
}

TEST(Config, DigestFollowsContentNotLayout) {
  const auto digest = [](const std::string& text) { return document(text).digest(); };
  EXPECT_EQ(digest("a = 1\n"), digest("\n\na   = 1 # why\n"));
  EXPECT_NE(digest("a = 1\n"), digest("a = 2\n"));
  EXPECT_NE(digest("a = 1\n"), digest("b = 1\n"));
}

TEST(Config, OverrideWinsInAnyUnitAndNamesItself) {
  ConfigDocument doc = document("[run]\nduration_ms = 200.0\nname = \"x\"\n");
  doc.override_with("[run]\nduration_s = 5.0\n", "--until-ms");
  ConfigTable run = doc.root().table("run", "");
  run.text("name", "");
  EXPECT_EQ(run.quantity("duration", Dimension::Time, {0, 1}, ""), 5.0);
  try {
    doc.finish();
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--until-ms:2:14: run.duration_s: expected 0 .. 1 s"));
  }
}

TEST(Config, KeyReferenceListsEveryGetterOnce) {
  ConfigDocument doc = document("");
  ConfigTable coupling = doc.root().table("coupling", "How the two sides are coupled.");
  for (int i = 0; i < 2; ++i)
    coupling.quantity_or("window", Dimension::Time, {1e-6, 1e-4}, 20e-6, "Length of a window.");
  EXPECT_EQ(doc.key_reference(),
            "| key | unit | range | default | meaning |\n|---|---|---|---|---|\n"
            "| `[coupling]` |  |  |  | How the two sides are coupled. |\n"
            "| `coupling.window` | _s, _ms, _us or _ns | 1e-06 .. 0.0001 s | 2e-05 s | Length of a "
            "window. |\n");
}

TEST(Config, ReferenceDocumentShowsArraysAndOpenSetsWithoutComplaint) {
  ConfigDocument doc = ConfigDocument::for_reference();
  for (ConfigTable& face : doc.root().tables("interfaces", "")) face.text("body", "A body.");
  ConfigTable joints = doc.root().table("joint", "");
  for (const std::string& name : joints.table_names())
    joints.table(name, "").quantity("stop", Dimension::Angle, {}, "Its stop.");
  EXPECT_NO_THROW(doc.finish());
  EXPECT_THAT(doc.key_reference(),
              HasSubstr("| `interfaces[].body` | - | text | required | A body. |"));
  EXPECT_THAT(doc.key_reference(), HasSubstr("| `joint.<name>.stop` | _rad or _deg |"));
}

TEST(Config, AtMostTwentyProblemsAreShown) {
  std::string text;
  for (int i = 0; i < 30; ++i) text += "key" + std::to_string(i) + " = 1\n";
  ConfigDocument doc = document(text);
  try {
    doc.finish();
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_EQ(error.problems().size(), 20u);
  }
}

}  // namespace
}  // namespace crosswalk
