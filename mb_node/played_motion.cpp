#include "mb_node/played_motion.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/byte_archive.h"
#include "common/error.h"
#include "mb_node/node_description.h"

namespace crosswalk::mb {
namespace {

constexpr std::size_t kColumns = 27;                  // t, then 13 for the head and for the car
constexpr std::int64_t kBodyStatePeriod = 1'000'000;  // ns

[[noreturn]] void refuse(
    const std::filesystem::path& file, int line, const std::string& expected,
    const std::string& found,
    const std::string& hint = "make it with `crosswalk export RUN --format motion`") {
  throw UserError(Problem{Place{file.string(), line}, "motion", expected, found, hint});
}

BodyMotion motion_from(const double* x) {
  return {{Quat(x[3], x[4], x[5], x[6]).normalized(), {x[0], x[1], x[2]}},
          {{x[7], x[8], x[9]}, {x[10], x[11], x[12]}}};
}

}  // namespace

MotionTable::MotionTable(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) refuse(file, 0, "a file that can be read", "none");
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.empty() || text[0] == '#' || text[0] == 't') continue;
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream words(text);
    std::vector<double> row;
    for (double x = 0; words >> x;) row.push_back(x);
    if (row.size() != kColumns || !words.eof())
      refuse(file, line, fmt::format("{} numbers", kColumns), fmt::format("{}", row.size()));
    if (!time_.empty() && row[0] <= time_.back()) refuse(file, line, "a rising time", "not so");
    time_.push_back(row[0]);
    head_.push_back(motion_from(&row[1]));
    car_.push_back(motion_from(&row[14]));
  }
  if (time_.size() < 2) refuse(file, 0, "at least two rows", fmt::format("{}", time_.size()));
}

BodyMotion MotionTable::at(const std::vector<BodyMotion>& rows, double t) const {
  const auto after = std::upper_bound(time_.begin(), std::prev(time_.end()), t);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - time_.begin()));
  const BodyMotion &a = rows[i - 1], &b = rows[i];
  const double share = std::clamp((t - time_[i - 1]) / (time_[i] - time_[i - 1]), 0.0, 1.0);
  const auto between = [share](const Vec3& from, const Vec3& to) -> Vec3 {
    return from + share * (to - from);
  };
  return {{a.X_WB.q.slerp(share, b.X_WB.q), between(a.X_WB.p, b.X_WB.p)},
          {between(a.V_WB.v, b.V_WB.v), between(a.V_WB.w, b.V_WB.w)}};
}

PlayedMotion::PlayedMotion(const MbConfig& config, const Scenario& scenario)
    : table_(scenario.motion), interfaces_(scenario.interfaces), vehicle_(config.vehicle) {
  constexpr double kShortfall = 1e-4;  // s: first contact is found to within that
  if (table_.end() < scenario.duration_s - kShortfall)
    refuse(scenario.motion, 0, fmt::format("at least {:g} ms", 1e3 * scenario.duration_s),
           fmt::format("{:g} ms", 1e3 * table_.end()), "end earlier with --until-ms");
}

std::vector<BodyMotion> PlayedMotion::motions(double t) const {
  std::vector<BodyMotion> out;
  for (const InterfaceSpec& spec : interfaces_)
    out.push_back(spec.body == "buck" ? table_.car(t) : table_.head(t));
  return out;
}

std::vector<InterfaceBody> PlayedMotion::interface_bodies() const {
  std::vector<InterfaceBody> bodies;
  const std::vector<BodyMotion> now = motions(0);
  for (std::size_t k = 0; k < interfaces_.size(); ++k)
    bodies.push_back({interfaces_[k].body, now[k], {}, interfaces_[k].is_attached});
  return bodies;
}

MbReply PlayedMotion::advance(const MbGrant& grant, RecordSink& sink) {
  const double begin = grant.id.begin_s(), H = grant.id.length_s();
  if (grant.id.phase == Phase::Evaluate) {
    if (grant.id.iteration == 0) before_ = work_;
    work_ = before_;
  }
  if (grant.id.phase != Phase::Accept) {
    const std::vector<BodyMotion> from = motions(begin), to = motions(begin + H);
    for (std::size_t k = 0; k < interfaces_.size(); ++k) {
      const Vec6 impulse = grant.carry[k] + H * grant.bias[k];
      work_ += 0.5 * impulse.dot(stack(from[k].V_WB) + stack(to[k].V_WB));
    }
    reply_ = {};
    reply_.substeps = 1;
    reply_.first_contact = true;
    reply_.bodies = to;
    reply_.energy.interface_work = work_;
    reply_.energy.car_work = -work_;  // what moves the bodies supplies all they give
    const auto attached = std::count_if(interfaces_.begin(), interfaces_.end(),
                                        [](const InterfaceSpec& s) { return s.is_attached; });
    if (grant.want_mobility) reply_.mobility = Eigen::MatrixXd::Zero(6 * attached, 6 * attached);
    ++progress_;
  }
  const std::int64_t begin_ns = grant.id.begin_ns(), end_ns = grant.id.end_ns();
  if (grant.id.phase != Phase::Evaluate) {
    if (begin_ns == 0) sink.body_states(0, {table_.head(0).X_WB, table_.car(0).X_WB});
    if (end_ns / kBodyStatePeriod > begin_ns / kBodyStatePeriod)
      sink.body_states(end_ns, {table_.head(begin + H).X_WB, table_.car(begin + H).X_WB});
  }
  return reply_;
}

std::string PlayedMotion::description() const {
  using nlohmann::json;
  const json description = {
      {"bodies", {"played_head", "buck"}}, {"links", json::array()},
      {"ellipsoids", json::array()},       {"head_body", -1},
      {"contact_pairs", json::array()},    {"vehicle", vehicle_json(vehicle_)}};
  return description.dump();
}

std::vector<std::byte> PlayedMotion::save_state() const {
  ByteWriter out;
  out.value(work_);
  return out.take();
}

void PlayedMotion::load_state(const std::vector<std::byte>& bytes) {
  work_ = ByteReader(bytes).take<double>();
}

}  // namespace crosswalk::mb
