#include "fe_node/deck/keyword_effects.h"

namespace crosswalk::fe {

namespace {

struct Row {
  std::string_view prefix;
  KeywordEffect effect;
};

// The first row whose prefix fits counts, so longer prefixes stand before shorter ones.
constexpr Row kRows[] = {
    {"DATABASE_", {Effect::OutputOnly, "output of another program"}},
    {"SENSOR_DEFINE", {Effect::OutputOnly, "a signal nobody uses here"}},
    {"SENSOR_", {Effect::Physics, "switches parts of the model during the run"}},
    {"INTERFACE_", {Effect::OutputOnly, "files for another run"}},
    {"ELEMENT_PLOTEL", {Effect::OutputOnly, "for display"}},
    {"CONTROL_OUTPUT", {Effect::OutputOnly, "output of another program"}},
    {"CONTROL_MPP", {Effect::Tuning, "how another program uses its processors"}},
    {"CONTROL_PARALLEL", {Effect::Tuning, "how another program uses its processors"}},
    {"CONTROL_DECOMPOSITION", {Effect::Tuning, "how another program uses its processors"}},
    {"CONTROL_STRUCTURED", {Effect::OutputOnly, "asks for a copy of the input"}},
    {"CONTROL_CPU", {Effect::Tuning, "a limit of computing time"}},
    {"CONTROL_SOLUTION", {Effect::Tuning, "checks and choices of another program"}},
    {"CONTROL_DEBUG", {Effect::OutputOnly, "output of another program"}},
    {"CONTROL_IMPLICIT", {Effect::Physics, "asks for an implicit or modal analysis"}},
    {"CONTROL_DYNAMIC_RELAXATION", {Effect::Physics, "a settling phase before the run"}},
    {"CONTROL_ALE", {Effect::Physics, "Eulerian parts"}},
    {"CONTROL_SPH", {Effect::Tuning, "particles; their elements are listed by themselves"}},
    {"FREQUENCY_DOMAIN", {Effect::Physics, "an analysis in the frequency domain"}},
    {"MAT_", {Effect::Physics, "a material law that is not available"}},
    {"EOS_", {Effect::Physics, "an equation of state that is not available"}},
    {"SECTION_", {Effect::Physics, "an element formulation that is not available"}},
    {"ELEMENT_", {Effect::Physics, "elements of a kind that is not available"}},
    {"CONTACT_", {Effect::Physics, "a contact of a kind that is not available"}},
    {"CONSTRAINED_", {Effect::Physics, "a constraint of a kind that is not available"}},
    {"AIRBAG", {Effect::Physics, "gas that loads the structure"}},
    {"ALE_", {Effect::Physics, "Eulerian parts"}},
    {"INITIAL_", {Effect::Physics, "an initial state that is not available"}},
    {"LOAD_", {Effect::Physics, "a load of a kind that is not available"}},
    {"BOUNDARY_", {Effect::Physics, "a boundary condition of a kind that is not available"}},
    {"INCLUDE_", {Effect::Physics, "a file included in a way that is not available"}},
    {"PARAMETER_", {Effect::Physics, "parameters of a kind that is not available"}},
    {"DEFINE_", {Effect::Physics, "a definition that others may refer to"}},
    {"SET_", {Effect::Physics, "a set that others may refer to"}},
};

}  // namespace

KeywordEffect effect_of(std::string_view keyword) {
  for (const Row& row : kRows)
    if (keyword.starts_with(row.prefix)) return row.effect;
  return {Effect::Physics, "not known here"};
}

}  // namespace crosswalk::fe
