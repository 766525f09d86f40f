#include "recorder/extract.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "recorder/grid.h"
#include "recorder/head_motion.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

constexpr double kFirstContactForce =
    10.0;  // N [yu2020, 2.2.3: time zero is the first leg contact]
constexpr double kHeadContactForce =
    50.0;                            // N, well above the noise of a contact that opens and closes
constexpr double kGridStep = 50e-6;  // s, 20 kHz: twice the rate that CFC 1000 asks for
constexpr double kBeforeContact = 0.5e-3;  // s, "just before" head contact

double seconds(std::int64_t t_ns) { return 1e-9 * static_cast<double>(t_ns); }

std::string spelled(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

class Extraction {
 public:
  explicit Extraction(const RunRecord& record)
      : record_(record), names_(run_names(record)), buck_(buck_motion(record, names_)) {}

  RunChannels run() {
    find_time_zero();
    make_grid();
    if (out_.dt <= 0 || grid_.size() < 2) {
      out_.warnings.push_back("the log holds no simulated time to extract channels from");
      return std::move(out_);
    }
    add_head();
    add_contact();
    add_multibody_energy();
    add_finite_element_energy();
    add_audit();
    add_tissue();
    find_head_contact();
    return std::move(out_);
  }

 private:
  template <class Map, class Value>
  Series series_of(const Map& map, const Value& value) const {
    Series s;
    for (const auto& [key, item] : map) {
      s.t.push_back(seconds(item.t_ns) - out_.t0);
      s.y.push_back(value(item));
    }
    return s;
  }

  void add(const std::string& name, const std::string& unit, const std::string& description,
           const Series& series) {
    out_.channels.push_back(
        {name, unit, description, grid_.time(0), grid_.dt, sampled(series, grid_)});
  }

  void find_time_zero();
  void make_grid();
  void add_head();
  void add_contact();
  void add_multibody_energy();
  void add_finite_element_energy();
  void add_audit();
  void add_tissue();
  void find_head_contact();
  void locate(HeadContact& contact) const;
  Series pair_force(std::size_t pair) const;

  const RunRecord& record_;
  RunNames names_;
  BuckMotion buck_;
  TimeGrid grid_;
  RunChannels out_;
};

void Extraction::find_time_zero() {
  for (const auto& [t_ns, forces] : record_.contact) {
    if (forces.empty() || forces[0].norm() <= kFirstContactForce) continue;
    out_.t0 = seconds(t_ns);
    out_.has_first_contact = true;
    break;
  }
  const bool has_body = !record_.manifest || !record_.manifest->has_head_alone();
  if (!out_.has_first_contact && has_body) {
    out_.warnings.push_back(
        "car and pedestrian never touched (10 N): times count from the start of the simulation");
  }
  for (Series* s : {&buck_.position, &buck_.velocity}) {
    for (double& t : s->t) t -= out_.t0;
  }
  if (!buck_.empty()) {
    const std::vector<double> at_zero = resample(buck_.position.t, buck_.position.y, 0, 1, 1);
    for (double& y : buck_.position.y) y -= at_zero[0];
    out_.initial_buck_speed = buck_.velocity.y.front();
  } else {
    out_.warnings.push_back("the motion of the buck is not in the log: no relative channels");
  }
}

void Extraction::make_grid() {
  std::int64_t from = 0, to = 0;
  if (record_.head.size() > 1) {
    from = record_.head.begin()->first;
    to = record_.head.rbegin()->first;
  } else if (record_.mb.size() > 1) {
    from = record_.mb.begin()->second.t_ns;
    to = record_.mb.rbegin()->second.t_ns;
  } else {
    return;
  }
  const double window = record_.manifest ? seconds(record_.manifest->window_ns) : 0.0;
  grid_.dt = std::max(kGridStep, window);
  out_.dt = grid_.dt;
  constexpr double kSlack = 1e-6;  // of a step
  grid_.first = static_cast<long>(std::ceil((seconds(from) - out_.t0) / grid_.dt - kSlack));
  grid_.last = static_cast<long>(std::floor((seconds(to) - out_.t0) / grid_.dt + kSlack));
}

void Extraction::add_head() {
  if (record_.head.size() < 2) {
    out_.warnings.push_back("no head kinematics in the log");
    return;
  }
  const auto broken = std::find_if(record_.head.begin(), record_.head.end(), [](const auto& entry) {
    const HeadSample& s = entry.second;
    return !s.X_WH.p.allFinite() || !s.V_WH.v.allFinite() || !s.V_WH.w.allFinite();
  });
  if (broken != record_.head.end()) {
    out_.warnings.push_back(
        fmt::format("the head's motion is not finite at {:.2f} ms: no filtered head signal, no "
                    "injury metric",
                    1e3 * (seconds(broken->first) - out_.t0)));
  }
  const HeadMotion head(record_.head, out_.t0);
  if (head.is_resampled()) {
    out_.warnings.push_back(
        "head samples are missing: the gaps were interpolated before filtering");
  }
  constexpr const char* kAxis[] = {"x", "y", "z"};
  const auto each_axis = [&](const std::string& stem, const char* unit, const std::string& what,
                             const VectorSeries& v) {
    const std::vector<double>* parts[] = {&v.x, &v.y, &v.z};
    for (int i = 0; i < 3; ++i) {
      add(stem + "_" + kAxis[i], unit, what + ", " + kAxis[i], {v.t, *parts[i]});
    }
  };
  each_axis("head_cog", "mm", "head COG displacement since t0, frame W", head.displacement_mm());
  if (!buck_.empty()) {
    each_axis("head_cog_relative", "mm", "head COG displacement since t0 less the buck's, frame W",
              head.relative_displacement_mm(buck_));
    add("head_speed_relative", "mps", "head COG speed relative to the buck",
        head.relative_speed(buck_));
    add("buck_y", "mm", "buck displacement since t0",
        {buck_.position.t, scaled(buck_.position.y, 1e3)});
    add("buck_velocity_y", "mps", "buck velocity", buck_.velocity);
  }
  each_axis("head_velocity", "mps", "head COG velocity, frame W", head.velocity());
  const VectorSeries a = head.acceleration_filtered();
  each_axis("head_acceleration", "mps2", "head COG acceleration, SAE J211 head axes, CFC 1000", a);
  add("head_acceleration_resultant", "mps2",
      "head COG acceleration, resultant of CFC 1000 components", {a.t, a.magnitude()});
  each_axis("head_acceleration_world", "mps2", "head COG acceleration, frame W, CFC 1000",
            head.world_acceleration_filtered());
  each_axis("head_acceleration_unfiltered", "mps2",
            "head COG acceleration, SAE J211 head axes, unfiltered", head.acceleration());
  const VectorSeries w = head.angular_velocity_filtered();
  each_axis("head_angular_velocity", "radps", "head angular velocity, SAE J211 head axes, CFC 60",
            w);
  add("head_angular_velocity_resultant", "radps", "resultant of the CFC 60 components",
      {w.t, w.magnitude()});
  const VectorSeries alpha = head.angular_acceleration();
  each_axis("head_angular_acceleration", "radps2",
            "head angular acceleration, SAE J211 head axes, derivative of the CFC 60 velocity",
            alpha);
  add("head_angular_acceleration_resultant", "radps2", "resultant of the components above",
      {alpha.t, alpha.magnitude()});
  if (!head.has_neck()) return;
  each_axis("neck_force", "N", "neck on head, SAE J211 head axes, CFC 1000",
            head.neck_force_filtered());
  each_axis("neck_moment", "Nm", "neck on head about the condyles, SAE J211 head axes, CFC 600",
            head.neck_moment_filtered());
}

Series Extraction::pair_force(std::size_t pair) const {
  Series s;
  for (const auto& [t_ns, forces] : record_.contact) {
    if (pair >= forces.size()) continue;
    s.t.push_back(seconds(t_ns) - out_.t0);
    s.y.push_back(forces[pair].norm());
  }
  return s;
}

void Extraction::add_contact() {
  if (!record_.contact.empty()) {
    constexpr const char* kAxis[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
      Series s;
      for (const auto& [t_ns, forces] : record_.contact) {
        if (forces.empty()) continue;
        s.t.push_back(seconds(t_ns) - out_.t0);
        s.y.push_back(forces[0][axis]);
      }
      add(fmt::format("contact_car_total_{}", kAxis[axis]), "N",
          fmt::format("force of the car on the pedestrian, frame W, {}", kAxis[axis]), s);
    }
    for (std::size_t pair = 0; pair < names_.contact_pairs.size(); ++pair) {
      add("contact_" + spelled(names_.contact_pairs[pair]) + "_resultant", "N",
          "resultant contact force of the pair", pair_force(pair));
    }
  }
  if (!record_.fe.empty()) {
    add("head_contact_force", "N",
        "resultant of all contacts of the finite-element head with the car",
        series_of(record_.fe, [](const FeWindow& w) { return w.head_contact_force; }));
  }
}

void Extraction::add_multibody_energy() {
  if (record_.mb.empty()) return;
  const auto channel = [&](const std::string& name, const std::string& what, const auto& value) {
    add("mb_" + name, "J", what,
        series_of(record_.mb, [&value](const MbWindow& w) { return value(w.energy); }));
  };
  using E = MbEnergies;
  channel("kinetic_energy", "kinetic energy of the bodies", [](const E& e) { return e.kinetic; });
  channel("gravity_energy", "potential energy above the road",
          [](const E& e) { return e.gravity; });
  channel("joint_elastic_energy", "stored in joints", [](const E& e) { return e.joint_elastic; });
  channel("contact_elastic_energy", "stored in contacts",
          [](const E& e) { return e.contact_elastic; });
  for (std::size_t k = 0; k < kMbLosses; ++k) {
    std::string law = kMbLossNames[k];
    std::replace(law.begin(), law.end(), '_', ' ');
    channel(std::string("lost_") + kMbLossNames[k], "lost by " + law,
            [k](const E& e) { return e.lost.J[k]; });
  }
  channel("car_work", "done by the car on the pedestrian", [](const E& e) { return e.car_work; });
  channel("interface_work", "done by the interface on the bodies",
          [](const E& e) { return e.interface_work; });
}

void Extraction::add_finite_element_energy() {
  if (record_.fe.empty()) return;
  const auto channel = [&](const char* name, const char* unit, const char* what,
                           double FeWindow::*member) {
    add(std::string("fe_") + name, unit, what,
        series_of(record_.fe, [member](const FeWindow& w) { return w.*member; }));
  };
  channel("kinetic_energy", "J", "kinetic energy of the finite-element part", &FeWindow::kinetic);
  channel("internal_energy", "J", "internal energy", &FeWindow::internal);
  channel("hourglass_energy", "J", "hourglass energy", &FeWindow::hourglass);
  channel("contact_energy", "J", "stored and lost in contacts", &FeWindow::contact);
  channel("damping_energy", "J", "bulk viscosity and nodal damping", &FeWindow::damping);
  channel("external_work", "J", "gravity and loads other than the interface",
          &FeWindow::external_work);
  channel("interface_work", "J", "done by the interface bodies", &FeWindow::interface_work);
  channel("added_mass", "kg", "added by mass scaling", &FeWindow::added_mass);
}

void Extraction::add_audit() {
  if (record_.audit.empty()) return;
  const auto channel = [&](const char* name, const char* unit, const char* what,
                           const std::function<double(const AuditWindow&)>& value) {
    add(std::string("coupling_") + name, unit, what, series_of(record_.audit, value));
  };
  channel("interface_drift", "J", "interface work of both sides, sum",
          [](const AuditWindow& a) { return a.drift; });
  channel("interface_exchanged", "J", "sum of |interface work| over the windows",
          [](const AuditWindow& a) { return a.exchanged; });
  channel("total_energy", "J", "both sides", [](const AuditWindow& a) { return a.total_energy; });
  channel("external_work", "J", "both sides, car and gravity",
          [](const AuditWindow& a) { return a.external_work; });
  channel("balance_error", "J", "total energy less external work less start",
          [](const AuditWindow& a) { return a.balance_error; });
  channel("gap", "mm", "largest distance between body and block",
          [](const AuditWindow& a) { return 1e3 * a.gap_position; });
}

void Extraction::add_tissue() {
  if (record_.tissue.empty()) return;
  using Region = TissueSample::Region;
  const std::size_t n = record_.tissue.begin()->second.regions.size();
  for (std::size_t r = 0; r < n; ++r) {
    const std::string region =
        r < names_.regions.size() ? names_.regions[r] : "region " + std::to_string(r);
    const auto channel = [&](const char* name, const char* what, double Region::*member) {
      const auto value = [r, member](const TissueSample& s) {
        return r < s.regions.size() ? s.regions[r].*member : 0.0;
      };
      add("brain_" + spelled(region) + "_" + name, "1", region + ": " + what,
          series_of(record_.tissue, value));
    };
    channel("mps_95", "95th percentile of the first principal Green strain now", &Region::mps_95);
    channel("mps_95_so_far", "95th percentile of the element maxima until now",
            &Region::mps_95_so_far);
    channel("csdm_15", "volume share that has exceeded a strain of 0.15", &Region::csdm_15);
    channel("csdm_25", "volume share that has exceeded a strain of 0.25", &Region::csdm_25);
  }
}

/// First instant a series exceeds a level, and its largest value.
std::optional<std::pair<double, double>> onset(const Series& s, double level) {
  std::optional<double> first;
  double peak = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!first && s.y[i] > level) first = s.t[i];
    peak = std::max(peak, s.y[i]);
  }
  if (!first) return std::nullopt;
  return std::pair{*first, peak};
}

void Extraction::find_head_contact() {
  HeadContact contact;
  contact.partner = "car";
  contact.time = std::numeric_limits<double>::infinity();
  if (!record_.fe.empty()) {
    const Series force =
        series_of(record_.fe, [](const FeWindow& w) { return w.head_contact_force; });
    if (const auto found = onset(force, kHeadContactForce)) {
      contact.time = found->first;
      contact.peak_force = found->second;
    }
  }
  for (std::size_t pair = 0; pair < names_.contact_pairs.size(); ++pair) {
    const std::string& name = names_.contact_pairs[pair];
    if (!name.starts_with("head")) continue;
    const auto found = onset(pair_force(pair), kHeadContactForce);
    if (!found) continue;
    contact.peak_force = std::max(contact.peak_force, found->second);
    if (found->first < contact.time) {
      contact.time = found->first;
      contact.partner = name;
    }
  }
  if (!std::isfinite(contact.time)) return;
  if (const Channel* speed = out_.find("head_speed_relative")) {
    const Series s = speed->series();
    const double before = contact.time - kBeforeContact;
    contact.relative_speed = resample(s.t, s.y, before, 1, 1)[0];
    contact.buck_speed = resample(buck_.velocity.t, buck_.velocity.y, before, 1, 1)[0];
  }
  locate(contact);
  out_.head_contact = contact;
}

/// Where on the car: wrap-around distance and part of the profile point nearest to the head COG.
void Extraction::locate(HeadContact& contact) const {
  const double t = out_.t0 + contact.time;
  const std::optional<Vec3> p_head = head_position_at(record_, t);
  const std::optional<Vec3> origin = buck_origin_at(record_, names_, t);
  if (!p_head || !origin || names_.front.facets.empty()) return;
  const Eigen::Vector2d point(p_head->y() - origin->y(), p_head->z() - origin->z());
  contact.wrap_around_distance = wrap_around_distance(names_.front, point);
  double nearest = std::numeric_limits<double>::infinity();
  for (const FrontFacet& facet : names_.front.facets) {
    const Eigen::Vector2d along = facet.end - facet.begin;
    const double s = std::clamp((point - facet.begin).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (point - facet.begin - s * along).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    contact.partner = facet.component;
  }
}

}  // namespace

const Channel* RunChannels::find(const std::string& name) const {
  for (const Channel& channel : channels) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

RunChannels extract(const RunRecord& record) {
  RunChannels out = Extraction(record).run();
  out.head = head_signals(out.channels);
  return out;
}

}  // namespace crosswalk::recording
