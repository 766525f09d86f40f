#include "mb_node/solo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "common/error.h"
#include "common/units.h"
#include "common/vehicle_front.h"

namespace crosswalk::mb {
namespace {

constexpr std::int64_t kWindow = 20'000;         // ns, or the substep when that is longer
constexpr std::int64_t kSamplePeriod = 100'000;  // ns
constexpr double kPeakWindow = 1e-3;             // s
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kNoContactAfter = 0.1;  // s: the car should have met the body long ago

/// Keeps poses; the head's mean acceleration over 1 ms from the change of its velocity.
class Collector final : public RecordSink {
 public:
  explicit Collector(SoloResult& result) : result_(result) {}
  void head(const HeadSample& sample) override {
    acceleration = sample.acceleration.norm();
    recent_.push_back({1e-9 * static_cast<double>(sample.t_ns), sample.V_WH.v});
    while (recent_.back().first - recent_.front().first > kPeakWindow) recent_.pop_front();
    const double span = recent_.back().first - recent_.front().first;
    if (span < 0.9 * kPeakWindow) return;
    peak = std::max(peak, (recent_.back().second - recent_.front().second).norm() / span);
  }
  void body_states(std::int64_t t_ns, const std::vector<Pose>& X_WB) override {
    result_.poses.emplace_back(1e-9 * static_cast<double>(t_ns), X_WB);
  }
  void contact_forces(std::int64_t, const std::vector<Vec3>&) override {}
  void tissue(const TissueSample&) override {}
  void event(std::int64_t, EventLevel, const std::string&) override {}

  double acceleration = 0, peak = 0;

 private:
  SoloResult& result_;
  std::deque<std::pair<double, Vec3>> recent_;
};

Vec3 centre_of_mass(const OdeWorld& world) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (int i = 0; i < world.body_count(); ++i) {
    sum += world.mass(i) * world.position(i);
    mass += world.mass(i);
  }
  return sum / mass;
}

void note_head_contact(const MbNode& node, const Twist& head, SoloSummary& s, double t) {
  const Vehicle& vehicle = node.model().config.vehicle;
  const VehicleState& car = node.state().vehicle;
  const Vec3 relative = head.v - Vec3(0, car.v, 0);
  const Vec3 p_F = vehicle_pose(vehicle, car).inverse() * node.dynamics().contacts().head_point;
  s.head_contact = t;
  s.wrap_around = wrap_around_distance(vehicle.front, p_F.tail<2>());
  s.head_speed = relative.norm();
  s.car_speed = car.v;
  s.head_angle = std::atan2(-relative.z(), relative.head<2>().norm());
  const auto& forces = node.dynamics().contacts().car_component;
  const auto& components = vehicle.front.components;
  double largest = 0;
  for (std::size_t c = 0; c < forces.size(); ++c) {
    const double share = forces[c].dot(node.dynamics().contacts().head_car);
    if (share > largest) {
      largest = share;
      s.head_component = components[c].name;
    }
  }
}

void note_failures(const MbNode& node, SoloSummary& s) {
  const auto& segments = node.model().config.body.segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const JointHistory& joint = node.state().joints[i];
    if (joint.bone.is_broken) s.broken.push_back(segments[i].name + " (bone)");
    if (joint.coordinate[1].ligament.is_torn)
      s.broken.push_back(segments[i].name + " (knee ligament)");
  }
}

}  // namespace

SoloResult run_solo(const MbConfig& config, double duration) {
  const auto wall_start = std::chrono::steady_clock::now();
  SoloResult result;
  Collector sink(result);
  MbNode node(config);
  result.description = node.description();
  SoloSummary& s = result.summary;
  s.head_contact = s.wrap_around = s.head_speed = s.head_angle = s.head_travel = s.head_drop = kNaN;
  s.road_contact = kNaN;
  s.total_mass = config.body.total_mass();
  s.stature = config.body.measures.standing_height;
  const int head = node.model().head;
  CW_ASSERT(head >= 0);
  const Vec3 head_start = node.dynamics().kinematics().p[head];
  const Vec3 cog_start = centre_of_mass(node.world());
  const double car_start = node.state().vehicle.y;
  double largest_energy = 0, largest_error = 0, largest_stepping = 0;
  MbGrant grant;
  const std::int64_t window_ns =
      std::max(kWindow, static_cast<std::int64_t>(std::llround(1e9 * config.multibody.substep)));
  grant.id.window_ns = window_ns;
  for (;; ++grant.id.window) {
    const Twist before = node.dynamics().kinematics().V[head];
    node.advance(grant, sink);
    const double now = 1e-9 * static_cast<double>((grant.id.window + 1) * window_ns);
    const double t0 = node.state().first_contact_time;
    if (t0 < 0 && now > kNoContactAfter) {
      throw UserError(
          {{}, "vehicle", "a car that meets the pedestrian", "no contact in 0.1 s", ""});
    }
    const double t = t0 < 0 ? 0 : now - t0;
    const ContactReport& contacts = node.dynamics().contacts();
    const MbEnergies energies = node.energies();
    largest_error = std::max(largest_error, std::abs(node.energy_balance(energies)));
    largest_stepping = std::max(largest_stepping, std::abs(energies.stepping));
    largest_energy = std::max(largest_energy, energies.kinetic);
    if (std::isnan(s.head_contact) && contacts.head_car.norm() > kHeadContactForce) {
      note_head_contact(node, before, s, t);
      s.head_drop = head_start.z() - node.dynamics().kinematics().p[head].z();
      s.head_travel = node.state().vehicle.y - car_start -
                      (node.dynamics().kinematics().p[head].y() - head_start.y());
    }
    if (std::isnan(s.road_contact) && contacts.ground_head.norm() > kHeadContactForce) {
      s.road_contact = t;
      s.head_peak = std::exchange(sink.peak, 0);
    }
    if (grant.id.window * window_ns % kSamplePeriod == 0 && t0 >= 0) {
      SoloSample sample;
      sample.t = t;
      sample.head_displacement = node.dynamics().kinematics().p[head] - head_start;
      sample.head_relative = vehicle_pose(config.vehicle, node.state().vehicle).inverse() *
                             node.dynamics().kinematics().p[head];
      sample.head_relative_speed =
          (node.dynamics().kinematics().V[head].v - Vec3(0, node.state().vehicle.v, 0)).norm();
      sample.head_acceleration = sink.acceleration;
      sample.car_force = contacts.car_total.norm();
      sample.head_force = contacts.head_car.norm();
      sample.ground_force = contacts.ground.norm();
      sample.energies = energies;
      result.samples.push_back(sample);
    }
    if (t0 >= 0 && t >= duration) break;
  }
  s.first_contact = node.state().first_contact_time;
  (std::isnan(s.road_contact) ? s.head_peak : s.road_peak) = sink.peak;
  s.throw_distance = centre_of_mass(node.world()).y() - cog_start.y();
  s.rest_speed = (node.world().linear_momentum() / s.total_mass).norm();
  s.energies = node.energies();
  s.energy_error = largest_error / largest_energy;
  s.stepping_error = largest_stepping / largest_energy;
  note_failures(node, s);
  s.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  return result;
}

MbConfig read_solo_config(ConfigDocument& document) {
  Scenario scenario = read_scenario(document);
  scenario.mode = RunMode::Multibody;
  scenario.interfaces.clear();
  ignore_tables_of_others(document, "mb_node");
  MbConfig config = read_mb_config(document, scenario);
  document.finish();
  return config;
}

MbConfig read_solo_config(const std::filesystem::path& scenario) {
  ConfigDocument document(scenario);
  return read_solo_config(document);
}

void write_samples_csv(const SoloResult& result, const std::filesystem::path& file) {
  std::ofstream out(file);
  if (!out) throw UserError({{}, "--csv", "a file that can be written", file.string(), ""});
  out << "t_ms,head_dx_mm,head_dy_mm,head_dz_mm,head_relative_y_mm,head_z_mm,head_speed_m_s,"
         "head_acceleration_g,car_force_N,head_force_N,ground_force_N,kinetic_J,gravity_J,"
         "joint_elastic_J,contact_elastic_J";
  for (const char* loss : kMbLossNames) out << ',' << loss << "_J";
  out << ",car_work_J,stepping_J\n";
  for (const SoloSample& s : result.samples) {
    const MbEnergies& e = s.energies;
    fmt::print(out, "{:.2f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{:.3f},{:.2f},{:.2f},{:.2f},",
               1e3 * s.t, 1e3 * s.head_displacement.x(), 1e3 * s.head_displacement.y(),
               1e3 * s.head_displacement.z(), 1e3 * s.head_relative.y(), 1e3 * s.head_relative.z(),
               s.head_relative_speed, s.head_acceleration / kStandardGravity, s.car_force,
               s.head_force, s.ground_force);
    fmt::print(out, "{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", e.kinetic, e.gravity,
               e.joint_elastic, e.contact_elastic, fmt::join(e.lost.J, ","), e.car_work,
               e.stepping);
  }
}

std::string energy_text(const MbEnergies& e) {
  std::string text = "  where the energy is at the end, J\n";
  for (auto [name, energy] : energy_rows(e)) {
    std::replace(name.begin(), name.end(), '_', ' ');
    text += fmt::format("    {:28} {:9.1f}\n", name, energy);
  }
  return text;
}

std::string summary_text(const SoloResult& result, const std::string& name) {
  const SoloSummary& s = result.summary;
  std::string broken;
  for (const std::string& b : s.broken) broken += (broken.empty() ? "" : ", ") + b;
  const double duration = result.samples.empty() ? 0 : result.samples.back().t;
  return fmt::format(
             "{}: multibody only, {:.0f} ms from first contact\n"
             "  head contact             {:.1f} ms on {}\n"
             "  wrap-around distance     {:.0f} mm\n"
             "  head speed over car      {:.2f} m/s, {:.2f} x car speed, {:.0f} deg below "
             "horizontal\n"
             "  head travel along car    {:.0f} mm, drop {:.0f} mm\n"
             "  peak head acceleration   {:.0f} g (1 ms mean)\n"
             "  centre of mass           moved {:.2f} m along the car's path, {:.2f} m/s at the "
             "end\n"
             "  head on the road         {}\n"
             "  failures                 {}\n"
             "  energy balance           {:.2g} % of the largest kinetic energy, steps alone "
             "{:.2g} %\n"
             "  wall time                {:.1f} s, real-time factor {:.1f}\n",
             name, 1e3 * duration, 1e3 * s.head_contact, s.head_component, 1e3 * s.wrap_around,
             s.head_speed, s.head_speed / s.car_speed, s.head_angle / kDegree, 1e3 * s.head_travel,
             1e3 * s.head_drop, s.head_peak / kStandardGravity, s.throw_distance, s.rest_speed,
             std::isnan(s.road_contact)
                 ? "no"
                 : fmt::format("{:.0f} ms, peak {:.0f} g (1 ms mean)", 1e3 * s.road_contact,
                               s.road_peak / kStandardGravity),
             broken.empty() ? "none" : broken, 100 * s.energy_error, 100 * s.stepping_error, s.wall,
             s.wall / std::max(1e-9, duration)) +
         energy_text(s.energies);
}

}  // namespace crosswalk::mb
