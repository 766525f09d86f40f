#include "fe_node/element/section_integral.h"

#include "fe_node/element/flatten.h"

namespace crosswalk::fe {
namespace {

constexpr int kStress = 5;  // xx yy xy yz zx, in front of the law's own history

template <class N>
struct Accumulator {
  const SectionVector<N>& increment;
  const N& thickness;
  const N& shear_factor;
  double dt;
  SectionAnswer<N> answer;

  // Flattened, with sums of its own: else they would go through memory, as the history might alias
  // them.
  template <class Law>
  CW_FLATTEN N* layer(const Law& law, const std::vector<ShellPoint>& points, N* history) {
    const int size = kStress + law.history_size();
    SectionAnswer<N> sum = answer;
    for (const ShellPoint& point : points) {
      add_point(law, point, history, sum);
      history += size;
    }
    answer = sum;
    return history;
  }

  template <class Law>
  void add_point(const Law& law, const ShellPoint& point, N* history, SectionAnswer<N>& sum) const {
    const N z = point.position * thickness;
    PlaneStep<N> step;
    step.dt = dt;
    step.strain = {increment.xx + z * increment.kxx, increment.yy + z * increment.kyy,
                   increment.xy + z * increment.kxy, increment.yz, increment.zx};
    step.stress = {history[0], history[1], history[2], history[3], history[4]};
    const PlaneAnswer<N> point_answer = law.update(step, history + kStress);
    const PlaneTensor<N>& s = point_answer.stress;
    const PlaneTensor<N>& e = step.strain;

    const N share = point.weight * thickness, shear_share = share * shear_factor;
    sum.work += 0.5 * (share * ((s.xx + history[0]) * e.xx + (s.yy + history[1]) * e.yy +
                                (s.xy + history[2]) * e.xy) +
                       shear_share * ((s.yz + history[3]) * e.yz + (s.zx + history[4]) * e.zx));
    history[0] = s.xx;
    history[1] = s.yy;
    history[2] = s.xy;
    history[3] = s.yz;
    history[4] = s.zx;
    SectionVector<N>& n = sum.resultants;
    n.xx += share * s.xx;
    n.yy += share * s.yy;
    n.xy += share * s.xy;
    n.kxx += share * z * s.xx;
    n.kyy += share * z * s.yy;
    n.kxy += share * z * s.xy;
    n.yz += shear_share * s.yz;
    n.zx += shear_share * s.zx;
    sum.thinning += point.weight * point_answer.thinning;
    sum.alive = larger(sum.alive, point_answer.alive);
    sum.youngs += point.weight * law.youngs_modulus * point_answer.intact;
  }
};

}  // namespace

int section_history(const ShellSection& section) {
  int size = 0;
  for (const ShellLayer& layer : section.layers)
    size += static_cast<int>(layer.points.size()) *
            (kStress + std::visit([](const auto& l) { return l.history_size(); }, layer.law));
  return size;
}

template <class N>
void initialise_section(const ShellSection& section, N* history) {
  for (const ShellLayer& layer : section.layers)
    std::visit(
        [&](const auto& law) {
          for (std::size_t i = 0; i < layer.points.size(); ++i) {
            for (int k = 0; k < kStress; ++k) history[k] = constant<N>(0);
            law.initialise(history + kStress);
            history += kStress + law.history_size();
          }
        },
        layer.law);
}

template <class N>
SectionAnswer<N> integrate_section(const ShellSection& section, const SectionVector<N>& increment,
                                   const N& thickness, const N& shear_factor, double dt,
                                   N* history) {
  const N o = constant<N>(0);
  Accumulator<N> accumulator{
      increment, thickness, shear_factor, dt, {{o, o, o, o, o, o, o, o}, o, o, o, o}};
  for (const ShellLayer& layer : section.layers)
    history = std::visit(
        [&](const auto& law) { return accumulator.layer(law, layer.points, history); }, layer.law);
  return accumulator.answer;
}

template <class N>
SectionSample sample_section(const ShellSection& section, const N* history, int lane) {
  SectionSample sample;
  for (const ShellLayer& layer : section.layers)
    std::visit(
        [&](const auto& law) {
          for (const ShellPoint& point : layer.points) {
            sample.stress.xx += point.weight * history[0][lane];
            sample.stress.yy += point.weight * history[1][lane];
            sample.stress.xy += point.weight * history[2][lane];
            sample.stress.yz += point.weight * history[3][lane];
            sample.stress.zx += point.weight * history[4][lane];
            if constexpr (requires { law.kPlasticStrain; })
              sample.plastic_strain =
                  std::max(sample.plastic_strain, history[kStress + law.kPlasticStrain][lane]);
            history += kStress + law.history_size();
          }
        },
        layer.law);
  return sample;
}

template void initialise_section(const ShellSection&, Lanes*);
template void initialise_section(const ShellSection&, SingleLanes*);
template SectionAnswer<Lanes> integrate_section(const ShellSection&, const SectionVector<Lanes>&,
                                                const Lanes&, const Lanes&, double, Lanes*);
template SectionAnswer<SingleLanes> integrate_section(const ShellSection&,
                                                      const SectionVector<SingleLanes>&,
                                                      const SingleLanes&, const SingleLanes&,
                                                      double, SingleLanes*);
template SectionSample sample_section(const ShellSection&, const Lanes*, int);
template SectionSample sample_section(const ShellSection&, const SingleLanes*, int);

}  // namespace crosswalk::fe
