#include <algorithm>
#include <cctype>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run_directory.h"
#include "common/units.h"
#include "recorder/commands/commands.h"
#include "recorder/export_csv.h"
#include "recorder/export_motion.h"
#include "recorder/head_motion.h"
#include "recorder/isomme.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

/// Test reference numbers of ISO-MME are short and plain.
std::string test_name(const fs::path& run) {
  std::string name;
  for (const char c : fs::absolute(run).lexically_normal().filename().string()) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    }
  }
  return name.empty() ? "RUN" : name;
}

/// Speed of the car at the start, m/s as text; empty when the run does not tell it.
std::string car_speed(const std::vector<Channel>& channels) {
  for (const Channel& c : channels) {
    if (c.name != "buck_velocity_y") continue;
    const Series present = c.present();
    return present.y.empty() ? "" : fmt::format("{:.6g}", present.y.front());
  }
  return {};
}

MmeTest as_isomme(const fs::path& run, const std::vector<Channel>& channels) {
  MmeTest test = mme_test(test_name(run), channels,
                          {{"Title", "Pedestrian head impact, simulation"},
                           {"Type of the test", "Pedestrian"},
                           {"Subtype of the test", "Simulation"},
                           {"Number of test objects", "2"},
                           {"Name of test object 1", "Car"},
                           {"Class of test object 1", "1"},
                           {"Velocity test object 1", car_speed(channels)},
                           {"Name of test object 2", "Pedestrian"},
                           {"Class of test object 2", "D"},
                           {"Comments", "axes 1 2 3: subject's front, car travel, up"}});
  const ScoreCard card = score_card(head_signals(channels));
  if (card.linear) {
    test.channels.push_back(mme_constant("D0HICRCG15VH00RX", "HIC15", card.linear->HIC15.value));
    test.channels.push_back(mme_constant("D0HICRCG36VH00RX", "HIC36", card.linear->HIC36.value));
    if (card.linear->clip_single) {
      MmeChannel clip = mme_constant("D0HEADCG3SVHACRX", "3 ms acceleration, one piece",
                                     kStandardGravity * card.linear->clip_single->value);
      clip.unit = "m/(s*s)";
      test.channels.push_back(clip);
    }
  }
  if (card.rotation) {
    test.channels.push_back(mme_constant("D0BRICCG00VH000X", "BrIC", card.rotation->BrIC.avg));
    test.channels.push_back(
        mme_constant("D0HEADDAMAVHAARX", "DAMAGE", card.rotation->DAMAGE.value));
  }
  return test;
}

}  // namespace

ExitCode export_run(const ExportRequest& request) {
  if (!fs::is_directory(request.run)) {
    throw UserError(
        Problem{{request.run.string()}, "export", "the folder of a run", "no folder", {}});
  }
  const fs::path out = request.out.empty() ? request.run / "export" : request.out;
  fs::create_directories(out);
  if (request.format == "motion" || request.format == "impact_motion") {
    const fs::path file = out / (request.format + ".csv");
    write_motion_csv(
        file, read_run_record(RunDirectory(request.run).signals()),
        request.format == "motion" ? MotionStart::FirstContact : MotionStart::HeadContact);
    fmt::print("motion of head and car in {}\n", file.string());
    return ExitCode::Done;
  }
  if (request.format == "bodies") {
    write_bodies_csv(out / "bodies.csv", read_run_record(RunDirectory(request.run).signals()));
    fmt::print("poses of all bodies in {}\n", (out / "bodies.csv").string());
    return ExitCode::Done;
  }
  const std::vector<Channel> channels = channels_of_run(request.run);
  if (request.format == "isomme") {
    const MmeTest test = as_isomme(request.run, channels);
    write_isomme(out / test.name, test);
    fmt::print("{} channels in {}\n", test.channels.size(), (out / test.name).string());
  } else {
    const fs::path kept = RunDirectory(request.run).channels(), file = out / "channels.csv";
    if (!fs::exists(kept)) {
      write_channels_csv(file, channels, {});
    } else if (!fs::exists(file) || !fs::equivalent(kept, file)) {
      fs::copy_file(kept, file, fs::copy_options::overwrite_existing);
    }
    fmt::print("{} channels in {}\n", channels.size(), (out / "channels.csv").string());
  }
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
