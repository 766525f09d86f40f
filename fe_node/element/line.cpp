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
    length_density_ = p.length_density;
    for (double length : initial_length_) corner_mass_.push_back(0.5 * length_density_ * length);
  }

  int history_per_group() const override { return kSlots * kLanes; }

  void initialise(std::span<double> history) const override {
    for (int e = 0; e < element_count(); ++e) slot(history, e, kLength) = initial_length_[e];
  }

  double corner_mass(int element) const override { return corner_mass_[element]; }
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
      const double stable = stable_step(step, e, answer);
      for (int corner = 0; corner < 2; ++corner) {
        const std::size_t at = corner_slot(e / kLanes - first, corner, e % kLanes);
        const double inverse_mass = step.nodes[end(e, corner)].inverse_mass;
        Eigen::Map<Vec3>{corner_forces.data() + at} = corner == 0 ? pull : Vec3(-pull);
        corner_forces[at + kCornerStiffness] =
            inverse_mass > 0 ? 4 / (inverse_mass * stable * stable) : 0.0;
      }
      if (!(length >= 0) || !std::isfinite(answer.force)) {
        if (sums.inverted_element < 0) sums.inverted_element = e;
        sums.inverted_jacobian = length;
      }
      sums.limit(e, stable);
    }
  }

  /// Only a truss is bounded by its own mass; what springs and muscles need depends on the nodes
  /// they pull at, and is found from those at every step.
  double initial_stiffness(int element) const override {
    if (!std::holds_alternative<ElasticLine>(law_) || !(corner_mass_[element] > 0)) return 0;
    const LineAnswer answer = answer_of(law_, {strand_rest_[strand_of_[element]], 0.0, 0.0, 0.0});
    const double step = step_bound(answer, 2.0 / corner_mass_[element]);
    return 4 * corner_mass_[element] / (step * step);
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
  /// Of the line alone between its nodes' whole masses; a constrained node counts as immovable.
  double stable_step(const StepContext& step, int e, const LineAnswer& answer) const {
    return step_bound(answer,
                      step.nodes[end(e, 0)].inverse_mass + step.nodes[end(e, 1)].inverse_mass);
  }

  LineLaw law_;
  double length_density_ = 0;
  std::vector<double> initial_length_, rest_length_, corner_mass_;
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
