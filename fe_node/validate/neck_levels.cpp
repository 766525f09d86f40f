// Moment and angle of each level of the ligamentous neck, and of the whole neck: where a moment is
// borne, and by what.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/neck_moment.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

using generate::Level;

struct Direction {
  const char* name;
  int axis;
  double sense;
};
constexpr Direction kDirections[] = {
    {"flexion", 1, 1}, {"extension", 1, -1}, {"lateral", 0, 1}, {"axial", 2, 1}};

/// Turned about the lateral axis so that the body's own axis is vertical.
generate::ModelDraft upright(const generate::ModelDraft& draft, const Mat3& R_NB) {
  generate::ModelDraft out = draft;
  for (Vec3& p : out.mesh.nodes) p = R_NB.transpose() * p;
  return out;
}

/// Mean axes of the bodies on both sides of a level; the lower one's at the pivot joints.
Mat3 level_axes(const generate::HeadNeck& neck, Level upper) {
  const auto tilt = [&](Level level) {
    const Mat3 R = neck.spine[level].X_NB.R();
    return std::atan2(R(0, 2), R(2, 2));
  };
  const Level lower = static_cast<Level>(upper + 1);
  const double angle = upper < generate::C2 ? tilt(lower) : 0.5 * (tilt(upper) + tilt(lower));
  return exp_rotation(Vec3(0, angle, 0)).toRotationMatrix();
}

std::string shares(const MomentSample& sample) {
  double sum = 0;
  for (const double e : sample.energy) sum += e;
  std::string text;
  for (int b = 0; b < kBearers; ++b)
    if (sample.energy[b] > 0.005 * sum)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name(static_cast<Bearer>(b)),
                          100 * sample.energy[b] / sum);
  return text;
}

/// Angles in degrees at the moments, "-" where not reached.
std::string angle_row(const std::vector<MomentSample>& samples,
                      const std::vector<double>& moments) {
  std::string text;
  for (const double m : moments) {
    const MomentSample s = at_moment(samples, m);
    text +=
        s.levels.empty() ? fmt::format("{:>7}", "-") : fmt::format("{:7.1f}", s.turned / kDegree);
  }
  return text;
}

Series moment_curve(const std::string& label, const std::vector<MomentSample>& samples) {
  Series curve{label, {}};
  for (const MomentSample& s : samples) curve.points.emplace_back(s.turned / kDegree, s.moment);
  return curve;
}

}  // namespace

// Segments: one body turned on the one below it by a pure moment about the segment's own axes.
CaseResult neck_levels(const CaseContext& context) {
  const generate::HeadNeck neck = reference_neck(context.fidelity);
  const generate::ModelDraft spine = ligamentous_spine(neck);
  const std::vector<double> moments{0.33, 0.5, 1, 1.5, 2, 3, 4, 10};
  CaseResult result{"neck_levels",
                    "moment and angle of each level of the ligamentous neck",
                    "one body turned slowly on the one below it, which is held; pure moment about "
                    "the segment's own axes",
                    {},
                    {},
                    {}};
  // Mean angle of C2 to C7 by direction and moment.
  std::vector<std::vector<double>> mean(4, std::vector<double>(moments.size(), 0.0));
  for (int d = 0; d < 4; ++d) {
    const Direction& direction = kDirections[d];
    Plot plot{
        direction.name, fmt::format("Levels, {}", direction.name), "angle, deg", "moment, N m", {}};
    std::string head;
    for (const double m : moments) head += fmt::format("{:7.2f}", m);
    result.notes.push_back(fmt::format("{:9} deg at N m {}", direction.name, head));
    for (int level = generate::C0; level <= generate::C7; ++level) {
      const Level upper = static_cast<Level>(level), lower = static_cast<Level>(level + 1);
      Turning turning{.part = part_of_level(upper),
                      .held = {part_of_level(lower), generate::part::kBlockTorsoUp},
                      .axis = direction.axis,
                      .sense = direction.sense,
                      .rate = upper < generate::C2 ? 2.0 : 1.0,
                      .last_moment = 10,
                      .last_angle = upper < generate::C2 ? 1.0 : 0.4};
      const std::vector<MomentSample> samples =
          turn_slowly(upright(spine, level_axes(neck, upper)), turning,
                      context.folder / fmt::format("{}_{}", kLevelNames[level], direction.name),
                      context.computing);
      plot.series.push_back(moment_curve(kLevelNames[level], samples));
      result.notes.push_back(fmt::format(
          "{:9} {:8}    {}   at the end ({:.1f} deg, {:.1f} N m): {}", direction.name,
          kLevelNames[level], angle_row(samples, moments), samples.back().turned / kDegree,
          samples.back().moment, shares(samples.back())));
      if (upper >= generate::C2 && upper <= generate::C6)
        for (std::size_t i = 0; i < moments.size(); ++i) {
          const MomentSample s = at_moment(samples, moments[i]);
          mean[d][i] += (s.levels.empty() ? samples.back().turned : s.turned) / kDegree / 5;
        }
    }
    result.plots.push_back(plot);
  }
  const auto add = [&](int d, double moment, double reference, double low, double high,
                       Confidence confidence, const char* source) {
    const std::size_t i = static_cast<std::size_t>(
        std::find(moments.begin(), moments.end(), moment) - moments.begin());
    result.measures.push_back(
        {fmt::format("mean of C2 to C7, {}, {} N m", kDirections[d].name, moment), "deg",
         mean[d][i], reference, low, high, confidence, source});
  };
  const std::pair<double, double> flexion[] = {
      {0.33, 2.5}, {0.5, 3.3}, {1, 4.9}, {1.5, 5.7}, {2, 6.3}};
  const std::pair<double, double> extension[] = {
      {0.33, 1.6}, {0.5, 2.2}, {1, 3.5}, {1.5, 4.3}, {2, 4.9}};
  for (const auto& [m, angle] : flexion)
    add(0, m, angle, 0.6 * angle, 1.4 * angle, Confidence::Low, "[wheeldon2006]");
  for (const auto& [m, angle] : extension)
    add(1, m, angle, 0.6 * angle, 1.4 * angle, Confidence::Low, "[wheeldon2006]");
  add(0, 3, 5.8, 2.9, 8.7, Confidence::Medium, "[duraisamy2025], male");
  add(1, 3, 5.3, 3.0, 7.6, Confidence::Medium, "[duraisamy2025], male");
  add(2, 1, 3.98, 2.3, 5.7, Confidence::High, "[panjabi2001], half of both sides");
  add(3, 1, 2.31, 1.2, 3.4, Confidence::High, "[panjabi2001], half of both sides");
  return result;
}

// The whole neck: moment on the occiput, by component.
CaseResult neck_bending(const CaseContext& context) {
  const generate::HeadNeck neck = reference_neck(context.fidelity);
  const std::vector<double> moments{0.5, 1, 2, 4, 10, 20, 30};
  CaseResult result{"neck_bending",
                    "moment and angle of the whole neck",
                    "head turned slowly on the held torso blocks by a pure moment; the ligamentous "
                    "spine and the whole passive neck",
                    {},
                    {},
                    {}};
  for (const bool is_whole : {false, true}) {
    const generate::ModelDraft draft =
        is_whole ? neck_with_rigid_head(neck) : ligamentous_spine(neck);
    const char* what = is_whole ? "whole neck" : "ligamentous spine";
    Plot plot{is_whole ? "whole" : "spine", what, "angle, deg", "moment, N m", {}};
    std::string head;
    for (const double m : moments) head += fmt::format("{:7.2f}", m);
    result.notes.push_back(fmt::format("{} deg at N m {}", what, head));
    for (const Direction& direction : kDirections) {
      Turning turning{.part = part_of_level(generate::C0),
                      .held = {generate::part::kBlockTorsoUp},
                      .axis = direction.axis,
                      .sense = direction.sense,
                      .rate = 4,
                      .last_moment = 30,
                      .last_angle = 2};
      if (is_whole) {
        turning.held.push_back(generate::part::kBlockClavicleLeft);
        turning.held.push_back(generate::part::kBlockClavicleRight);
      }
      const std::vector<MomentSample> samples = turn_slowly(
          draft, turning, context.folder / fmt::format("{}_{}", plot.file, direction.name),
          context.computing);
      plot.series.push_back(moment_curve(direction.name, samples));
      result.notes.push_back(fmt::format("{:9} {}  at the end ({:.0f} deg, {:.1f} N m): {}",
                                         direction.name, angle_row(samples, moments),
                                         samples.back().turned / kDegree, samples.back().moment,
                                         shares(samples.back())));
      for (const double m : {1.0, 10.0}) {
        const MomentSample s = at_moment(samples, m);
        if (s.levels.empty()) continue;
        std::string levels;
        for (int k = 0; k < kNeckLevels; ++k)
          levels += fmt::format(" {} {:.1f}", kLevelNames[k], s.levels[k] / kDegree);
        result.notes.push_back(
            fmt::format("  {} at {} N m:{}; {}", direction.name, m, levels, shares(s)));
      }
    }
    result.plots.push_back(plot);
  }
  return result;
}

}  // namespace crosswalk::fe::validate
