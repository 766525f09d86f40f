// A homogeneous block of elements: one element kind, one part, one material law, in lane groups. A
// block is immutable; what changes lives in a flat history array of the State.
//
// Each step a block turns positions and velocities into one force per element corner (f_int with
// the sign of a load on the node: the acceleration is (sum of corner forces + loads) / mass).
// Corners are stored, not added up: the solver adds them per node in a fixed order (force_tiles.h),
// so results are bit-identical for any number of threads. With each goes a bound of the element's
// stiffness, of which the stable step is made (stable_step.h). The last group is padded by
// repeating its last element; padded lanes are never added. Blocks that compute in single precision
// take two groups at once; positions, velocities and sums stay double, so that only the element's
// own arithmetic is rounded.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/spatial.h"
#include "fe_node/element/lane_transpose.h"
#include "fe_node/material/lanes.h"
#include "fe_node/mesh/mesh.h"
#include "fe_node/mesh/node_record.h"

namespace crosswalk::fe {

/// What a block may read of the present state.
struct StepContext {
  std::span<const NodeRecord> nodes;  ///< x at t, v at t - dt/2
  std::span<const Vec3>
      spin;         ///< angular velocity of nodes at t - dt/2, rad/s; empty without shells
  double time = 0;  ///< s, of the positions
  double dt = 0;    ///< s, from the last positions to these
  bool wants_stable_step = true;  ///< without it stiffnesses mean nothing
  int threads = 1;                ///< for prepare()
};

/// Sums over the elements of a chunk; energies in J.
struct BlockSums {
  double internal = 0;              ///< work done on the material, since the start
  double hourglass = 0;             ///< stored by stiffness control, now
  double hourglass_dissipated = 0;  ///< by viscous control, this step
  double viscous_dissipated = 0;    ///< by bulk viscosity and damping, this step
  double least_step = std::numeric_limits<double>::infinity();  ///< s, of an element alone
  int critical_element = -1;  ///< block-local element whose step that is
  int inverted_element = -1;  ///< block-local element with J <= 0 or NaN, or -1
  double inverted_jacobian = 0;
  int failed = 0;  ///< elements that carry nothing any more

  void limit(int element, double step) {
    if (!(step < least_step)) return;
    least_step = step;
    critical_element = element;
  }
};

/// Sums of a kernel's loop over packs (the elements in one number of type N), lane by lane; booked
/// once at its end.
template <class N>
struct LaneSums {
  N internal = constant<N>(0), hourglass = constant<N>(0), hourglass_dissipated = constant<N>(0),
    viscous_dissipated = constant<N>(0), failed = constant<N>(0);
  N largest_rate = constant<N>(0);  ///< stiffness over mass of a corner, 1/s2
  N critical_pack = constant<N>(-1);

  /// Of lanes that do not count the stiffness must be zero.
  void look_for_stiffest(const N& stiffness, const N& corner_mass, int pack) {
    const N rate = stiffness / corner_mass;
    critical_pack = where_less(largest_rate, rate, constant<N>(pack), critical_pack);
    largest_rate = larger(rate, largest_rate);
  }
  void book(BlockSums& sums) const;
};

/// Lane groups in one number of type N.
template <class N>
inline constexpr int kGroupsPerPack = kWidth<N> / kLanes;

/// The state of one element as outputs want it; Cauchy stress in W.
struct ElementSample {
  Vec3 centre = Vec3::Zero();
  double volume = 0;                    ///< undeformed, m3
  Mat3 stress = Mat3::Zero();           ///< Pa
  Mat3 deformation = Mat3::Identity();  ///< F; for shells and lines see the block
  double energy = 0;                    ///< J
  double plastic_strain = 0;
  bool is_alive = true;
};

class ElementBlock {
 public:
  virtual ~ElementBlock() = default;

  ElementKind kind() const { return kind_; }
  int part() const { return part_; }
  int element_count() const { return static_cast<int>(mesh_elements_.size()); }
  /// Whole packs of what the block computes with.
  int group_count() const { return group_count_; }
  int corners() const { return corners_; }
  /// Index in the mesh table of a block-local element.
  int mesh_element(int element) const { return mesh_elements_[element]; }
  /// Node of a corner; padded lanes repeat the last element.
  int node(int group, int corner, int lane) const {
    return nodes_[static_cast<std::size_t>(group * corners_ + corner) * kLanes + lane];
  }
  std::size_t corner_slot(int group, int corner, int lane) const {
    return (static_cast<std::size_t>(group * corners_ + corner) * kLanes + lane) * kCornerStride;
  }
  /// Doubles of a corner force array of so many groups.
  std::size_t corner_array_size(int groups) const { return corner_slot(groups, 0, 0); }
  /// Points at which an element asks its law: the measure of its cost when work is shared out.
  virtual int points() const { return 1; }
  /// True when corners also carry moments (shells, beams).
  virtual bool has_moments() const { return false; }
  /// Numbers per lane group in the history array (a multiple of kLanes).
  virtual int history_per_group() const = 0;
  virtual void initialise(std::span<double> history) const = 0;
  /// Lumped mass of each corner of an element, kg, undeformed, as its density has it.
  virtual double corner_mass(int element) const = 0;
  /// Lumped rotary inertia of each corner, kg m2; only with moments.
  virtual double corner_inertia(int /*element*/) const { return 0; }
  virtual double element_volume(int element) const = 0;
  virtual double density() const = 0;
  /// See is_near_fluid() of its law.
  virtual bool is_near_fluid() const { return false; }

  /// Blocks whose elements look at their neighbours do so here, once a step before forces().
  virtual bool has_neighbours() const { return false; }
  virtual void prepare(const StepContext& /*step*/, std::span<double> /*history*/) const {}
  /// False once an element carries nothing any more.
  virtual bool is_alive(std::span<const double> /*history*/, int /*element*/) const { return true; }

  /// Forces of groups [first, last). `history` belongs to the whole block, the corner arrays to
  /// these groups: corner_slot(group - first, corner, lane) is the place of the x component, y, z
  /// and the corner's stiffness follow; moments likewise. See store_corner().
  virtual void forces(const StepContext& step, std::span<double> history,
                      std::span<double> corner_forces, std::span<double> corner_moments, int first,
                      int last, BlockSums& sums) const = 0;

  /// Bound k of an undeformed element's stiffness at each of its corners, N/m: a displacement u and
  /// spin w of the corners costs at most sum k (u^2 + r^2 w^2) / 2, r^2 the corner's inertia over
  /// its mass. 0: the element has none of its own.
  virtual double initial_stiffness(int element) const = 0;
  /// The stable step of one element alone, undeformed and unscaled, s.
  double initial_stable_step(int element) const;
  virtual ElementSample sample(const StepContext& step, std::span<const double> history,
                               int element) const = 0;

 protected:
  /// Takes the elements of `part` out of the mesh table in the order given. `groups_per_pack`: see
  /// kGroupsPerPack.
  ElementBlock(const Mesh& mesh, ElementKind kind, int part, std::vector<int> mesh_elements,
               int groups_per_pack = 1);

  const int* group_nodes(int group) const {
    return nodes_.data() + static_cast<std::size_t>(group) * corners_ * kLanes;
  }
  /// 1 for real elements, 0 for padding.
  template <class N>
  N lane_mask(int pack) const;
  /// Mean position of an element's corners, m.
  Vec3 centre(std::span<const NodeRecord> nodes, int element) const;

 private:
  ElementKind kind_;
  int part_;
  int corners_;
  int group_count_;
  std::vector<int> mesh_elements_;
  std::vector<int> nodes_;
};

}  // namespace crosswalk::fe
