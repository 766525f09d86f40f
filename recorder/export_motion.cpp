#include "recorder/export_motion.h"

#include <algorithm>
#include <fstream>

#include <fmt/ostream.h>

#include "common/error.h"
#include "recorder/extract.h"

namespace crosswalk::recording {

namespace {

[[noreturn]] void lacks(const std::string& what) {
  throw UserError(Problem{{}, "motion of a run", what, "none", "take another run"});
}

void require_written(const std::ofstream& out, const std::filesystem::path& path) {
  if (out) return;
  throw UserError(
      Problem{Place{path.string()}, "motion", "a file that can be written", "not so", {}});
}

/// The car between two of its recorded poses; it moves evenly there.
BodyMotion car_at(const std::map<std::int64_t, std::vector<Pose>>& bodies, std::size_t car,
                  std::int64_t t_ns) {
  auto after = bodies.lower_bound(t_ns);
  if (after == bodies.begin()) ++after;
  if (after == bodies.end()) --after;
  const auto before = std::prev(after);
  const Pose &a = before->second[car], &b = after->second[car];
  const double span = 1e-9 * static_cast<double>(after->first - before->first);
  const double share = 1e-9 * static_cast<double>(t_ns - before->first) / span;
  return {{a.q.slerp(share, b.q), a.p + share * (b.p - a.p)},
          {(b.p - a.p) / span, log_rotation(b.q * a.q.conjugate()) / span}};
}

std::string columns_of(const std::string& body) {
  std::string names;
  for (const char* axis : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", "vx_mps", "vy_mps",
                           "vz_mps", "wx_radps", "wy_radps", "wz_radps"})
    names += fmt::format(",{}_{}", body, axis);
  return names;
}

std::string numbers_of(const BodyMotion& m) {
  const Vec3 &p = m.X_WB.p, &v = m.V_WB.v, &w = m.V_WB.w;
  const Quat& q = m.X_WB.q;
  return fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{}", p.x(), p.y(), p.z(), q.w(), q.x(),
                     q.y(), q.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
}

}  // namespace

void write_motion_csv(const std::filesystem::path& path, const RunRecord& record,
                      MotionStart start) {
  const RunChannels channels = extract(record);
  const RunNames names = run_names(record);
  const auto car = std::find(names.bodies.begin(), names.bodies.end(), "buck");
  if (car == names.bodies.end() || record.bodies.size() < 2) lacks("poses of the car");
  double begin = channels.t0;
  if (start == MotionStart::HeadContact) {
    if (!channels.head_contact) lacks("a contact of head and car");
    begin += channels.head_contact->time - kLead;
  }
  std::ofstream out(path);
  fmt::print(out, "# run: {}\n# scenario: {}\n# begins_at_s: {}\n",
             record.manifest ? record.manifest->run_id : "",
             record.manifest ? record.manifest->scenario : "", begin);
  fmt::print(out, "t_s{}{}\n", columns_of("head"), columns_of("buck"));
  std::int64_t first_ns = -1;
  for (const auto& [t_ns, head] : record.head) {
    if (1e-9 * static_cast<double>(t_ns) < begin) continue;
    if (first_ns < 0) first_ns = t_ns;
    fmt::print(out, "{}{}{}\n", 1e-9 * static_cast<double>(t_ns - first_ns),
               numbers_of({head.X_WH, head.V_WH}),
               numbers_of(car_at(record.bodies,
                                 static_cast<std::size_t>(car - names.bodies.begin()), t_ns)));
  }
  out.flush();
  if (first_ns < 0) lacks("samples of the head");
  require_written(out, path);
}

void write_bodies_csv(const std::filesystem::path& path, const RunRecord& record) {
  const std::vector<std::string> bodies = run_names(record).bodies;
  if (bodies.empty() || record.bodies.empty()) lacks("poses of bodies");
  const double t0 = extract(record).t0;
  std::ofstream out(path);
  out << "t_ms";
  for (const std::string& body : bodies) {
    for (const char* part : {"x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"})
      fmt::print(out, ",{}_{}", body, part);
  }
  out << "\n";
  for (const auto& [t_ns, poses] : record.bodies) {
    if (poses.size() != bodies.size()) continue;
    fmt::print(out, "{:.3f}", 1e3 * (1e-9 * static_cast<double>(t_ns) - t0));
    for (const Pose& X : poses) {
      fmt::print(out, ",{:.3f},{:.3f},{:.3f},{:.6f},{:.6f},{:.6f},{:.6f}", 1e3 * X.p.x(),
                 1e3 * X.p.y(), 1e3 * X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z());
    }
    out << "\n";
  }
  out.flush();
  require_written(out, path);
}

}  // namespace crosswalk::recording
