// A finite-element node of test V2370 without the other processes: its bodies stand where the erect
// subject has them and are driven at constant speed.
#pragma once

#include <string>
#include <vector>

#include "common/neck_landmarks.h"
#include "fe_node/fe_node.h"
#include "tests/common/subject_fixture.h"
#include "tests/source_folder.h"

namespace crosswalk::fe {

/// `more`: TOML laid over the scenario.
inline FeConfig node_config(const std::string& more) {
  ConfigDocument document(source_folder() / "scenarios/tests/v2370.toml");
  document.override_with("[run]\nfidelity = \"coarse\"\n[output]\nfield_interval_ms = 0\n" + more,
                         "test");
  const Scenario scenario = read_scenario(document);
  FeConfig config = read_fe_config(document, scenario);
  config.gravity = 0;
  config.precision = Precision::Double;
  return config;
}

/// Keeps the head's motion.
class HeadSink : public RecordSink {
 public:
  void head(const HeadSample& sample) override { samples.push_back(sample); }
  void body_states(std::int64_t, const std::vector<Pose>&) override {}
  void contact_forces(std::int64_t, const std::vector<Vec3>&) override {}
  void tissue(const TissueSample& sample) override { tissues.push_back(sample); }
  void event(std::int64_t, EventLevel, const std::string&) override {}
  std::vector<HeadSample> samples;
  std::vector<TissueSample> tissues;
};

/// Drives attached bodies from rest with one acceleration, the car at one speed; no mobility, so
/// both prescribe.
class DrivenNode {
 public:
  DrivenNode(const FeConfig& config, const Twist& acceleration, const Twist& of_car,
             const Vec3& car = Vec3(0, -5, 0), const std::filesystem::path& folder = {})
      : node(config, 1, folder), acceleration_(acceleration) {
    std::vector<InterfaceBody> bodies = node.interface_bodies();
    for (InterfaceBody& body : bodies) {
      const int segment = config.body.find_segment(body.name);
      body.motion.X_WB.p = segment >= 0 ? config.body.segments[segment].com : car;
      body.motion.V_WB = body.name == "buck" ? of_car : Twist{};
      attached_ += body.is_attached ? 1 : 0;
    }
    bodies_ = node.place(bodies);
  }

  FeReply advance(int windows) {
    FeReply reply;
    for (int i = 0; i < windows; ++i) {
      FeGrant grant;
      grant.id.window = window_++;
      grant.id.window_ns = 20'000;
      for (InterfaceBody& body : bodies_) {
        BodyDrive drive;
        drive.X_WB = body.motion.X_WB;
        drive.V_WB = body.motion.V_WB;
        grant.drives.push_back(drive);
        const double H = grant.id.length_s();
        Twist& V = body.motion.V_WB;
        const Twist before = V;
        if (body.is_attached) {
          const Twist change{H * acceleration_.v, H * acceleration_.w};
          V = {V.v + change.v, V.w + change.w};
          grant.drives.back().twist_change = stack(change);
        }
        body.motion.X_WB.p += 0.5 * H * (before.v + V.v);
        body.motion.X_WB.q = exp_rotation(0.5 * H * (before.w + V.w)) * body.motion.X_WB.q;
      }
      grant.mobility = Eigen::MatrixXd::Zero(6 * attached_, 6 * attached_);
      reply = node.advance(grant, sink);
      for (const BodyLoad& load : reply.loads) impulse += load.impulse.head<3>();
    }
    return reply;
  }

  FeNode node;
  HeadSink sink;
  Vec3 impulse = Vec3::Zero();  ///< N s, on all bodies, so far

 private:
  Twist acceleration_;  ///< m/s2, rad/s2
  std::vector<InterfaceBody> bodies_;
  int attached_ = 0;
  std::int64_t window_ = 0;
};

}  // namespace crosswalk::fe
