// Integrates a shell section over its points: increments of the mid-surface strains in, stress
// resultants out. One visit of the law per layer and lane group.
#pragma once

#include "fe_node/element/shell_kernel.h"
#include "fe_node/element/shell_section.h"

namespace crosswalk::fe {

struct SectionAnswer {
  SectionVector resultants;
  Lanes work;      ///< J/m2, of this step
  Lanes thinning;  ///< mean normal strain increment
  Lanes alive;     ///< 0 when every point has failed
  Lanes intact;    ///< share of the elastic stiffness in the plane that cracks have left
};

/// Lanes of history a section keeps.
int section_history(const ShellSection& section);
void initialise_section(const ShellSection& section, Lanes* history);

/// `shear_factor` includes any reduction of the element's.
SectionAnswer integrate_section(const ShellSection& section, const SectionVector& increment,
                                const Lanes& thickness, const Lanes& shear_factor, double dt,
                                Lanes* history);

/// Mean stress and largest plastic strain of one lane, local axes.
struct SectionSample {
  PlaneTensor<double> stress{};
  double plastic_strain = 0;
};
SectionSample sample_section(const ShellSection& section, const Lanes* history, int lane);

}  // namespace crosswalk::fe
