// Integrates a shell section over its points: increments of the mid-surface strains in, stress
// resultants out. One visit of the law per layer and lane group.
#pragma once

#include "fe_node/element/shell_kernel.h"
#include "fe_node/element/shell_section.h"

namespace crosswalk::fe {

template <class N>
struct SectionAnswer {
  SectionVector<N> resultants;
  N work;      ///< J/m2, of this step
  N thinning;  ///< mean normal strain increment
  N alive;     ///< 0 when every point has failed
  N youngs;    ///< Pa, what cracks have left of the elastic modulus, mean over the thickness
};

/// Numbers of history a section keeps.
int section_history(const ShellSection& section);
template <class N>
void initialise_section(const ShellSection& section, N* history);

/// `shear_factor` includes any reduction of the element's.
template <class N>
SectionAnswer<N> integrate_section(const ShellSection& section, const SectionVector<N>& increment,
                                   const N& thickness, const N& shear_factor, double dt,
                                   N* history);

/// Mean stress and largest plastic strain of one lane, local axes.
struct SectionSample {
  PlaneTensor<double> stress{};
  double plastic_strain = 0;
};
template <class N>
SectionSample sample_section(const ShellSection& section, const N* history, int lane);

}  // namespace crosswalk::fe
