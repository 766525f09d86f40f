#include "fe_node/element/line.h"

#include <cmath>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

/// History slots of an element, each kLanes wide: last force, last length, work so far.
enum Slot { kForce, kLength, kWork, kSlots };

class LineBlock final : public ElementBlock {
 public:
  LineBlock(const Mesh& mesh, int part, std::vector<int> elements, const LineProperties& p)
      : ElementBlock(mesh, ElementKind::Line2, part, std::move(elements)), law_(p.law) {
    const int count = element_count();
    for (int e = 0; e < count; ++e) {
      const Vec3 span = mesh.position[end(e, 1)] - mesh.position[end(e, 0)];
      initial_length_.push_back(span.norm());
      rest_length_.push_back(span.norm() + (p.slack.empty() ? 0.0 : p.slack[e]));
    }
    strand_of_.assign(count, -1);
    strands_ = p.strands;
    for (int s = 0; s < static_cast<int>(strands_.size()); ++s)
      for (int e : strands_[s]) strand_of_[e] = s;
    for (int e = 0; e < count; ++e)
      if (strand_of_[e] < 0) {
        strand_of_[e] = static_cast<int>(strands_.size());
        strands_.push_back({e});
      }
    for (const std::vector<int>& strand : strands_) {
      double sum = 0;
      for (int e : strand) sum += rest_length_[e];
      strand_rest_.push_back(sum);
    }
    scale_masses(p);
  }

  int history_per_group() const override { return kSlots * kLanes; }

  void initialise(std::span<double> history) const override {
    for (int e = 0; e < element_count(); ++e) slot(history, e, kLength) = initial_length_[e];
  }

  double corner_mass(int element) const override { return corner_mass_[element]; }
  double added_mass(int element) const override { return added_mass_[element]; }
  double element_volume(int element) const override { return initial_length_[element]; }
  /// Per length for a line, kg/m.
  double density() const override { return length_density_; }

  void forces(const StepContext& step, std::span<double> history, std::span<double> corner_forces,
              std::span<double> /*corner_moments*/, int first, int last,
              BlockSums& sums) const override {
    for (int e = first * kLanes; e < std::min(last * kLanes, element_count()); ++e) {
      const Vec3 span = position(step, e, 1) - position(step, e, 0);
      const double length = span.norm();
      const LineAnswer answer = answer_of(law_, strand_step(step, strand_of_[e]));
      double& force = slot(history, e, kForce);
      double& previous = slot(history, e, kLength);
      double& work = slot(history, e, kWork);
      if (step.dt > 0) work += 0.5 * (force + answer.force) * (length - previous);
      force = answer.force;
      previous = length;
      sums.internal += work;

      const Vec3 pull = length > 0 ? Vec3(answer.force / length * span) : Vec3::Zero();
      for (int corner = 0; corner < 2; ++corner)
        Eigen::Map<Vec3>{corner_forces.data() +
                         corner_slot(e / kLanes - first, corner, e % kLanes)} =
            corner == 0 ? pull : Vec3(-pull);
      if (!(length >= 0) || !std::isfinite(answer.force)) {
        if (sums.inverted_element < 0) sums.inverted_element = e;
        sums.inverted_jacobian = length;
      }
      const double stable = stable_step(step, e, answer);
      if (stable < sums.stable_step) {
        sums.stable_step = stable;
        sums.critical_element = e;
      }
    }
  }

  /// Only a truss is bounded by its own mass; what springs and muscles need depends on the nodes
  /// they pull at, and is found from those at every step.
  double initial_stable_step(int element) const override {
    if (!std::holds_alternative<ElasticLine>(law_)) return std::numeric_limits<double>::infinity();
    const LineAnswer answer = answer_of(law_, {strand_rest_[strand_of_[element]], 0.0, 0.0, 0.0});
    return step_bound(answer, corner_mass_[element] > 0 ? 2.0 / corner_mass_[element] : 0.0);
  }

  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override {
    ElementSample out;
    out.centre = 0.5 * (position(step, element, 0) + position(step, element, 1));
    out.volume = initial_length_[element];
    const double length = (position(step, element, 1) - position(step, element, 0)).norm();
    out.deformation(0, 0) = length / initial_length_[element];
    const double* group = history.data() + std::size_t{kSlots} * kLanes * (element / kLanes);
    out.stress(0, 0) = group[kForce * kLanes + element % kLanes];  // a force, N
    out.energy = group[kWork * kLanes + element % kLanes];
    return out;
  }

 private:
  int end(int element, int corner) const {
    return node(element / kLanes, corner, element % kLanes);
  }
  Vec3 position(const StepContext& step, int element, int corner) const {
    return step.nodes[end(element, corner)].position();
  }
  static double& slot(std::span<double> history, int element, int which) {
    return history[static_cast<std::size_t>(element / kLanes * kSlots + which) * kLanes +
                   element % kLanes];
  }

  LineStep strand_step(const StepContext& step, int strand) const {
    double length = 0, rate = 0;
    for (int e : strands_[strand]) {
      const NodeRecord& a = step.nodes[end(e, 0)];
      const NodeRecord& b = step.nodes[end(e, 1)];
      const Vec3 span = b.position() - a.position();
      const double segment = span.norm();
      length += segment;
      if (segment > 0) rate += span.dot(b.velocity() - a.velocity()) / segment;
    }
    return {strand_rest_[strand], length - strand_rest_[strand], rate, step.time};
  }

  /// dt <= 2 / omega (sqrt(1 + s^2) - s), omega^2 = k (1/m1 + 1/m2), s the damping ratio.
  static double step_bound(const LineAnswer& answer, double inverse_mass) {
    const double omega_squared = answer.stiffness * inverse_mass;
    const double half_decay = 0.5 * answer.damping * inverse_mass;
    if (omega_squared + half_decay <= 0) return std::numeric_limits<double>::infinity();
    return 2 / (std::sqrt(omega_squared + half_decay * half_decay) + half_decay);
  }
  double stable_step(const StepContext& step, int e, const LineAnswer& answer) const {
    // Nodal masses include neighbours; a constrained node counts as immovable. A truss of its own
    // mass is bounded by its own lumped masses, whichever is lighter.
    return step_bound(answer,
                      step.nodes[end(e, 0)].inverse_mass + step.nodes[end(e, 1)].inverse_mass);
  }

  void scale_masses(const LineProperties& p) {
    length_density_ = p.length_density;
    for (int e = 0; e < element_count(); ++e) {
      corner_mass_.push_back(0.5 * p.length_density * initial_length_[e]);
      added_mass_.push_back(0);
    }
    if (p.minimum_step <= 0 || p.length_density <= 0) return;
    for (int e = 0; e < element_count(); ++e) {
      const double step = initial_stable_step(e);
      if (!(step < p.minimum_step)) continue;
      const double factor = std::pow(p.minimum_step / step, 2);
      added_mass_[e] = 2 * corner_mass_[e] * (factor - 1);
      corner_mass_[e] *= factor;
    }
  }

  LineLaw law_;
  double length_density_ = 0;
  std::vector<double> initial_length_, rest_length_, corner_mass_, added_mass_;
  std::vector<std::vector<int>> strands_;
  std::vector<double> strand_rest_;
  std::vector<int> strand_of_;
};

}  // namespace

std::unique_ptr<ElementBlock> make_line_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const LineProperties& properties) {
  return std::make_unique<LineBlock>(mesh, part, std::move(elements), properties);
}

}  // namespace crosswalk::fe
