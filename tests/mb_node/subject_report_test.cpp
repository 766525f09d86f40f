#include "mb_node/subject_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/subject_fixture.h"
#include "tests/source_folder.h"

namespace crosswalk::mb {
namespace {

using testing::HasSubstr;

PublishedScaling published(const std::string& subject) {
  return read_published_scaling(source_folder() / "scenarios/reference/scaled_models.csv", subject);
}

TEST(SubjectReport, HeightsAndLengthsAreMetAtLeastAsWellAsByThePublishedModel) {
  for (const auto& [file, name] :
       {std::pair{"v2370", "V2370"}, std::pair{"v2371", "V2371"}, std::pair{"v2374", "V2374"}}) {
    const BodyDescription body = load_subject(file);
    const WorstLength ours = worst_length(body);
    const WorstLength theirs = worst_length(body.measures, published(name));
    EXPECT_GT(theirs.difference, 0.03) << name;
    EXPECT_LE(ours.difference, theirs.difference) << name << ": " << ours.measure;
  }
}

TEST(SubjectReport, ShowsThePublishedDifferencesBesideOurOwn) {
  const std::string text = subject_report(load_subject("v2371"), published("V2371"));
  EXPECT_THAT(text, HasSubstr("published model"));
  EXPECT_THAT(text, HasSubstr("-47.3    -8.3 %"));  // knee height, 522.7 of 570 mm
  EXPECT_THAT(text, HasSubstr("6.3900    0.025004   0.028844   0.017861"));
  const std::string alone = subject_report(load_subject("male_50"), published("male_50"));
  EXPECT_THAT(alone, testing::Not(HasSubstr("published model ")));
}

}  // namespace
}  // namespace crosswalk::mb
