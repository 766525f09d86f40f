// The contract of a contact interface: a pure function of the present state and a small history
// that writes nodal forces and body wrenches in a fixed order, so the sum is the same for any
// thread count.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/spatial.h"
#include "fe_node/mesh/mesh.h"
#include "fe_node/mesh/node_record.h"

namespace crosswalk::fe {

/// One rigid body of the model (free, driven or follower) as contact sees it.
struct BodyMotionView {
  Pose X_WB;   ///< at t
  Twist V_WB;  ///< of the body's origin, at t - dt/2
};

/// Elements that carry nothing any more: a flag per element of the mesh table of each kind (empty
/// where none of that kind has failed), and how many there are.
struct FailedElements {
  std::array<std::vector<char>, kElementKinds.size()> is_dead;
  int count = 0;
  bool contains(ElementKind kind, int element) const {
    const std::vector<char>& dead = is_dead[static_cast<std::size_t>(kind)];
    return !dead.empty() && dead[static_cast<std::size_t>(element)] != 0;
  }
};

struct ContactContext {
  std::span<const NodeRecord> nodes;       ///< x at t, v at t - dt/2
  std::span<const double> nodal_mass;      ///< kg, rigid nodes included
  std::span<const BodyMotionView> bodies;  ///< indexed like Model::bodies
  double time = 0;
  double dt = 0;
  std::int64_t step = 0;
  int threads = 1;
  const FailedElements* failed = nullptr;  ///< null: none can fail
};

/// What a contact remembers between steps; a value, saved with the State. Candidate lists of the
/// search belong in `indices` so that a restart continues bit-identically.
struct ContactHistory {
  std::vector<double> values;
  std::vector<int> indices;
  double friction_dissipated = 0, damping_dissipated = 0;  ///< J, since the start
};

struct NodalLoad {
  int node = 0;
  Vec3 force = Vec3::Zero();
};

/// Where a contact leaves its forces. The solver adds them up serially in the order given; capacity
/// is reserved at start-up (at most `max_nodal_loads()` of all contacts), so nothing allocates in a
/// step.
struct ContactLoads {
  std::vector<NodalLoad> nodal;
  std::vector<Wrench> on_body;  ///< per body, about its origin; add, do not assign
};

struct ContactReport {
  double stored = 0;               ///< J, elastic penalty energy now
  double friction_dissipated = 0;  ///< J, this step
  double damping_dissipated = 0;   ///< J, this step; also the loop area of curve characteristics
  Vec3 force = Vec3::Zero();       ///< N, resultant on the first side
  double max_penetration = 0;      ///< m
  double stable_step = std::numeric_limits<double>::infinity();  ///< s
  int active = 0;                                                ///< nodes in contact
};

class ContactInterface {
 public:
  virtual ~ContactInterface() = default;
  const std::string& name() const { return name_; }
  virtual void initialise(ContactHistory& history, const ContactContext& context) const = 0;
  /// Most nodal loads one call may add.
  virtual int max_nodal_loads() const = 0;
  virtual ContactReport forces(const ContactContext& context, ContactHistory& history,
                               ContactLoads& loads) const = 0;

 protected:
  explicit ContactInterface(std::string name) : name_(std::move(name)) {}

 private:
  std::string name_;
};

}  // namespace crosswalk::fe
